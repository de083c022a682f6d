// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The stage after the labels: tiles of any size in any order give the cells of the whole volume.

#include "itkMedialVoxelCellLevels.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelSameTopology.h"

#include "MedialVoxelTestTopology.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

namespace
{
using namespace MedialVoxelTest;

itk::MedialVoxelBits
BitsOf(const Values & values, const itk::MedialVoxelBox & box)
{
  itk::MedialVoxelBits bits(box);
  ForEachIndex(box, [&](const auto & index) {
    if (values.Get(index) != 0)
    {
      bits.Set(index);
    }
  });
  return bits;
}

/** Boxes of an edge that cover all of another one. */
std::vector<itk::MedialVoxelBox>
CutIntoTiles(const itk::MedialVoxelBox & whole, const itk::MedialVoxelIndex & edge)
{
  std::vector<itk::MedialVoxelBox> tiles;
  ForEachIndex(whole, [&](const auto & lower) {
    if (lower[0] % edge[0] == 0 && lower[1] % edge[1] == 0 && lower[2] % edge[2] == 0)
    {
      tiles.push_back(
        itk::MedialVoxelBox{ lower, { { lower[0] + edge[0], lower[1] + edge[1], lower[2] + edge[2] } } }.Intersection(
          whole));
    }
  });
  return tiles;
}

void
GiveTile(const Scene & scene, const itk::MedialVoxelBox & box, itk::MedialVoxelSameTopology & topology)
{
  std::vector<std::uint8_t>  labels;
  std::vector<std::uint16_t> levels;
  ForEachIndex(box, [&](const auto & cell) {
    labels.push_back(scene.medial.Get(cell) != 0 ? itk::MedialVoxelLabel::MedialByGeodesic
                                                 : itk::MedialVoxelLabel::NonMedial);
    levels.push_back(static_cast<std::uint16_t>(scene.levels.Get(cell)));
  });
  const auto object = BitsOf(scene.object, box.Expanded({ { 3, 2, 1 } }).Intersection(scene.object.GetBox()));

  itk::MedialVoxelTileResult tile;
  tile.box = box;
  tile.isEmpty = !object.Any({ box.lower, { { box.upper[0] + 1, box.upper[1] + 1, box.upper[2] + 1 } } });
  if (!tile.isEmpty)
  {
    tile.object = &object;
    tile.labels = labels.data();
    tile.levels = &levels;
  }
  topology.TakeTile(tile);
}

/** Counted by slices, and in loops over the whole volume. */
void
ExpectBettiNumbers(const itk::MedialVoxelSameTopology & topology,
                   const Scene &                        scene,
                   const std::uint64_t                  maximumPoreSize,
                   Values                               cells)
{
  const Values filled = FillInLoops(scene.object, maximumPoreSize);
  ForEachIndex(cells.GetBox(), [&](const auto & cell) { cells.Set(cell, cells.Get(cell) + scene.medial.Get(cell)); });
  const auto ofObject = FindBettiNumbersOfVoxels(filled);
  const auto ofCells = FindBettiNumbers(filled, cells);
  if (scene.object.GetBox().upper[2] > 1)
  {
    EXPECT_TRUE((topology.GetSums().object == itk::MedialVoxelBettiNumbers{ ofObject[0], ofObject[1], ofObject[2] }));
  }
  EXPECT_TRUE((topology.GetSums().cells == itk::MedialVoxelBettiNumbers{ ofCells[0], ofCells[1], ofCells[2] }));
  EXPECT_TRUE(topology.GetSums().cells == topology.GetSums().object);
}

/** The cells that threads find who share the tiles. */
Values
FindAdded(const Scene &                            scene,
          const std::uint64_t                      maximumPoreSize,
          const std::vector<itk::MedialVoxelBox> & tiles,
          const unsigned int                       numberOfThreads)
{
  Values                       result(scene.object.GetBox().upper);
  std::uint64_t                number = 0;
  itk::MedialVoxelSameTopology topology(
    GridOf(scene.object.GetBox().upper), maximumPoreSize, [&](const itk::MedialVoxelBits & added) {
      ForEachIndex(added.GetBox(), [&](const auto & cell) { result.Set(cell, added.Test(cell) ? 1 : 0); });
      number += added.Count(added.GetBox());
    });
  std::atomic<std::size_t> next{ 0 };
  std::vector<std::thread> threads;
  for (unsigned int i = 0; i < numberOfThreads; ++i)
  {
    threads.emplace_back([&] {
      for (std::size_t tile = next++; tile < tiles.size(); tile = next++)
      {
        GiveTile(scene, tiles[tile], topology);
      }
    });
  }
  for (std::thread & thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(topology.GetSums().addedCells, number);
  ExpectBettiNumbers(topology, scene, maximumPoreSize, result);
  return result;
}

Scene
MakeScene(const itk::MedialVoxelIndex & size, const unsigned int seed)
{
  std::mt19937 generator(seed);
  Scene        scene(size);
  for (int i = 0; i < 25; ++i)
  {
    itk::MedialVoxelBox box;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = static_cast<std::int64_t>(generator() % static_cast<unsigned int>(size[axis]));
      box.upper[axis] = std::min<std::int64_t>(size[axis], box.lower[axis] + 1 + generator() % 9);
    }
    ForEachIndex(box, [&](const auto & v) { scene.object.Set(v, i % 3 == 2 ? 0 : 1); });
  }
  ForEachIndex(GridOf(size).GetCellBox(), [&](const auto & cell) {
    scene.medial.Set(cell, VoxelsAround(scene.object, cell) != 0 && generator() % 5 == 0 ? 1 : 0);
    scene.levels.Set(cell, static_cast<int>(generator() % 6));
  });
  return scene;
}

TEST(MedialVoxelSameTopology, TilesGiveTheCellsOfTheWholeVolume)
{
  int added = 0;
  for (const itk::MedialVoxelIndex & size : { itk::MedialVoxelIndex{ { 70, 12, 11 } },
                                              itk::MedialVoxelIndex{ { 13, 14, 20 } },
                                              itk::MedialVoxelIndex{ { 30, 25, 1 } } })
  {
    for (unsigned int seed = 1; seed <= 4; ++seed)
    {
      const Scene         scene = MakeScene(size, seed);
      const std::uint64_t maximumPoreSize = seed % 2 == 0 ? 6 : 0;
      Scene               filled = scene;
      filled.object = FillInLoops(scene.object, maximumPoreSize);
      const Values kept = ThinInLoops(filled);
      Values       expected(size);
      ForEachIndex(scene.object.GetBox(), [&](const auto & cell) {
        expected.Set(cell, kept.Get(cell) != 0 && scene.medial.Get(cell) == 0 ? 1 : 0);
        added += expected.Get(cell);
      });
      for (const itk::MedialVoxelIndex & edge : { itk::MedialVoxelIndex{ { 100, 100, 100 } },
                                                  itk::MedialVoxelIndex{ { 100, 100, 1 } },
                                                  itk::MedialVoxelIndex{ { 7, 5, 3 } } })
      {
        auto tiles = CutIntoTiles(scene.object.GetBox(), edge);
        EXPECT_TRUE(FindAdded(scene, maximumPoreSize, tiles, 1) == expected) << edge[0] << ' ' << seed;
        std::shuffle(tiles.begin(), tiles.end(), std::mt19937(seed));
        EXPECT_TRUE(FindAdded(scene, maximumPoreSize, tiles, 4) == expected) << edge[0] << ' ' << seed;
      }
    }
  }
  EXPECT_GT(added, 200);
}

/** Against the nearest background voxel of each corner, from loops over the whole volume. */
TEST(MedialVoxelSameTopology, LevelsAreDistancesOfTheNearestCorner)
{
  const itk::MedialVoxelIndex size{ { 13, 12, 11 } };
  for (const itk::MedialVoxelGrid::SpacingType & spacing : { itk::MedialVoxelGrid::SpacingType{ { 0.3, 0.3, 0.3 } },
                                                             itk::MedialVoxelGrid::SpacingType{ { 0.7, 1.1, 1.3 } } })
  {
    const itk::MedialVoxelGrid grid(size, spacing);
    const Values               object = MakeScene(size, 9).object;
    itk::MedialVoxelFeatures   features;
    features.Reset(object.GetBox());
    Values squares(size); // of distances in hundredths of the unit of the spacing
    ForEachIndex(object.GetBox(), [&](const auto & v) {
      double nearest = std::numeric_limits<double>::infinity();
      ForEachIndex(object.GetBox(), [&](const auto & other) {
        const double length = grid.SquaredMetricLength(other[0] - v[0], other[1] - v[1], other[2] - v[2]);
        if (object.Get(other) == 0 && length < nearest)
        {
          nearest = length;
          const std::size_t offset = features.OffsetOf(v[0], v[1], v[2]);
          features.dx[offset] = static_cast<std::int32_t>(other[0] - v[0]);
          features.dy[offset] = static_cast<std::int32_t>(other[1] - v[1]);
          features.dz[offset] = static_cast<std::int32_t>(other[2] - v[2]);
          squares.Set(v, static_cast<int>(std::lround(100.0 * length)));
        }
      });
    });
    const double               smallest = grid.HasEqualSpacing() ? 1.0 : 0.7;
    std::vector<std::uint16_t> levels;
    itk::MedialVoxelCellLevels(grid).Compute(object.GetBox(), BitsOf(object, object.GetBox()), features, levels);
    int deepest = 0;
    ForEachIndex(grid.GetCellBox(), [&](const auto & cell) {
      int square = std::numeric_limits<int>::max();
      ForEachIndex(itk::MedialVoxelBox{ cell, { { cell[0] + 2, cell[1] + 2, cell[2] + 2 } } },
                   [&](const auto & corner) { square = std::min(square, squares.Get(corner)); });
      int level = 0;
      while (std::lround(100.0 * (level + 1) * (level + 1) * smallest * smallest) <= square)
      {
        ++level;
      }
      EXPECT_EQ(levels[object.GetBox().OffsetOf(cell)], level);
      deepest = std::max(deepest, level);
    });
    EXPECT_GE(deepest, 2);
  }
}

} // namespace
