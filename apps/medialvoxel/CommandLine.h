// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandLine_h
#define medialvoxelCommandLine_h

#include "ClusterOptions.h"
#include "LogRecord.h"
#include "Options.h"
#include "Progress.h"

#include <CLI/CLI.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace medialvoxel
{

/** What the command line says beyond the job: which job, and what to show of it. */
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
  SurfaceOptions  surfaceOptions;
  DistanceOptions distanceOptions;
  JobOptions      infoOptions;
  bool            showsValues{ false }; ///< of the volume
  bool            showsLabels{ false }; ///< what its objects take when it is a label map
  bool            resumes{ false };     ///< the extraction
  PlanOptions     planOptions;
  WorkOptions     workOptions;
  FinalizeOptions finalizeOptions;
  std::string     statusFolder;
  bool            statusAsJson{ false };
  ProgressStyle   progress{ ProgressStyle::Auto };
  bool            quiet{ false };
  std::string     logFile; ///< of commands without JobOptions
  LogLevel        logLevel{ LogLevel::Info };

  CLI::App *  generate{ nullptr }; ///< not shown: what the build calls
  std::string generateFolder;

  /** Names that an option takes, the first one the default. */
  std::map<const CLI::Option *, std::vector<std::string>> choices;

  /** Two for each command, as they are typed. */
  std::map<const CLI::App *, std::vector<std::string>> examples;
};

/** Defines subcommands and options, the one place for all of them: parser, help, completions and manual pages follow;
 * parsing fills \a line, which must outlive the result. */
std::unique_ptr<CLI::App>
DefineCommandLine(CommandLine & line);

} // end namespace medialvoxel

#endif
