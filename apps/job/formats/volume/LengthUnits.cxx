// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LengthUnits.h"

#include "Text.h"

#include <algorithm>
#include <array>

namespace medialvoxel
{
namespace
{

struct Unit
{
  const char * name; ///< in lower case
  double       millimeters;
};

constexpr std::array<Unit, 32> Units{ { { "m", 1e3 },
                                        { "meter", 1e3 },
                                        { "cm", 10.0 },
                                        { "centimeter", 10.0 },
                                        { "mm", 1.0 },
                                        { "millimeter", 1.0 },
                                        { "um", 1e-3 },
                                        { "\u00b5m", 1e-3 },  // micro sign
                                        { "\u03bcm", 1e-3 },  // Greek letter mu
                                        { "\xb5m", 1e-3 },    // micro sign of Latin-1
                                        { "\\u00b5m", 1e-3 }, // as ImageJ writes it
                                        { "&#181;m", 1e-3 },  // as XML may write it
                                        { "micron", 1e-3 },
                                        { "microns", 1e-3 },
                                        { "micrometer", 1e-3 },
                                        { "nm", 1e-6 },
                                        { "nanometer", 1e-6 },
                                        { "angstrom", 1e-7 },
                                        { "angstroms", 1e-7 },
                                        { "a", 1e-7 },
                                        { "\u00e5", 1e-7 },
                                        { "meters", 1e3 },
                                        { "centimeters", 10.0 },
                                        { "millimeters", 1.0 },
                                        { "micrometers", 1e-3 },
                                        { "nanometers", 1e-6 },
                                        { "mil", 0.0254 },
                                        { "inches", 25.4 },
                                        { "pm", 1e-9 },
                                        { "\u00c5", 1e-7 },
                                        { "in", 25.4 },
                                        { "inch", 25.4 } } };

} // namespace

std::optional<double>
GetMillimeters(const std::string & unit)
{
  const std::string lower = ToLower(unit);
  const auto        found =
    std::find_if(Units.begin(), Units.end(), [&lower](const Unit & known) { return lower == known.name; });
  return found == Units.end() ? std::nullopt : std::optional<double>(found->millimeters);
}

void
ApplyUnits(VolumeHeader & header, const std::vector<std::string> & units)
{
  const auto isEmpty = [](const std::string & unit) { return unit.empty(); };
  if (std::all_of(units.begin(), units.end(), isEmpty))
  {
    return;
  }
  std::vector<double> factors;
  for (std::size_t axis = 0; axis < header.geometry.GetDimension(); ++axis)
  {
    const std::string           unit = axis < units.size() ? units[axis] : "";
    const std::optional<double> millimeters = GetMillimeters(unit);
    if (!millimeters)
    {
      WarnOfUnknownSpacing(header, unit.empty() ? "not all axes have a unit" : "the unit '" + unit + "' is not known");
      return;
    }
    factors.push_back(*millimeters);
  }
  for (std::size_t axis = 0; axis < factors.size(); ++axis)
  {
    header.geometry.spacing[axis] *= factors[axis];
    header.geometry.origin[axis] *= factors[axis];
  }
  header.geometry.inMillimeters = true;
}

void
WarnOfUnknownSpacing(VolumeHeader & header, const std::string & what)
{
  header.geometry.inMillimeters = false;
  header.warnings.push_back(
    { HeaderWarnings::UnknownSpacing,
      what + "; the spacing " + FormatNumbers(header.geometry.spacing, " x ") + " is assumed, --spacing sets it",
      {} });
}

} // end namespace medialvoxel
