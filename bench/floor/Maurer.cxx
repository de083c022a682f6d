// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-maurer: ITK's exact distance transform on the same input, to measure the distance phase against.
// Reads a headerless volume of unsigned bytes whole and computes squared distances to the object's border.

#include "FloorImage.h"

#include "itkSignedMaurerDistanceMapImageFilter.h"

int
main(int argc, char * argv[])
{
  return RunOnVolume("medialvoxel-maurer", argc, argv, [](InputImageType * const image) {
    const auto filter = itk::SignedMaurerDistanceMapImageFilter<InputImageType, itk::Image<float, 3>>::New();
    filter->SetInput(image);
    filter->SquaredDistanceOn();
    filter->UseImageSpacingOff();
    MeasureFilter(*filter);
  });
}
