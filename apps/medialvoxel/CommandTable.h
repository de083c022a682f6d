// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandTable_h
#define medialvoxelCommandTable_h

#include "CommandLine.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** The group of options that no text names; the parser has no name for options in no group. */
constexpr const char * HiddenGroup = "hidden";

/** The group of options that few need: --help leaves them out. */
constexpr const char * FurtherGroup = "Further options";

using Options = std::vector<const CLI::Option *>;

/** The commands that users are told of. */
std::vector<const CLI::App *>
GetCommands(const CLI::App & app);

/** The row of the table that an option comes from; null for options without a volume. */
const OptionRow *
FindRow(const CommandLine & line, const CLI::Option & option);

/** Names that the option takes; empty when it takes others. */
const std::vector<std::string> &
GetChoices(const CommandLine & line, const CLI::Option & option);

/** Sentences behind the line of the help; empty when there is no more to say. */
std::string
GetDetails(const CommandLine & line, const CLI::Option & option);

/** Positional arguments, or the others, in the order of their definition; further options at the end. */
Options
GetOptions(const CLI::App & app, bool positional);

/** "--threads N". */
std::string
GetUsage(const CLI::Option & option);

} // end namespace medialvoxel

#endif
