// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandTable.h"

#include "OptionParser.h"

#include <algorithm>

namespace medialvoxel
{

std::vector<const CLI::App *>
GetCommands(const CLI::App & app)
{
  return app.get_subcommands([](const CLI::App * command) { return !command->get_group().empty(); });
}

const OptionRow *
FindRow(const CommandLine & line, const CLI::Option & option)
{
  const auto found = line.rows.find(&option);
  return found == line.rows.end() ? nullptr : found->second;
}

const std::vector<std::string> &
GetChoices(const CommandLine & line, const CLI::Option & option)
{
  static const std::vector<std::string> none;
  const OptionRow * const               row = FindRow(line, option);
  return row ? row->value.choices : none;
}

std::string
GetDetails(const CommandLine & line, const CLI::Option & option)
{
  const OptionRow * const row = FindRow(line, option);
  return row ? row->details : "";
}

Options
GetOptions(const CLI::App & app, bool positional)
{
  Options options = app.get_options([positional](const CLI::Option * option) {
    return option->get_positional() == positional && option->get_group() != HiddenGroup;
  });
  std::stable_partition(
    options.begin(), options.end(), [](const CLI::Option * option) { return option->get_group() != FurtherGroup; });
  return options;
}

/** "--threads N". */
std::string
GetUsage(const CLI::Option & option)
{
  const std::string name = option.get_positional() ? option.get_name(true) : option.get_name(false, true);
  return !option.get_positional() && HasValue(option) ? name + " " + option.get_type_name() : name;
}

} // end namespace medialvoxel
