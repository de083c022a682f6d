// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Kernels that are compiled without the vectors of a compiler give the bytes of those of the library.

#include "itkMedialVoxelFitSums.h"
#include "itkMedialVoxelGrayNormals.h"

#include "MedialVoxelTestVersions.h"

// The same sources once more, under other names.
#undef itkMedialVoxelFitSums_h
#undef itkMedialVoxelGrayNormals_h
#define MEDIALVOXEL_PLAIN_LANES
#define MedialVoxelFitSums MedialVoxelPlainFitSums
#define MedialVoxelGrayNormals MedialVoxelPlainGrayNormals
#include "itkMedialVoxelFitSums.cxx"
#include "itkMedialVoxelGrayNormals.cxx"
#undef MedialVoxelFitSums
#undef MedialVoxelGrayNormals

using namespace MedialVoxelTest;

TEST(MedialVoxelLanes, FitsHaveTheSameBytesWithoutVectors)
{
  Bytes vectors;
  Bytes plain;
  RecordFits<itk::MedialVoxelFitSums>(vectors);
  RecordFits<itk::MedialVoxelPlainFitSums>(plain);
  EXPECT_TRUE(AreSame(plain, vectors));
}

TEST(MedialVoxelLanes, NormalsHaveTheSameBytesWithoutVectors)
{
  Bytes vectors;
  Bytes plain;
  RecordNormals<itk::MedialVoxelGrayNormals>(vectors);
  RecordNormals<itk::MedialVoxelPlainGrayNormals>(plain);
  EXPECT_TRUE(AreSame(plain, vectors));
}
