// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffImageIO_h
#define medialvoxelTiffImageIO_h

#include "VolumeHeader.h"

#include "itkStreamingRawImageIO.h"

namespace medialvoxel
{

/** Reads parts of a stack that is not compressed: strips where they lie, tiles by libtiff, one row of them at a time.
 * What is read of tiles is in the byte order of the machine.
 * \throw JobError CorruptInput for a stack that changed since its header was read */
itk::StreamingRawImageIO::Pointer
MakeTiffImageIO(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
