// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEngineSettings.h"

#include "itkMedialVoxelTileObserver.h"

namespace itk
{

void
MedialVoxelExtraction::AddObserver(MedialVoxelTileObserver & observer)
{
  observers.push_back(&observer);
  observerBytesPerVoxel += observer.GetWorkerBytesPerVoxel();
  isObserved = true;
}

} // end namespace itk
