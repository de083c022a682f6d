// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkMedialVoxelImageFilter.h"

#include <cstdlib>
#include <iostream>

// ExtractMedialVoxels INPUT OUTPUT LOWER-THRESHOLD THICKNESS: writes the labels of all dual cells.
int
main(int argc, char * argv[])
try
{
  if (argc != 5)
  {
    std::cerr << "usage: ExtractMedialVoxels INPUT OUTPUT LOWER-THRESHOLD THICKNESS\n";
    return EXIT_FAILURE;
  }
  using ImageType = itk::Image<short, 3>;
  auto medialVoxels = itk::MedialVoxelImageFilter<ImageType>::New();
  medialVoxels->SetInput(itk::ReadImage<ImageType>(argv[1]));
  medialVoxels->SetLowerThreshold(std::atof(argv[3]));
  medialVoxels->SetThickness(std::atof(argv[4]));
  itk::WriteImage(medialVoxels->GetOutput(), argv[2]);
  const itk::MedialVoxelCounts counts = medialVoxels->GetCounts();
  std::cout << counts.boundCells + counts.geodesicMedialCells << " medial cells of " << counts.candidateCells
            << " candidates\n";
  return EXIT_SUCCESS;
}
catch (const itk::ExceptionObject & error)
{
  std::cerr << error << '\n';
  return EXIT_FAILURE;
}
