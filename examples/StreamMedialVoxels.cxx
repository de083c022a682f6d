// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkMedialVoxelImageFilter.h"
#include "itkStreamingNrrdImageIOFactory.h"

#include <cstdlib>
#include <iostream>

// StreamMedialVoxels INPUT OUTPUT LOWER-THRESHOLD THICKNESS DIVISIONS: a volume from .mha, .mhd or .nrrd to .mha or
// .nrrd, piece by piece, so that memory holds one piece of it.
int
main(int argc, char * argv[])
try
{
  if (argc != 6)
  {
    std::cerr << "usage: StreamMedialVoxels INPUT OUTPUT LOWER-THRESHOLD THICKNESS DIVISIONS\n";
    return EXIT_FAILURE;
  }
  itk::StreamingNrrdImageIOFactory::RegisterOneFactory();

  using ImageType = itk::Image<unsigned char, 3>;
  auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetFileName(argv[1]);

  auto medialVoxels = itk::MedialVoxelImageFilter<ImageType>::New();
  medialVoxels->SetInput(reader->GetOutput());
  medialVoxels->SetLowerThreshold(std::atof(argv[3]));
  medialVoxels->SetThickness(std::atof(argv[4]));

  auto writer = itk::ImageFileWriter<ImageType>::New();
  writer->SetInput(medialVoxels->GetOutput());
  writer->SetFileName(argv[2]);
  writer->SetNumberOfStreamDivisions(static_cast<unsigned int>(std::atoi(argv[5])));
  writer->Update();

  // The counts add up over the pieces.
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
