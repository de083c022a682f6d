// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelThicknessPreview_h
#define medialvoxelThicknessPreview_h

#include "VoxelOutput.h"
#include "ColorRange.h"
#include "PreviewCanvas.h"
#include "Survey.h"

#include <cstdint>
#include <string>

namespace medialvoxel
{

/** Memory that drawing takes beside the survey and GetPreviewMemory(). */
std::uint64_t
GetThicknessPreviewMemory(const VolumeGeometry & geometry);

/** Draws a finished thickness map in the views of DrawPreview(): object gray, medial cells in colors of the thickness;
 * unpaired cells are object. Where more cells fall together the thickest counts, in the projection the thickest along
 * the ray. */
Canvas
DrawThicknessPreview(const VoxelOutput &    labels,
                     const VoxelOutput &    thicknesses,
                     const VolumeGeometry & geometry,
                     const Survey &         survey,
                     const ColorRange &     colors);

} // end namespace medialvoxel

#endif
