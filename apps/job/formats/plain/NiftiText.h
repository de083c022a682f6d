// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelNiftiText_h
#define medialvoxelNiftiText_h

#include "VoxelLayout.h"

#include <cstdint>
#include <string>

namespace medialvoxel
{

/** Most voxels along an axis of a NIfTI-1 file. */
constexpr std::uint64_t LargestNiftiSize = 32767;

/** Header of a NIfTI-1 file with a volume of one component, up to its first voxel, in the byte order of this machine.
 * The format has numbers of 32 bits for spacing, origin and directions. */
std::string
MakeNiftiHeader(const VolumeGeometry & geometry, const VoxelLayout & layout);

} // end namespace medialvoxel

#endif
