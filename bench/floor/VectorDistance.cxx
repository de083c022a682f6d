// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-vector-distance: vectors to the object's border, inside the object, of a volume that is in memory.
// The vector image is written, as SignedMaurer writes its image of distances.

#include "FloorImage.h"

#include "itkVectorDistanceMapImageFilter.h"

int
main(int argc, char * argv[])
{
  return RunOnVolume("medialvoxel-vector-distance", argc, argv, [](InputImageType * const image) {
    const auto filter = itk::VectorDistanceMapImageFilter<InputImageType>::New();
    filter->SetInput(image);
    filter->SetRegion(itk::MedialVoxelRegion::Inside);
    filter->UseImageSpacingOff();
    MeasureFilter(*filter);
  });
}
