// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSlabPlan.h"
#include "itkMedialVoxelTileBalance.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelBox;
using itk::MedialVoxelTileBalance;

/** True when each voxel of \a whole is in one of the boxes, in columns as wide as the whole. */
bool
IsCutIntoRows(const MedialVoxelBox & whole, const std::vector<MedialVoxelBox> & boxes)
{
  std::vector<int> counts(static_cast<std::size_t>(whole.NumberOfVoxels()), 0);
  for (const MedialVoxelBox & box : boxes)
  {
    if (!whole.Contains(box) || box.IsEmpty())
    {
      return false;
    }
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) { ++counts[static_cast<std::size_t>(whole.OffsetOf(v))]; });
  }
  return std::all_of(counts.begin(), counts.end(), [](const int count) { return count == 1; });
}

} // namespace

TEST(MedialVoxelTileBalance, PartsOfATileAreAllOfItOnce)
{
  std::mt19937 generator(3);
  for (int i = 0; i < 300; ++i)
  {
    const MedialVoxelBox tile = RandomBox({ { 5, 150, 40 } }, generator);
    const auto           number = static_cast<std::int64_t>(generator() % 70);
    const auto           parts = MedialVoxelTileBalance::Split(tile, number);
    EXPECT_TRUE(IsCutIntoRows(tile, parts));
    EXPECT_LE(static_cast<std::int64_t>(parts.size()), std::max<std::int64_t>(1, number));
    for (const MedialVoxelBox & part : parts)
    {
      EXPECT_EQ(part.Extent(0), tile.Extent(0));
      EXPECT_GE(part.Extent(1), std::min<std::int64_t>(16, tile.Extent(1)));
      EXPECT_GE(part.Extent(2), std::min<std::int64_t>(4, tile.Extent(2)));
    }
  }
}

TEST(MedialVoxelTileBalance, TilesKeepTheirVoxelsWhateverIsKnown)
{
  std::mt19937 generator(5);
  for (int i = 0; i < 100; ++i)
  {
    const MedialVoxelBox   region = RandomBox({ { 40, 150, 40 } }, generator);
    const auto             tiles = itk::MedialVoxelCutIntoTiles(region, { { 64, 32, 8 } });
    MedialVoxelTileBalance balance;
    for (const MedialVoxelBox & tile : tiles)
    {
      if (generator() % 3 != 0)
      {
        balance.Record(tile, 2, 1e-6 * static_cast<double>(generator() % 1000));
      }
    }
    const auto workers = static_cast<unsigned int>(1 + generator() % 100);
    const auto balanced = balance.Balance(tiles, { 2, workers, generator() % 2 == 0, generator() % 2 == 0 });
    EXPECT_TRUE(IsCutIntoRows(region, balanced));
    if (workers < MedialVoxelTileBalance::ManyWorkers)
    {
      EXPECT_EQ(balanced.size(), tiles.size());
    }
  }
}

TEST(MedialVoxelTileBalance, VeryLongTilesComeFirst)
{
  const auto tiles = itk::MedialVoxelCutIntoTiles(MakeBox({ { 0, 0, 0 } }, { { 64, 128, 8 } }), { { 64, 32, 8 } });
  const auto next = itk::MedialVoxelCutIntoTiles(MakeBox({ { 0, 0, 8 } }, { { 64, 128, 12 } }), { { 64, 32, 8 } });
  MedialVoxelTileBalance balance;
  EXPECT_EQ(balance.Balance(tiles, { 2, 2, false, false }), tiles);
  for (const std::size_t i : { 0u, 1u, 2u, 3u })
  {
    balance.Record(tiles[i], 2, i == 2 ? 9.0 : static_cast<double>(i));
  }
  const std::vector<MedialVoxelBox> expected{ next[2], next[3], next[1], next[0] };
  EXPECT_EQ(balance.Balance(next, { 2, 2, false, true }), expected);
}

TEST(MedialVoxelTileBalance, NeighborsFollowEachOtherAndWorkersEndTogether)
{
  const auto   tiles = itk::MedialVoxelCutIntoTiles(MakeBox({ { 0, 0, 0 } }, { { 64, 16384, 8 } }), { { 64, 32, 8 } });
  std::mt19937 generator(7);
  MedialVoxelTileBalance                  balance;
  std::map<itk::MedialVoxelIndex, double> seconds;
  for (const MedialVoxelBox & tile : tiles)
  {
    seconds[tile.lower] = static_cast<double>(1 + generator() % 20) / 20.0;
    balance.Record(tile, 2, seconds[tile.lower]);
  }
  for (const unsigned int workers : { 2u, 4u, 16u })
  {
    const auto          balanced = balance.Balance(tiles, { 2, workers, false, true });
    std::vector<double> ends(workers, 0.0);
    double              sum = 0.0;
    std::size_t         neighbors = 0;
    for (std::size_t i = 0; i < balanced.size(); ++i)
    {
      *std::min_element(ends.begin(), ends.end()) += seconds[balanced[i].lower];
      sum += seconds[balanced[i].lower];
      neighbors += i > 0 && balanced[i].lower[1] == balanced[i - 1].upper[1] ? 1 : 0;
    }
    // Tiles take at most a second.
    EXPECT_LE(*std::max_element(ends.begin(), ends.end()), sum / workers + 0.15) << workers;
    if (workers == 2)
    {
      EXPECT_GE(neighbors, tiles.size() * 3 / 4);
    }
  }
}

TEST(MedialVoxelTileBalance, ManyWorkersDoNotWaitForTheLongestTile)
{
  const auto tiles = itk::MedialVoxelCutIntoTiles(MakeBox({ { 0, 0, 0 } }, { { 64, 2048, 32 } }), { { 64, 32, 32 } });
  MedialVoxelTileBalance balance;
  for (const MedialVoxelBox & tile : tiles)
  {
    balance.Record(tile, 2, 1.0);
  }
  balance.Record(tiles[7], 2, 40.0);
  const auto balanced = balance.Balance(tiles, { 2, 32, false, false });
  // Two parts of each tile are four for a worker; the longest has more.
  EXPECT_EQ(balanced.size(), 2 * (tiles.size() - 1) + 16);
  EXPECT_TRUE(tiles[7].Contains(balanced.front()));
  // Deferred tiles are few and long.
  EXPECT_EQ(balance.Balance({ tiles[0], tiles[1] }, { 2, 32, true, false }).size(), 32u);
}
