// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandTable.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace medialvoxel
{
namespace
{

/** Characters to insert, remove or replace, upper and lower case being the same. */
std::size_t
GetDistance(const std::string & a, const std::string & b)
{
  const auto isSame = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (isSame(a[i], b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({ replaced, row[j] + 1, row[j + 1] + 1 });
    }
  }
  return row.back();
}

} // namespace

std::string
SuggestName(const std::string & text, const std::vector<std::string> & names)
{
  // A third of the characters may differ; more would suggest names that have nothing to do with the text.
  std::size_t least = text.size() / 3 + 1;
  std::string best;
  for (const std::string & name : names)
  {
    const std::size_t distance = GetDistance(text, name);
    if (distance < least)
    {
      least = distance;
      best = name;
    }
  }
  return best.empty() ? "" : "; did you mean " + best + "?";
}

std::vector<const CLI::App *>
GetCommands(const CLI::App & app)
{
  return app.get_subcommands([](const CLI::App * command) { return !command->get_group().empty(); });
}

bool
HasValue(const CLI::Option & option)
{
  return option.get_items_expected_max() > 0;
}

const std::vector<std::string> &
GetChoices(const CommandLine & line, const CLI::Option & option)
{
  static const std::vector<std::string> none;
  const auto                            found = line.choices.find(&option);
  return found == line.choices.end() ? none : found->second;
}

/** Positional arguments, or the others, in the order of their definition, without those that are not shown. */
Options
GetOptions(const CLI::App & app, bool positional)
{
  return app.get_options([positional](const CLI::Option * option) {
    return option->get_positional() == positional && !option->get_group().empty();
  });
}

/** "--threads N". */
std::string
GetUsage(const CLI::Option & option)
{
  const std::string name = option.get_positional() ? option.get_name(true) : option.get_name(false, true);
  return !option.get_positional() && HasValue(option) ? name + " " + option.get_type_name() : name;
}

} // end namespace medialvoxel
