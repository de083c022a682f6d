// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPreviewLayout_h
#define medialvoxelPreviewLayout_h

#include "PreviewCanvas.h"
#include "VolumeHeader.h"

#include <array>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

constexpr unsigned int PreviewGap = 14; ///< pixels between and around the views
constexpr unsigned int PreviewCaptionHeight = TextHeight + 6;

/** Where the views of a preview lie, and how large it is: at most about 1600 pixels along the longer side. */
struct PreviewLayout
{
  /** Areas of the slices across z, y and x and of the projection along z; a volume of two dimensions has one view. */
  std::vector<Rectangle> areas;
  unsigned int           width{ 0 };
  unsigned int           height{ 0 };
  double                 pixelsPerUnit{ 1.0 }; ///< of the spacing, the same in all views and directions
};

PreviewLayout
ArrangePreview(const VolumeGeometry & geometry);

/** First and last + 1 of the voxels that a pixel covers, at least the one at its middle. */
std::array<std::uint64_t, 2>
GetCoveredVoxels(unsigned int pixel, unsigned int numberOfPixels, std::uint64_t numberOfVoxels);

} // end namespace medialvoxel

#endif
