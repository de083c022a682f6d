// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionValues_h
#define medialvoxelOptionValues_h

#include "Options.h"
#include "SuggestName.h"
#include "Text.h"

#include "itkMedialVoxelGridLimits.h"
#include "itkMedialVoxelLimit.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** A number, the whole number, and nothing but the number. */
inline double
ToDouble(const std::string & text)
{
  const std::optional<double> value = ParseDouble(text);
  if (!value)
  {
    throw CLI::ValidationError("'" + text + "' is not a number");
  }
  return *value;
}

/** The same for a limit on values, where whole numbers keep all 64 bits. \param others what the option takes beside */
inline itk::MedialVoxelLimit
ToLimit(const std::string & text, const std::string & others = "")
{
  const std::optional<itk::MedialVoxelLimit> value = itk::MedialVoxelLimit::Parse(text);
  if (value && !value->IsNotANumber())
  {
    return *value;
  }
  throw CLI::ValidationError("'" + text + "' is not a number" + others +
                             (!value && ParseDouble(text) ? "; from 2^53 on it must be a whole number" : ""));
}

inline double
ToFinite(const std::string & text)
{
  const double value = ParseDouble(text).value_or(std::numeric_limits<double>::infinity());
  if (!std::isfinite(value))
  {
    throw CLI::ValidationError("'" + text + "' is not a finite number");
  }
  return value;
}

/** Infinity is the same as no limit. */
inline double
ToDistance(const std::string & text)
{
  const double value = ParseDouble(text).value_or(0.0);
  if (!(value > 0.0))
  {
    throw CLI::ValidationError("'" + text + "' is not a number greater than 0");
  }
  return value;
}

/** Of a distance between voxels. */
inline double
ToSpacing(const std::string & text, const std::string & others = "")
{
  using Limits = itk::MedialVoxelGridLimits;
  const double value = ParseDouble(text).value_or(0.0);
  if (!(value >= Limits::SmallestSpacing && value <= Limits::LargestSpacing))
  {
    throw CLI::ValidationError("'" + text + "' is not a number greater than 0, from " +
                               FormatNumber(Limits::SmallestSpacing) + " to " + FormatNumber(Limits::LargestSpacing) +
                               others);
  }
  return value;
}

/** Of a length that a wall or a ball may have. */
inline double
ToLength(const std::string & text, const std::string & others = "")
{
  constexpr double largest = itk::MedialVoxelGridLimits::LargestLength;
  const double     value = ParseDouble(text).value_or(0.0);
  if (!(value > 0.0 && value <= largest))
  {
    throw CLI::ValidationError("'" + text + "' is not a finite number greater than 0, at most " +
                               FormatNumber(largest) + others);
  }
  return value;
}

/** The same, where 0 stands for none. */
inline double
ToLengthOrNone(const std::string & text)
{
  const std::optional<double> value = ParseDouble(text);
  return value && *value == 0.0 ? 0.0 : ToLength(text);
}

/** What a flag says: true, on, yes and 1, or false, off, no and 0, in any case. */
std::optional<bool>
ParseFlag(const std::string & text);

inline bool
ToFlag(const std::string & text)
{
  const std::optional<bool> value = ParseFlag(text);
  if (!value)
  {
    throw CLI::ValidationError("'" + text + "' is not one of true|on|yes|1|false|off|no|0");
  }
  return *value;
}

inline ElementSize
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

inline std::int64_t
ToInteger(const std::string & text, std::int64_t least, std::int64_t most)
{
  const std::optional<std::int64_t> value = ParseInteger(text);
  if (!value || *value < least || *value > most)
  {
    throw CLI::ValidationError("'" + text + "' is not a whole number from " + std::to_string(least) + " to " +
                               std::to_string(most));
  }
  return *value;
}

inline std::uint64_t
ToCount(const std::string & text, std::uint64_t least, std::uint64_t most)
{
  return static_cast<std::uint64_t>(ToInteger(text, static_cast<std::int64_t>(least), static_cast<std::int64_t>(most)));
}

inline std::uint64_t
ToByteSize(const std::string & text)
{
  const std::optional<std::uint64_t> bytes = ParseByteSize(text);
  if (!bytes)
  {
    throw CLI::ValidationError("'" + text + "' is not a size such as 500M, 2G or 2GiB");
  }
  return *bytes;
}

inline LabelSelection
ToLabels(const std::string & text)
{
  const std::optional<LabelSelection> labels = ParseLabelSelection(text);
  if (!labels)
  {
    throw CLI::ValidationError("'" + text +
                               "' is neither all nor whole numbers other than 0, from -2^63 to 2^63 - 1, " +
                               "or names of segments, with commas between them");
  }
  return *labels;
}

constexpr std::uint64_t LargestCount = std::uint64_t{ 1 } << 62;

/** Adds an option with one value that \a assign takes as text; what it throws names the option. */
template <typename TAssign>
CLI::Option *
AddText(CLI::App & app, const std::string & name, const std::string & help, const std::string & unit, TAssign assign)
{
  const auto parse = [name, assign](const CLI::results_t & results) {
    try
    {
      assign(results.front());
    }
    catch (const CLI::ValidationError & error)
    {
      throw CLI::ValidationError(name, error.what());
    }
    return true;
  };
  return app.add_option(name, parse, help)->type_name(unit)->type_size(1)->expected(1);
}

/** Adds an option that takes no word of its own, but a value behind an equals sign; alone it says true. ParseWords()
 * brings the words into the form that the parser knows. */
template <typename TAssign>
CLI::Option *
AddFlag(CLI::App & app, const std::string & name, const std::string & help, TAssign assign)
{
  return AddText(app, name, help, "", [assign](const std::string & text) { assign(ToFlag(text)); });
}

inline CLI::Option *
AddFlag(CLI::App & app, const std::string & name, const std::string & help, bool & target)
{
  return AddFlag(app, name, help, [&target](bool value) { target = value; });
}

/** Whether a value is the word behind an option. */
inline bool
HasValue(const CLI::Option & option)
{
  return option.get_items_expected_max() > 0 && !option.get_type_name().empty();
}

/** Adds an option that names a file or a folder, which a shell completes with a slash; nothing stands for none. */
inline CLI::Option *
AddOptionalFile(CLI::App & app, const std::string & name, const std::string & help, std::string & target)
{
  const auto withoutSlash = [](std::string fileName) {
    while (fileName.size() > 1 && fileName.back() == '/')
    {
      fileName.pop_back();
    }
    return fileName;
  };
  return app.add_option(name, target, help)->type_name("FILE")->transform(withoutSlash, "", "");
}

inline CLI::Option *
RefuseEmpty(CLI::Option * option, const std::string & what)
{
  return option->check([what](const std::string & text) { return text.empty() ? "'' is not " + what : ""; });
}

/** The same, or an argument, where nothing is refused: with it an output would be missing. */
inline CLI::Option *
AddFile(CLI::App & app, const std::string & name, const std::string & help, std::string & target)
{
  return RefuseEmpty(AddOptionalFile(app, name, help, target), "the name of a file");
}

/** The names of choices. */
template <typename TEnum>
std::vector<std::string>
ListNames(const std::vector<std::pair<std::string, TEnum>> & choices)
{
  std::vector<std::string> names;
  for (const auto & choice : choices)
  {
    names.push_back(choice.first);
  }
  return names;
}

/** Adds an option whose value is one of some names, in any case. */
template <typename TEnum>
CLI::Option *
AddChoice(CLI::App &                                         app,
          const std::string &                                name,
          const std::string &                                help,
          const std::string &                                unit,
          TEnum &                                            target,
          const std::vector<std::pair<std::string, TEnum>> & choices)
{
  return AddText(app, name, help, unit, [&target, choices](const std::string & text) {
    const auto found = std::find_if(
      choices.begin(), choices.end(), [&](const auto & choice) { return ToLower(choice.first) == ToLower(text); });
    if (found == choices.end())
    {
      const std::vector<std::string> names = ListNames(choices);
      throw CLI::ValidationError("'" + text + "' is not one of " + CLI::detail::join(names, "|") +
                                 SuggestName(text, names));
    }
    target = found->second;
  });
}

/** Also of nothing, and behind the last comma. */
std::vector<std::string>
SplitAtCommas(const std::string & text);

/** A limit on the thickness of walls, and perhaps the one that places grow to. */
inline PlaceLimits
ToPlaceLimits(const std::string & text, PlaceKind kind)
{
  const std::vector<std::string> values = SplitAtCommas(text);
  if (values.size() > 2)
  {
    throw CLI::ValidationError("'" + text + "' is not one length, or two with a comma");
  }
  const bool        isThin = kind == PlaceKind::Thin;
  const PlaceLimits limits{ ToLength(values[0]),
                            values.size() > 1 ? std::optional<double>(ToLength(values[1])) : std::nullopt };
  const double      growLimit = limits.GetGrowLimit(kind);
  if (isThin ? growLimit < limits.limit : growLimit > limits.limit)
  {
    throw CLI::ValidationError("'" + text + "' has a second length that is " + (isThin ? "less" : "greater") +
                               " than the first; it must not be");
  }
  return limits;
}

/** Values of background and material. */
inline itk::MedialVoxelScanLevels
ToLevels(const std::string & text)
{
  const std::vector<std::string> values = SplitAtCommas(text);
  if (values.size() != 2)
  {
    throw CLI::ValidationError("'" + text + "' is not two values, of background and material, with a comma");
  }
  return { ToFinite(values[0]), ToFinite(values[1]) };
}

} // end namespace medialvoxel

#endif
