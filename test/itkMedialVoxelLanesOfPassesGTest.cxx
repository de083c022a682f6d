// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Kernels that are compiled without the vectors of a compiler give the bytes of those of the library.

#include "itkMedialVoxelColumnPass.h"
#include "itkMedialVoxelRowPass.h"

#include "MedialVoxelTestVersions.h"

// The same sources once more, under other names.
#define MEDIALVOXEL_PLAIN_LANES
#undef MedialVoxel_EXPORT
#define MedialVoxel_EXPORT
#undef itkMedialVoxelColumnPass_h
#undef itkMedialVoxelRowPass_h
#define MedialVoxelColumnPass MedialVoxelPlainColumnPass
#define MedialVoxelRowPass MedialVoxelPlainRowPass
#include "itkMedialVoxelColumnPass.cxx"
#include "itkMedialVoxelRowPass.cxx"
#undef MedialVoxelColumnPass
#undef MedialVoxelRowPass

using namespace MedialVoxelTest;

TEST(MedialVoxelLanes, ColumnsHaveTheSameBytesWithoutVectors)
{
  EXPECT_TRUE(AreSame(BytesOf(RecordColumns<itk::MedialVoxelPlainColumnPass>),
                      BytesOf(RecordColumns<itk::MedialVoxelColumnPass>)));
}

TEST(MedialVoxelLanes, RowsHaveTheSameBytesWithoutVectors)
{
  EXPECT_TRUE(AreSame(BytesOf(RecordRows<itk::MedialVoxelPlainRowPass>), BytesOf(RecordRows<itk::MedialVoxelRowPass>)));
}
