// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshOptions_h
#define medialvoxelMeshOptions_h

#include "CommandLine.h"

#include <string>

namespace medialvoxel
{

/** Adds the option or argument \a name. */
CLI::Option *
AddMesh(CLI::App & app, const std::string & name, ExtractOptions & options);

CLI::Option *
AddSectionWidth(CLI::App & app, ExtractOptions & options);

CLI::Option *
AddElementSize(CLI::App & app, ExtractOptions & options);

/** Elements of solvers are as long as the wall is thick, unless a size is given. After the arguments are parsed. */
void
CompleteElementSize(const CLI::App & app, ExtractOptions & options);

} // end namespace medialvoxel

#endif
