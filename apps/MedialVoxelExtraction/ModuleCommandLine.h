// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelModuleCommandLine_h
#define medialvoxelModuleCommandLine_h

#include "Parameters.h"

#include <ostream>
#include <string>
#include <vector>

namespace medialvoxel
{

/** What the command line asks for. */
enum class ModuleAction
{
  Run,
  PrintHelp,
  PrintVersion,
  PrintXml
};

/** Hands the arguments to the table: "--name value", "--name=value", for booleans also "--name" alone, and two
 * positional ones; after "--" all are positional. \throw JobError Usage. */
ModuleAction
ParseArguments(const std::vector<std::string> & arguments, ParameterTable & table);

/** Usage with all parameters, their kinds, ranges and defaults. */
void
PrintHelp(std::ostream & out, const ParameterTable & table);

/** Names and values of all parameters, a line each. */
void
PrintValues(std::ostream & out, const ParameterTable & table);

} // end namespace medialvoxel

#endif
