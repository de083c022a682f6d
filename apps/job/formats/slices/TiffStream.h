// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffStream_h
#define medialvoxelTiffStream_h

#include "VoxelStream.h"

#include <memory>

namespace medialvoxel
{

/** The voxels of a compressed stack, unpacked strip by strip. */
std::unique_ptr<VoxelStream>
OpenTiffStream(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
