// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLeftovers_h
#define medialvoxelLeftovers_h

#include "OutputRequest.h"

#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** Removes leftovers of killed runs of this user on this machine from a folder: temporary files and folders, and
 * voxels whose header never appeared. Files of running processes, other machines, jobs and other users stay. Errors
 * are ignored. */
void
RemoveLeftovers(const std::filesystem::path & folder);

/** The same in the folders of all outputs. */
void
RemoveLeftovers(const std::vector<OutputRequest> & outputs);

} // end namespace medialvoxel

#endif
