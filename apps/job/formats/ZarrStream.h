// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrStream_h
#define medialvoxelZarrStream_h

#include "VoxelStream.h"

namespace medialvoxel
{

/** Opens a Zarr array of packed chunks, which are unpacked a layer at a time. */
std::unique_ptr<VoxelStream>
OpenZarrStream(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
