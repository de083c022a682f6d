// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPreview_h
#define medialvoxelPreview_h

#include "VoxelOutput.h"
#include "PreviewCanvas.h"
#include "Survey.h"

#include <cstdint>

namespace medialvoxel
{

/** Memory that drawing takes beside the survey. */
std::uint64_t
GetPreviewMemory(const VolumeGeometry & geometry);

/** Draws a finished label volume: three slices through the densest places, which the survey knows, and the projection
 * along the last axis. Object gray, medial red, added for the topology yellow; in the projection the largest label
 * along the ray, the brighter the more medial cells there are on it. The scale is the same in all views and directions.
 * Only the labels of these slices are read. A volume of two dimensions is one view. */
Canvas
DrawPreview(const VoxelOutput & labels, const VolumeGeometry & geometry, const Survey & survey);

} // end namespace medialvoxel

#endif
