// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelParameters.h"

namespace itk
{

double
MedialVoxelParameters::EpsilonFromThickness(const double thickness)
{
  constexpr double pi = 3.14159265358979323846;
  return pi * thickness / 2.0;
}

MedialVoxelCounts &
MedialVoxelCounts::operator+=(const MedialVoxelCounts & other)
{
  objectVoxels += other.objectVoxels;
  boundaryVoxels += other.boundaryVoxels;
  notANumberVoxels += other.notANumberVoxels;
  candidateCells += other.candidateCells;
  trivialCells += other.trivialCells;
  boundCells += other.boundCells;
  geodesicMedialCells += other.geodesicMedialCells;
  geodesicNonMedialCells += other.geodesicNonMedialCells;
  return *this;
}

} // end namespace itk
