// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandText_h
#define medialvoxelCommandText_h

#include "CommandLine.h"

#include <string>

namespace medialvoxel
{

/** Lets the command and its subcommands print help that fits a screen: 80 columns, a line for each option. */
void
UseCompactHelp(const CommandLine & line, CLI::App & app);

/** Completion for bash. */
std::string
MakeBashCompletion(const CommandLine & line, const CLI::App & app);

/** Completion for zsh. */
std::string
MakeZshCompletion(const CommandLine & line, const CLI::App & app);

/** Manual page of the program, or of one of its commands, for man. */
std::string
MakeManualPage(const CommandLine & line, const CLI::App & app);

/** Commands, options, formats and outputs as JSON, which the pages of doc/reference are made from. */
std::string
MakeCatalog(const CommandLine & line, const CLI::App & app);

/** Writes all of these: medialvoxel.bash, _medialvoxel, catalog.json, medialvoxel.1 and a page for each command, and
 * the description of the module for 3D Slicer.
 * \throw JobError Failure */
void
WriteCommandTexts(const CommandLine & line, const CLI::App & app);

} // end namespace medialvoxel

#endif
