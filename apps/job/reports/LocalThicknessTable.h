// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLocalThicknessTable_h
#define medialvoxelLocalThicknessTable_h

#include "JobResult.h"
#include "Options.h"
#include "Text.h"

namespace medialvoxel
{

/** The diameter at which balls are cut, as in the map. */
float
GetLargestBall(const ExtractOptions & options, const VolumeHeader & input);

/** A row for a reader, of the map over the object voxels that have a thickness; none without the map or these. */
TextTable
DescribeLocalThickness(const ExtractOptions & options, const JobResult & result);

} // end namespace medialvoxel

#endif
