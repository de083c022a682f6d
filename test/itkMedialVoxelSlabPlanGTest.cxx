// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSlabPlan.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

using namespace MedialVoxelTest;

TEST(MedialVoxelSlabPlan, TilesCoverTheRegionOnceAndAreCutAtMultiples)
{
  const Index3 size{ { 40, 21, 18 } };
  std::mt19937 generator(10);
  for (int trial = 0; trial < 40; ++trial)
  {
    const auto region = RandomBox(size, generator);
    const auto upTo = [&generator](unsigned int limit) { return static_cast<std::int64_t>(1 + generator() % limit); };
    const itk::MedialVoxelIndex tileSize{ { upTo(20), upTo(9), upTo(30) } };
    const auto                  tiles = itk::MedialVoxelCutIntoTiles(region, tileSize);
    std::int64_t                voxels = 0;
    for (const auto & tile : tiles)
    {
      EXPECT_FALSE(tile.IsEmpty());
      EXPECT_TRUE(region.Contains(tile));
      voxels += tile.NumberOfVoxels();
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_TRUE(tile.lower[axis] == region.lower[axis] || tile.lower[axis] % tileSize[axis] == 0);
        EXPECT_TRUE(tile.upper[axis] == region.upper[axis] || tile.upper[axis] % tileSize[axis] == 0);
        EXPECT_LE(tile.Extent(axis), tileSize[axis]);
      }
    }
    EXPECT_EQ(voxels, region.NumberOfVoxels());
    for (std::size_t i = 0; i < tiles.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        ASSERT_TRUE(tiles[i].Intersection(tiles[j]).IsEmpty());
      }
    }
  }
  EXPECT_TRUE(itk::MedialVoxelCutIntoTiles(itk::MedialVoxelBox{}, { { 8, 8, 8 } }).empty());
}
