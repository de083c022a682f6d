// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionText.h"

#include "SuggestName.h"
#include "Text.h"

#include "itkMedialVoxelGridLimits.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace medialvoxel
{
namespace
{

[[noreturn]] void
Refuse(const std::string & text, const std::string & problem)
{
  throw WrongValue("'" + text + "' " + problem);
}

} // namespace

double
ToFinite(const std::string & text)
{
  const double value = ParseDouble(text).value_or(std::numeric_limits<double>::infinity());
  if (!std::isfinite(value))
  {
    Refuse(text, "is not a finite number");
  }
  return value;
}

double
ToDistance(const std::string & text)
{
  const double value = ParseDouble(text).value_or(0.0);
  if (!(value > 0.0))
  {
    Refuse(text, "is not a number greater than 0");
  }
  return value;
}

double
ToSpacing(const std::string & text, const std::string & others)
{
  using Limits = itk::MedialVoxelGridLimits;
  const double value = ParseDouble(text).value_or(0.0);
  if (!(value >= Limits::SmallestSpacing && value <= Limits::LargestSpacing))
  {
    Refuse(text,
           "is not a number greater than 0, from " + FormatNumber(Limits::SmallestSpacing) + " to " +
             FormatNumber(Limits::LargestSpacing) + others);
  }
  return value;
}

double
ToLength(const std::string & text, const std::string & others)
{
  constexpr double largest = itk::MedialVoxelGridLimits::LargestLength;
  const double     value = ParseDouble(text).value_or(0.0);
  if (!(value > 0.0 && value <= largest))
  {
    Refuse(text, "is not a finite number greater than 0, at most " + FormatNumber(largest) + others);
  }
  return value;
}

double
ToLengthOrNone(const std::string & text)
{
  const std::optional<double> value = ParseDouble(text);
  return value && *value == 0.0 ? 0.0 : ToLength(text);
}

std::int64_t
ToInteger(const std::string & text, std::int64_t least, std::int64_t most)
{
  const std::optional<std::int64_t> value = ParseInteger(text);
  if (!value || *value < least || *value > most)
  {
    Refuse(text, "is not a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return *value;
}

std::uint64_t
ToCount(const std::string & text, std::uint64_t least, std::uint64_t most)
{
  return static_cast<std::uint64_t>(ToInteger(text, static_cast<std::int64_t>(least), static_cast<std::int64_t>(most)));
}

std::uint64_t
ToByteSize(const std::string & text)
{
  const std::optional<std::uint64_t> bytes = ParseByteSize(text);
  if (!bytes)
  {
    Refuse(text, "is not a size such as 500M, 2G or 2GiB");
  }
  return *bytes;
}

bool
ToFlag(const std::string & text)
{
  const std::optional<bool> value = ParseFlag(text);
  if (!value)
  {
    Refuse(text, "is not one of true|on|yes|1|false|off|no|0");
  }
  return *value;
}

std::string
ToFileName(const std::string & text)
{
  std::string fileName = text;
  while (fileName.size() > 1 && fileName.back() == '/')
  {
    fileName.pop_back();
  }
  return fileName;
}

itk::MedialVoxelExactNumber
ToLimit(const std::string & text, const std::string & others)
{
  const std::optional<itk::MedialVoxelExactNumber> value = itk::MedialVoxelExactNumber::Parse(text);
  if (!value || value->IsNotANumber())
  {
    Refuse(text,
           "is not a number" + others +
             (!value && ParseDouble(text) ? "; from 2^53 on it must be a whole number" : ""));
  }
  return *value;
}

LabelValue
ToLabel(const std::string & text)
{
  const std::optional<LabelValue> label = ParseLabel(text);
  if (!label)
  {
    Refuse(text, "is not a whole number from -2^63 to 2^64 - 1");
  }
  return *label;
}

LabelSelection
ToLabels(const std::string & text)
{
  const std::optional<LabelSelection> labels = ParseLabelSelection(text);
  if (!labels)
  {
    Refuse(text,
           "is neither all nor whole numbers other than 0, from -2^63 to 2^63 - 1, "
           "or names of segments, with commas between them");
  }
  return *labels;
}

ElementSize
ToElementSize(const std::string & text)
{
  const std::string name = ToLower(text);
  if (name == VoxelElementSize || name == AutomaticElementSize)
  {
    return { name == VoxelElementSize ? ElementSize::Kind::Voxel : ElementSize::Kind::Automatic, 0.0 };
  }
  return { ElementSize::Kind::Length,
           ToLength(text, std::string(", ") + AutomaticElementSize + " or " + VoxelElementSize) };
}

itk::MedialVoxelScanLevels
ToLevels(const std::string & text)
{
  const std::vector<std::string> values = SplitAtCommas(text);
  if (values.size() != 2)
  {
    Refuse(text, "is not two values, of background and material, with a comma");
  }
  return { ToFinite(values[0]), ToFinite(values[1]) };
}

ColorRange
ToColorRange(const std::string & text)
{
  const std::vector<std::string> values = SplitAtCommas(text);
  if (values.size() != 2)
  {
    Refuse(text, "is not two lengths with a comma");
  }
  const ColorRange range{ ToFinite(values[0]), ToFinite(values[1]) };
  if (range.low < 0.0 || range.high <= range.low)
  {
    Refuse(text, "is not a length from 0 on and a greater one");
  }
  return range;
}

PlaceLimits
ToPlaceLimits(const std::string & text, PlaceKind kind)
{
  const std::vector<std::string> values = SplitAtCommas(text);
  if (values.size() > 3)
  {
    Refuse(text, "is not one or two lengths and an area, with commas between them");
  }
  const bool  isThin = kind == PlaceKind::Thin;
  PlaceLimits limits{ ToLength(values[0]) };
  if (values.size() > 2)
  {
    limits.leastArea = ToLengthOrNone(values[2]);
  }
  if (values.size() == 2 || (values.size() == 3 && !values[1].empty()))
  {
    limits.growLimit = ToLength(values[1]);
  }
  const double growLimit = limits.GetGrowLimit(kind);
  if (isThin ? growLimit < limits.limit : growLimit > limits.limit)
  {
    Refuse(text,
           std::string("has a second length that is ") + (isThin ? "less" : "greater") +
             " than the first; it must not be");
  }
  return limits;
}

std::size_t
FindChoice(const std::vector<std::string> & names, const std::string & text)
{
  const auto found = std::find_if(
    names.begin(), names.end(), [&text](const std::string & name) { return ToLower(name) == ToLower(text); });
  if (found == names.end())
  {
    const auto same = [](const std::string & name) { return name; };
    Refuse(text, "is not one of " + Join(names, "|", same) + SuggestName(text, names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

std::string
FormatFlag(bool value)
{
  return value ? "true" : "false";
}

std::string
FormatLabels(const LabelSelection & labels)
{
  std::vector<std::string> words = labels.all ? std::vector<std::string>{ "all" } : labels.names;
  for (const std::int64_t value : labels.values)
  {
    words.push_back(std::to_string(value));
  }
  return Join(words, ",", [](const std::string & word) { return word; });
}

std::string
FormatElementSize(const ElementSize & size)
{
  switch (size.kind)
  {
    case ElementSize::Kind::Voxel:
      return VoxelElementSize;
    case ElementSize::Kind::Automatic:
      return AutomaticElementSize;
    case ElementSize::Kind::Length:
      break;
  }
  return FormatNumber(size.length);
}

std::string
FormatLevels(const itk::MedialVoxelScanLevels & levels)
{
  return FormatNumbers({ levels.background, levels.material }, ",");
}

std::string
FormatColorRange(const ColorRange & range)
{
  return FormatNumbers({ range.low, range.high }, ",");
}

std::string
FormatPlaceLimits(const PlaceLimits & limits)
{
  const std::string grow = limits.growLimit ? "," + FormatNumber(*limits.growLimit) : limits.leastArea ? "," : "";
  return FormatNumber(limits.limit) + grow + (limits.leastArea ? "," + FormatNumber(*limits.leastArea) : "");
}

std::optional<bool>
ParseFlag(const std::string & text)
{
  const std::string name = ToLower(text);
  const auto        isOneOf = [&name](std::initializer_list<const char *> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (isOneOf({ "true", "on", "yes", "1" }))
  {
    return true;
  }
  return isOneOf({ "false", "off", "no", "0" }) ? std::optional<bool>(false) : std::nullopt;
}

std::string
ReplaceUnits(const std::string & text, const double voxel)
{
  constexpr std::size_t length = 2;
  std::string           replaced;
  int                   number = 0;
  for (const std::string & part : SplitAtCommas(text))
  {
    const double                scale = ++number == 3 ? voxel * voxel : voxel;
    const std::size_t           front = part.size() < length ? 0 : part.size() - length;
    const std::string           unit = ToLower(part.substr(front));
    const std::optional<double> value =
      unit == "mm" || unit == "vx" ? ParseDouble(part.substr(0, front)) : std::nullopt;
    replaced += "," + (value ? FormatNumber(unit == "vx" ? *value * scale : *value) : part);
  }
  return replaced.substr(1);
}

bool
HasVoxels(const std::string & text)
{
  return ReplaceUnits(text, 1.0) != ReplaceUnits(text, 2.0);
}

std::vector<std::string>
SplitAtCommas(const std::string & text)
{
  std::vector<std::string> parts;
  std::size_t              begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1)
  {
    end = text.find(',', begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

} // end namespace medialvoxel
