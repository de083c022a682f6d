// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSums.h"

namespace itk
{

MedialVoxelSums &
MedialVoxelSums::operator+=(const MedialVoxelSums & other)
{
  counts += other.counts;
  voxelsAtMaximum += other.voxelsAtMaximum;
  voxelsWithoutWall += other.voxelsWithoutWall;
  localThickness += other.localThickness;
  recomputedVoxels += other.recomputedVoxels;
  distanceSeconds += other.distanceSeconds;
  classificationSeconds += other.classificationSeconds;
  threadSeconds += other.threadSeconds;
  tileSeconds += other.tileSeconds;
  return *this;
}

} // end namespace itk
