// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionParser_h
#define medialvoxelOptionParser_h

#include "OptionValue.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace medialvoxel
{

/** A parser without commands and options. */
std::unique_ptr<CLI::App>
MakeParser(const std::string & help, const std::string & programName);

/** Adds an option or an argument, whose value goes to the target; errors name it. ParseWords() brings flags into the
 * form that the parser knows. */
CLI::Option *
AddOption(CLI::App &           app,
          const std::string &  name,
          const std::string &  unit,
          const std::string &  help,
          const OptionValue &  value,
          const OptionTarget & target);

/** Sets the lengths that are in voxels, the smallest spacing, which the volume tells. \throw JobError */
void
SetLengthsInVoxels(const ProgramOptions & program, const JobOptions & options, bool hasSheets);

/** Whether a value is the word behind an option. */
bool
HasValue(const CLI::Option & option);

} // end namespace medialvoxel

#endif
