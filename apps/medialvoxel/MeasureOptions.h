// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeasureOptions_h
#define medialvoxelMeasureOptions_h

#include "Options.h"

#include "CLI/CLI.hpp"

namespace medialvoxel
{

struct CommandLine;

/** Adds the options of how walls are measured on gray values, or not. */
CLI::Option *
AddSubVoxel(CLI::App & app, ExtractOptions & options);

/** Adds the choice of the local thickness to a group. */
void
AddLocalThicknessMethod(CommandLine & line, CLI::App & app, LocalThicknessMethod & target, const std::string & group);

/** Adds the option of the largest ball of the local thickness. */
CLI::Option *
AddLargestBall(CLI::App & app, std::optional<double> & target);

/** Adds these, and the outputs that show measures of walls, in groups of their own. */
void
AddMeasureOptions(CommandLine & line, CLI::App & app, ExtractOptions & options);

} // end namespace medialvoxel

#endif
