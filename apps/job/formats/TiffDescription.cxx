// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffDescription.h"

#include "LengthUnits.h"
#include "Text.h"

#include <cmath>

namespace medialvoxel
{
namespace
{

/** The text between \a begin and \a end; nothing when it is not there. */
std::optional<std::string>
FindBetween(const std::string & text, const std::string & begin, char end)
{
  const size_t at = text.find(begin);
  if (at == std::string::npos)
  {
    return std::nullopt;
  }
  const size_t first = at + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

std::optional<double>
ParseLength(const std::optional<std::string> & text, double unit)
{
  const std::optional<double> length = text ? ParseDouble(Trim(*text)) : std::nullopt;
  return length && std::isfinite(*length) && *length > 0 ? std::optional<double>(*length * unit) : std::nullopt;
}

/** Of channels and points in time; one of these may be the only one there are. */
std::string
FindRefusal(const std::optional<std::string> & channels,
            const std::optional<std::string> & times,
            const std::optional<std::string> & slices)
{
  const auto isSeveral = [](const std::optional<std::string> & count) { return count && Trim(*count) != "1"; };
  if (isSeveral(channels))
  {
    return "its description tells of " + Trim(*channels) + " channels; only one value per voxel is read";
  }
  if (isSeveral(times) && isSeveral(slices))
  {
    return "its description tells of " + Trim(*times) + " points in time; only one volume is read";
  }
  return {};
}

/** Lines of names and values. */
TiffDescription
ReadImageJ(const std::string & text)
{
  const auto find = [&text](const std::string & name) { return FindBetween(text, "\n" + name + "=", '\n'); };

  TiffDescription description;
  description.images = find("images").value_or("");
  description.refusal = FindRefusal(find("channels"), find("frames"), find("slices"));
  description.unit = GetMillimeters(Trim(find("unit").value_or("")));
  if (description.unit)
  {
    description.spacing[2] = ParseLength(find("spacing"), *description.unit);
  }
  return description;
}

/** Attributes of the element Pixels; lengths without a unit are micrometers. */
TiffDescription
ReadOme(const std::string & text)
{
  const std::string pixels = " " + FindBetween(text, "Pixels ", '>').value_or("");
  const auto        find = [&pixels](const std::string & name) { return FindBetween(pixels, " " + name + "=\"", '"'); };

  TiffDescription description;
  description.refusal = FindRefusal(find("SizeC"), find("SizeT"), find("SizeZ"));
  const size_t first = text.find("Pixels ");
  if (first != std::string::npos && text.find("<Pixels ", first + 1) != std::string::npos)
  {
    description.refusal = "its description tells of several images; only one volume is read";
  }
  for (size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name = std::string("PhysicalSize") + "XYZ"[axis];
    const auto        unit = GetMillimeters(find(name + "Unit").value_or("micrometer"));
    description.spacing[axis] = unit ? ParseLength(find(name), *unit) : std::nullopt;
  }
  return description;
}

} // namespace

TiffDescription
ReadTiffDescription(const std::string & text)
{
  if (text.rfind("ImageJ=", 0) == 0)
  {
    return ReadImageJ(text);
  }
  return text.find("<OME") == std::string::npos ? TiffDescription() : ReadOme(text);
}

} // end namespace medialvoxel
