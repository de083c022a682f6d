// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionValues_h
#define medialvoxelOptionValues_h

#include "Options.h"
#include "SuggestName.h"
#include "Text.h"

#include "itkMedialVoxelLimit.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
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

/** The same for a limit on values, where whole numbers keep all 64 bits. */
inline itk::MedialVoxelLimit
ToLimit(const std::string & text)
{
  const std::optional<itk::MedialVoxelLimit> value = itk::MedialVoxelLimit::Parse(text);
  if (!value)
  {
    throw CLI::ValidationError("'" + text + "' is not a number, from 2^53 on a whole number");
  }
  return *value;
}

inline double
ToPositive(const std::string & text)
{
  const double value = ToDouble(text);
  if (!(value > 0.0))
  {
    throw CLI::ValidationError("'" + text + "' is not greater than 0");
  }
  return value;
}

inline ElementSize
ToElementSize(const std::string & text)
{
  if (text == VoxelElementSize || text == AutomaticElementSize)
  {
    return { text == VoxelElementSize ? ElementSize::Kind::Voxel : ElementSize::Kind::Automatic, 0.0 };
  }
  if (!ParseDouble(text))
  {
    throw CLI::ValidationError("'" + text + "' is not a length, " + AutomaticElementSize + " or " + VoxelElementSize);
  }
  return { ElementSize::Kind::Length, ToPositive(text) };
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

/** Adds an option, or an argument, that names a file or a folder, which a shell completes with a slash. */
inline CLI::Option *
AddFile(CLI::App & app, const std::string & name, const std::string & help, std::string & target)
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

inline std::vector<std::string>
SplitAtCommas(const std::string & text)
{
  return CLI::detail::split(text, ',');
}

/** A limit on the thickness of walls, and perhaps the one that places grow to. */
inline PlaceLimits
ToPlaceLimits(const std::string & text)
{
  const std::vector<std::string> values = SplitAtCommas(text);
  if (values.empty() || values.size() > 2)
  {
    throw CLI::ValidationError("'" + text + "' is not one length, or two with a comma");
  }
  return { ToDouble(values[0]), values.size() > 1 ? std::optional<double>(ToDouble(values[1])) : std::nullopt };
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
  return { ToDouble(values[0]), ToDouble(values[1]) };
}

} // end namespace medialvoxel

#endif
