// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEngineSettings.h"

#include "itkMedialVoxelTileObserver.h"

#include <algorithm>

namespace itk
{

void
MedialVoxelSheetExtraction::AddObserver(MedialVoxelTileObserver & observer)
{
  observers.push_back(&observer);
  observerBytesPerVoxel += observer.GetBytesPerVoxel();
  isObserved = true;
}

double
MedialVoxelLocalThickness::GetDefaultMaximum(const MedialVoxelGrid & grid)
{
  double largest = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    largest = grid.IsActive(axis) ? std::max(largest, grid.GetSpacing()[axis]) : largest;
  }
  return std::min(DefaultVoxels * (largest > 0.0 ? largest : 1.0), GetLargestMaximum(grid));
}

double
MedialVoxelLocalThickness::GetLargestMaximum(const MedialVoxelGrid & grid)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    smallest = grid.IsActive(axis) ? std::min(smallest, grid.GetSpacing()[axis]) : smallest;
  }
  return MostVoxels * smallest;
}

} // end namespace itk
