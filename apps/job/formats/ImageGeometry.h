// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelImageGeometry_h
#define medialvoxelImageGeometry_h

#include "VolumeHeader.h"

namespace medialvoxel
{

/** Describes an image that a source is about to make. */
template <typename TImage>
void
SetImageGeometry(const VolumeGeometry & geometry, TImage & image)
{
  typename TImage::SizeType      size;
  typename TImage::SpacingType   spacing;
  typename TImage::PointType     origin;
  typename TImage::DirectionType direction;
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    size[axis] = geometry.size[axis];
    spacing[axis] = geometry.spacing[axis];
    origin[axis] = geometry.origin[axis];
    for (unsigned int row = 0; row < TImage::ImageDimension; ++row)
    {
      direction[row][axis] = geometry.direction[axis][row];
    }
  }
  image.SetLargestPossibleRegion(size);
  image.SetSpacing(spacing);
  image.SetOrigin(origin);
  image.SetDirection(direction);
}

} // end namespace medialvoxel

#endif
