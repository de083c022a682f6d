// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSeriesImageIO_h
#define medialvoxelSeriesImageIO_h

#include "VolumeHeader.h"

#include "itkStreamingRawImageIO.h"

#include <cstdint>

namespace medialvoxel
{

/** Makes a reader of any region of a series that ReadVolumeHeader() has checked: decodes the slices that it crosses,
 * unless other readers of the volume decoded them shortly before. Its errors are JobError. */
itk::StreamingRawImageIO::Pointer
MakeSeriesImageIO(const VolumeHeader & header);

/** Memory that the readers of a series take, with the slices that are kept. */
std::uint64_t
GetSeriesMemory(const VolumeHeader & header, unsigned int threads);

} // end namespace medialvoxel

#endif
