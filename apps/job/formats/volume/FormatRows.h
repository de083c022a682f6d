// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFormatRows_h
#define medialvoxelFormatRows_h

#include "VolumeFormat.h"

namespace medialvoxel
{

// The rows of the table in VolumeFormats.cxx, each made in the file that reads its headers.

VolumeFormat
MakeMetaImageFormat();
VolumeFormat
MakeNrrdFormat();
VolumeFormat
MakeNiftiFormat();
VolumeFormat
MakeNiftiPairFormat();
VolumeFormat
MakeZarrFormat();
VolumeFormat
MakeTiffFormat();
VolumeFormat
MakeMrcFormat();
VolumeFormat
MakeKeyedFormat();

/** The format of folders and patterns of images, each of which is a slice. */
VolumeFormat
MakeSeriesFormat();

} // end namespace medialvoxel

#endif
