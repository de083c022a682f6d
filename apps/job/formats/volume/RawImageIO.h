// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelRawImageIO_h
#define medialvoxelRawImageIO_h

#include "VolumeHeader.h"

#include "itkStreamingRawImageIO.h"

namespace medialvoxel
{

/** Reads regions of voxels that lie one after the other in a file, or in several.
 * Read() throws JobError CorruptInput when a file lost voxels after its header was read. */
itk::StreamingRawImageIO::Pointer
MakeRawImageIO(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
