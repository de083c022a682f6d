// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffDescription.h"

#include "LengthUnits.h"
#include "Text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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
ParseLength(const std::optional<std::string> & text)
{
  const std::optional<double> length = text ? ParseDouble(Trim(*text)) : std::nullopt;
  return length && std::isfinite(*length) && *length > 0 ? length : std::nullopt;
}

/** Keeps the first unit that is not known. */
std::optional<double>
ParseUnit(const std::string & unit, TiffDescription & description)
{
  const std::optional<double> millimeters = GetMillimeters(unit);
  if (!millimeters && !unit.empty() && description.unknownUnit.empty())
  {
    description.unknownUnit = unit;
  }
  return millimeters;
}

/** Refuses several channels, and several points in time of several slices. */
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
  description.isOfImageJ = true;
  description.isCalibrated = find("cf").has_value();
  description.images = find("images").value_or("");
  description.refusal = FindRefusal(find("channels"), find("frames"), find("slices"));
  const std::string unit = Trim(find("unit").value_or(""));
  description.units = { ParseUnit(unit, description),
                        ParseUnit(Trim(find("yunit").value_or(unit)), description),
                        ParseUnit(Trim(find("zunit").value_or(unit)), description) };
  // ImageJ leaves a depth of 1 out.
  description.lengths[2] = ParseLength(find("spacing").value_or("1"));
  return description;
}

/** Planes lie in the file in the order of the volume; other orders and several files are refused. */
bool
HasOtherOrder(const std::string & text)
{
  for (std::size_t at = text.find("TiffData "); at != std::string::npos; at = text.find("TiffData ", at + 1))
  {
    const std::string planes = " " + text.substr(at, text.find('>', at) - at);
    const auto        find = [&planes](const char * name) {
      return ParseInteger(FindBetween(planes, std::string(" ") + name + "=\"", '"').value_or("0")).value_or(-1);
    };
    const bool isTold = planes.find(" IFD=") != std::string::npos;
    if (isTold && find("IFD") != find("FirstZ") + find("FirstT") + find("FirstC"))
    {
      return true;
    }
  }
  return false;
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
  if (description.refusal.empty() && HasOtherOrder(text))
  {
    description.refusal =
      "its description tells of planes in another order than they lie in the file, which is not read";
  }
  const auto slices = find("SizeZ");
  const auto times = find("SizeT");
  description.images = Trim(slices && Trim(*slices) != "1" ? *slices : times.value_or(slices.value_or("")));
  for (size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name = std::string("PhysicalSize") + "XYZ"[axis];
    description.lengths[axis] = ParseLength(find(name));
    if (description.lengths[axis])
    {
      description.units[axis] = ParseUnit(find(name + "Unit").value_or("micrometer"), description);
    }
  }
  return description;
}

/** The sizes of an array as tifffile writes them when it does not know the axes. */
TiffDescription
ReadShape(const std::string & text)
{
  const std::string        shape = FindBetween(text, "\"shape\": [", ']').value_or("");
  std::vector<std::string> sizes; // other than 1
  for (std::size_t first = 0; first < shape.size(); first = std::min(shape.find(',', first), shape.size()) + 1)
  {
    const std::string size = Trim(shape.substr(first, shape.find(',', first) - first));
    if (size != "1")
    {
      sizes.push_back(size);
    }
  }
  TiffDescription description;
  if (sizes.size() > 3)
  {
    description.refusal = "its description tells of an array of the shape " + shape + "; only one volume is read";
  }
  description.images = sizes.size() == 3 ? sizes.front() : "";
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
  if (text.rfind("{\"shape\"", 0) == 0)
  {
    return ReadShape(text);
  }
  return text.find("<OME") == std::string::npos ? TiffDescription() : ReadOme(text);
}

} // end namespace medialvoxel
