// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelColorRange_h
#define medialvoxelColorRange_h

#include "LengthHistogram.h"
#include "Options.h"

namespace medialvoxel
{

/** From the first to the 99th percentile; a voxel around the length where these are the same. */
ColorRange
GetColorRange(const LengthHistogram & thickness);

} // end namespace medialvoxel

#endif
