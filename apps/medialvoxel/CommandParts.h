// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandParts_h
#define medialvoxelCommandParts_h

#include "CommandLine.h"
#include "Options.h"

#include <cstdint>
#include <optional>

namespace medialvoxel
{

/** Parts that several commands have. */
void
AddInput(CLI::App & app, JobOptions & options);
void
AddLabels(CLI::App & app, ExtractOptions & options);
void
AddMemory(CLI::App & app, std::optional<std::uint64_t> & target);
void
AddScratch(CLI::App & app, std::string & target);
void
AddThreads(CLI::App & app, std::optional<unsigned int> & target);
void
AddProgress(CommandLine & line, CLI::App & app);
void
AddLog(CommandLine & line, CLI::App & app, std::string & target);

void
AddRawOptions(CommandLine & line, CLI::App & app, JobOptions & options);
void
AddObjectOptions(CLI::App & app, JobOptions & options);
CLI::Option *
AddPoreSize(CLI::App & app, const std::string & help, std::optional<std::uint64_t> & target);

void
AddThickness(CommandLine & line, CLI::App & app, ExtractOptions & options);

/** To be called after all options of the command itself. */
void
AddRunOptions(CommandLine & line, CLI::App & app, JobOptions & options);

/** All but the arguments. \param resumes of the option --resume; null for commands without it */
void
AddExtractOptions(CommandLine & line, CLI::App & app, ExtractOptions & options, bool * resumes);

/** Defines mesh. */
void
DefineMesh(CommandLine & line);

/** Defines surface. */
void
DefineSurface(CommandLine & line);

/** Defines plan, work, finalize and status. */
void
DefineJobCommands(CommandLine & line);

} // end namespace medialvoxel

#endif
