// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffReaders_h
#define medialvoxelTiffReaders_h

#include "VolumeHeader.h"
#include "VoxelStream.h"

#include "itkStreamingRawImageIO.h"

#include <filesystem>
#include <memory>

namespace medialvoxel
{

/** The header of an image of a series; its description may cover all of them. \throw HeaderError */
VolumeHeader
ReadTiffSliceHeader(const std::filesystem::path & fileName);

/** The voxels of a compressed stack, unpacked strip by strip. */
std::unique_ptr<VoxelStream>
OpenTiffStream(const VolumeHeader & header);

/** Reads regions of a stack that is not compressed: strips where they lie, tiles by libtiff, one row of them at a
 * time. Values of tiles are in the byte order of the machine.
 * \throw JobError CorruptInput for a stack that changed since its header was read */
itk::StreamingRawImageIO::Pointer
MakeTiffImageIO(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
