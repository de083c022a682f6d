// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLeftovers_h
#define medialvoxelLeftovers_h

#include "OutputRequest.h"

#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** Removes from a folder what runs of this user on this machine left there that were killed: temporary files and
 * folders, and voxels whose header never appeared. What belongs to a process that runs, or to another machine, stays,
 * as do the files of jobs and those of others. Errors are ignored. */
void
RemoveLeftovers(const std::filesystem::path & folder);

/** The same in the folders of all outputs. */
void
RemoveLeftovers(const std::vector<OutputRequest> & outputs);

} // end namespace medialvoxel

#endif
