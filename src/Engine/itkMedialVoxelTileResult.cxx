// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileResult.h"

#include "itkMedialVoxelTileWalls.h"

namespace itk
{

void
MedialVoxelTileResult::WriteThickness(float * const first, const std::array<std::int64_t, 3> & strides) const
{
  MedialVoxelForEachWall(*rows, *walls, [&](const MedialVoxelIndex & cell, const MedialVoxelWall & wall) {
    std::int64_t offset = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      offset += (cell[axis] - box.lower[axis]) * strides[axis];
    }
    first[offset] = wall.GetMarkedThickness();
  });
}

} // end namespace itk
