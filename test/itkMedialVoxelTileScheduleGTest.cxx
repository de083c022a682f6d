// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelTileSchedule.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace
{
using namespace MedialVoxelTest;

std::vector<itk::MedialVoxelBox>
SomeTiles()
{
  return itk::MedialVoxelCutIntoTiles(MakeBox({ { 3, 2, 1 } }, { { 40, 21, 18 } }), { { 8, 5, 4 } });
}
} // namespace

TEST(MedialVoxelTileSchedule, TilesCoverTheRegionOnceAndAreCutAtMultiples)
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

TEST(MedialVoxelTileSchedule, EachTileIsTakenOnceByAnyNumberOfThreads)
{
  for (const unsigned int threads : { 1u, 2u, 7u })
  {
    const auto                                    tiles = SomeTiles();
    itk::MedialVoxelTileSchedule                  schedule(tiles);
    std::vector<std::vector<itk::MedialVoxelBox>> taken(threads);
    std::vector<std::thread>                      workers;
    EXPECT_EQ(schedule.GetNumberOfTiles(), tiles.size());
    for (unsigned int t = 0; t < threads; ++t)
    {
      workers.emplace_back([&schedule, &taken, t]() {
        itk::MedialVoxelBox tile;
        while (schedule.Next(tile))
        {
          taken[t].push_back(tile);
        }
      });
    }
    std::size_t total = 0;
    for (unsigned int t = 0; t < threads; ++t)
    {
      workers[t].join();
      total += taken[t].size();
    }
    EXPECT_EQ(total, tiles.size());
    for (const auto & tile : tiles)
    {
      std::ptrdiff_t times = 0;
      for (const auto & list : taken)
      {
        times += std::count(list.begin(), list.end(), tile);
      }
      EXPECT_EQ(times, 1);
    }
    itk::MedialVoxelBox tile;
    EXPECT_FALSE(schedule.Next(tile));
  }
}

TEST(MedialVoxelTileSchedule, DeferredTilesAndTheirNeedsAreKept)
{
  const auto                   tiles = SomeTiles();
  itk::MedialVoxelTileSchedule schedule(tiles);
  EXPECT_TRUE(schedule.GetDeferredTiles().empty());
  EXPECT_TRUE(schedule.GetNeededBox().IsEmpty());
  schedule.Defer(tiles[2], MakeBox({ { 0, 1, 2 } }, { { 9, 9, 9 } }));
  schedule.Defer(tiles[5], MakeBox({ { 4, 0, 4 } }, { { 30, 6, 7 } }));
  const std::vector<itk::MedialVoxelBox> expected{ tiles[2], tiles[5] };
  EXPECT_EQ(schedule.GetDeferredTiles(), expected);
  EXPECT_EQ(schedule.GetNeededBox(), MakeBox({ { 0, 0, 2 } }, { { 30, 9, 9 } }));
}

TEST(MedialVoxelTileSchedule, StopEndsTheWork)
{
  itk::MedialVoxelTileSchedule schedule(SomeTiles());
  itk::MedialVoxelBox          tile;
  EXPECT_TRUE(schedule.Next(tile));
  schedule.Stop();
  EXPECT_FALSE(schedule.Next(tile));
  EXPECT_NO_THROW(schedule.RethrowFailure());
}

TEST(MedialVoxelTileSchedule, TheFirstFailureStopsAndReachesTheCaller)
{
  itk::MedialVoxelTileSchedule schedule(SomeTiles());
  schedule.Fail(std::make_exception_ptr(std::runtime_error("first")));
  schedule.Fail(std::make_exception_ptr(std::runtime_error("second")));
  itk::MedialVoxelBox tile;
  EXPECT_FALSE(schedule.Next(tile));
  try
  {
    schedule.RethrowFailure();
    FAIL() << "no exception";
  }
  catch (const std::runtime_error & error)
  {
    EXPECT_STREQ(error.what(), "first");
  }
}
