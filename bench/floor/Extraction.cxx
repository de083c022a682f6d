// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-filter: the filter alone, labels of thickness 3 of a volume that is in memory.

#include "FloorImage.h"

#include "itkMedialVoxelImageFilter.h"

int
main(int argc, char * argv[])
{
  return RunOnVolume("medialvoxel-filter", argc, argv, [](InputImageType * const image) {
    const auto filter = itk::MedialVoxelImageFilter<InputImageType>::New();
    filter->SetInput(image);
    filter->SetThickness(3.0);
    MeasureFilter(*filter);
  });
}
