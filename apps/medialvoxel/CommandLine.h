// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandLine_h
#define medialvoxelCommandLine_h

#include "Options.h"
#include "Progress.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace medialvoxel
{

/** What the command line says beyond the job: which job, and what to show of it. */
struct CommandLine
{
  CLI::App *      extract{ nullptr };
  CLI::App *      distance{ nullptr };
  CLI::App *      info{ nullptr };
  ExtractOptions  extractOptions;
  DistanceOptions distanceOptions;
  JobOptions      infoOptions;
  ProgressStyle   progress{ ProgressStyle::Auto };
  bool            quiet{ false };
};

/** Defines subcommands and options; parsing fills \a line, which must outlive the result. */
std::unique_ptr<CLI::App>
DefineCommandLine(CommandLine & line);

} // end namespace medialvoxel

#endif
