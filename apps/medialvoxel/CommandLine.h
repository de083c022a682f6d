// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandLine_h
#define medialvoxelCommandLine_h

#include "OptionTable.h"

#include <CLI/CLI.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace medialvoxel
{

/** The parsed command line: the job, and the output to show. */
struct CommandLine
{
  CLI::App *      extract{ nullptr };
  CLI::App *      mesh{ nullptr };
  CLI::App *      surface{ nullptr };
  CLI::App *      distance{ nullptr };
  CLI::App *      info{ nullptr };
  CLI::App *      plan{ nullptr };
  CLI::App *      work{ nullptr };
  CLI::App *      finalize{ nullptr };
  CLI::App *      status{ nullptr };
  ExtractOptions  extractOptions;
  ExtractOptions  meshOptions;
  PartOptions     partOptions;
  DistanceOptions distanceOptions;
  JobOptions      infoOptions;
  PlanOptions     planOptions;
  WorkOptions     workOptions;
  FinalizeOptions finalizeOptions;
  JobOptions      processOptions; ///< of work and finalize, which read no volume
  ProgramOptions  program;

  CLI::App *  generate{ nullptr }; ///< hidden: called by the build
  std::string generateFolder;

  /** Where options come from. */
  std::map<const CLI::Option *, const OptionRow *> rows;

  /** Two for each command, as they are typed. */
  std::map<const CLI::App *, std::vector<std::string>> examples;
};

/** Defines the commands, with their options from the table; parsing fills \a line, which must outlive the result. */
std::unique_ptr<CLI::App>
DefineCommandLine(CommandLine & line);

/** Completes the parsed options, and refuses options without effect beside the others. Conflicts that depend on the
 * volume are warnings of the job.
 * \throw JobError Usage that names the option and its need */
void
CompleteCommandLine(CommandLine & line);

} // end namespace medialvoxel

#endif
