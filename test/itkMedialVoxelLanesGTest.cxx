// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Kernels that are compiled without the vectors of a compiler give the bytes of those of the library.

#include "itkMedialVoxelDistanceTransform.h"
#include "itkMedialVoxelFitSums.h"
#include "itkMedialVoxelGrayNormals.h"

#include "MedialVoxelTestVersions.h"

// The same sources once more, under other names.
#define MEDIALVOXEL_PLAIN_LANES
#undef MedialVoxel_EXPORT
#define MedialVoxel_EXPORT
#undef itkMedialVoxelDistanceTransform_h
#undef itkMedialVoxelFitSums_h
#undef itkMedialVoxelGrayNormals_h
#define MedialVoxelDistanceTransform MedialVoxelPlainDistanceTransform
#define MedialVoxelFitSums MedialVoxelPlainFitSums
#define MedialVoxelGrayNormals MedialVoxelPlainGrayNormals
#include "itkMedialVoxelDistanceTransform.cxx"
#include "itkMedialVoxelFitSums.cxx"
#include "itkMedialVoxelGrayNormals.cxx"
#undef MedialVoxelDistanceTransform
#undef MedialVoxelFitSums
#undef MedialVoxelGrayNormals

using namespace MedialVoxelTest;

TEST(MedialVoxelLanes, DistancesHaveTheSameBytesWithoutVectors)
{
  EXPECT_TRUE(AreSame(BytesOf(RecordDistances<itk::MedialVoxelPlainDistanceTransform>),
                      BytesOf(RecordDistances<itk::MedialVoxelDistanceTransform>)));
}

TEST(MedialVoxelLanes, FitsHaveTheSameBytesWithoutVectors)
{
  EXPECT_TRUE(AreSame(BytesOf(RecordFits<itk::MedialVoxelPlainFitSums>), BytesOf(RecordFits<itk::MedialVoxelFitSums>)));
}

TEST(MedialVoxelLanes, NormalsHaveTheSameBytesWithoutVectors)
{
  EXPECT_TRUE(AreSame(BytesOf(RecordNormals<itk::MedialVoxelPlainGrayNormals>),
                      BytesOf(RecordNormals<itk::MedialVoxelGrayNormals>)));
}
