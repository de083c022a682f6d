// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzVolume_h
#define FuzzVolume_h

#include "FuzzSupport.h"

#include "VolumeHeader.h"

namespace MedialVoxelFuzz
{

/** The program's way into a file: the header, what is printed of it, and the voxels of small volumes. Errors are those
 * that the program has words and a status for, and what is read holds what VolumeHeader promises. */
void
ReadVolume(const InputFile & file, const std::optional<medialvoxel::RawDescription> & raw = std::nullopt);

} // namespace MedialVoxelFuzz

#endif
