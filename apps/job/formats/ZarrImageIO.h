// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrImageIO_h
#define medialvoxelZarrImageIO_h

#include "VolumeHeader.h"

#include "itkStreamingRawImageIO.h"

namespace medialvoxel
{

/** Reads regions of a Zarr array whose chunks are not packed: of each chunk the slices that are asked for.
 * Read() throws JobError CorruptInput when a chunk has another size than the others. */
itk::StreamingRawImageIO::Pointer
MakeZarrImageIO(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
