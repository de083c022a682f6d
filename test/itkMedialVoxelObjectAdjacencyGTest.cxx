// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectAdjacency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

namespace
{

using Adjacency = itk::MedialVoxelObjectAdjacency;
using Objects = std::vector<Adjacency::ObjectType>;

std::vector<Adjacency::ObjectType>
FindPasses(const itk::MedialVoxelIndex & size,
           const Objects &               objects,
           const std::size_t             numberOfObjects,
           const std::uint64_t           maximumPoreSize = 0)
{
  Adjacency adjacency(size, maximumPoreSize);
  for (std::size_t row = 0; row < objects.size(); row += static_cast<std::size_t>(size[0]))
  {
    adjacency.AddRow(objects.data() + row);
  }
  return adjacency.MakePasses(numberOfObjects);
}

/** Smallest distance of voxels of two objects, of the differences along the axes the largest one. */
std::int64_t
FindDistance(const itk::MedialVoxelIndex & size,
             const Objects &               objects,
             const Adjacency::ObjectType   first,
             const Adjacency::ObjectType   second)
{
  std::int64_t smallest = size[0] + size[1] + size[2];
  const auto   indexOf = [&](const std::size_t offset) {
    const auto at = static_cast<std::int64_t>(offset);
    return itk::MedialVoxelIndex{ { at % size[0], at / size[0] % size[1], at / size[0] / size[1] } };
  };
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    for (std::size_t j = 0; objects[i] == first && j < objects.size(); ++j)
    {
      if (objects[j] == second)
      {
        const itk::MedialVoxelIndex a = indexOf(i);
        const itk::MedialVoxelIndex b = indexOf(j);
        smallest =
          std::min(smallest, std::max({ std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) }));
      }
    }
  }
  return smallest;
}

/** Blocks of the reach that hold an object, which are close where they are the same or touch. */
std::vector<std::set<itk::MedialVoxelIndex>>
ListBlocks(const itk::MedialVoxelIndex & size,
           const Objects &               objects,
           const std::size_t             count,
           const std::int64_t            edge)
{
  std::vector<std::set<itk::MedialVoxelIndex>> blocks(count + 1);
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    const auto at = static_cast<std::int64_t>(i);
    blocks[objects[i]].insert(
      { { at % size[0] / edge, at / size[0] % size[1] / edge, at / size[0] / size[1] / edge } });
  }
  return blocks;
}

/** The rule of MakePasses() word by word. */
Objects
FindPassesSlowly(const itk::MedialVoxelIndex & size, const Objects & objects, const std::size_t count)
{
  const auto blocks = ListBlocks(size, objects, count, Adjacency::GetReach(size, 0));
  const auto areClose = [&](const std::size_t a, const std::size_t b) {
    return std::any_of(blocks[a].begin(), blocks[a].end(), [&](const auto & one) {
      return std::any_of(blocks[b].begin(), blocks[b].end(), [&](const auto & other) {
        return std::abs(one[0] - other[0]) <= 1 && std::abs(one[1] - other[1]) <= 1 && std::abs(one[2] - other[2]) <= 1;
      });
    });
  };
  std::vector<std::set<std::size_t>> neighbors(count + 1);
  for (std::size_t a = 1; a <= count; ++a)
  {
    for (std::size_t b = 1; b <= count; ++b)
    {
      if (a != b && areClose(a, b))
      {
        neighbors[a].insert(b);
      }
    }
  }
  std::vector<std::set<Adjacency::ObjectType>> taken(count + 1);
  Objects                                      passes(count + 1, 0);
  std::set<std::size_t>                        waiting;
  for (std::size_t object = 1; object <= count; ++object)
  {
    waiting.insert(object);
  }
  while (!waiting.empty())
  {
    const std::size_t next = *std::min_element(waiting.begin(), waiting.end(), [&](std::size_t a, std::size_t b) {
      return taken[a].size() != taken[b].size() ? taken[a].size() > taken[b].size()
                                                : neighbors[a].size() > neighbors[b].size();
    });
    waiting.erase(next);
    while (taken[next].count(passes[next]) > 0)
    {
      ++passes[next];
    }
    for (const std::size_t neighbor : neighbors[next])
    {
      taken[neighbor].insert(passes[next]);
    }
  }
  return passes;
}

} // namespace

TEST(MedialVoxelObjectAdjacency, PassesFollowTheRule)
{
  std::mt19937 generator(3);
  for (unsigned int trial = 0; trial < 40; ++trial)
  {
    const auto roll = [&](const int low, const int high) {
      return low + static_cast<std::int64_t>(generator() % static_cast<unsigned int>(high - low + 1));
    };
    const itk::MedialVoxelIndex size{ { roll(1, 22), roll(1, 20), roll(1, 18) } };
    const auto                  count = static_cast<std::size_t>(roll(2, 110));
    Objects                     objects(static_cast<std::size_t>(size[0] * size[1] * size[2]), 0);
    for (std::size_t voxel = 0; voxel < objects.size(); voxel += static_cast<std::size_t>(1 + trial % 3))
    {
      // Some hold the whole image, others a few voxels.
      objects[voxel] =
        static_cast<Adjacency::ObjectType>(trial % 2 == 0 ? generator() % (count + 1) : voxel * count / objects.size());
    }
    EXPECT_EQ(FindPasses(size, objects, count), FindPassesSlowly(size, objects, count)) << "trial " << trial;
  }
}

TEST(MedialVoxelObjectAdjacency, AGrayScanIsRefusedBeforeItsPairsAreKnown)
{
  // As many values as voxels: the first layer of blocks tells.
  const itk::MedialVoxelIndex size{ { 40, 40, 40 } };
  Adjacency                   adjacency(size, 0);
  Objects                     row(40);
  std::int64_t                rows = 0;
  const auto                  add = [&] {
    for (; rows < size[1] * size[2]; ++rows)
    {
      for (std::size_t x = 0; x < row.size(); ++x)
      {
        row[x] = static_cast<Adjacency::ObjectType>(1 + static_cast<std::size_t>(rows) * row.size() + x);
      }
      adjacency.AddRow(row.data());
    }
  };
  EXPECT_THROW(add(), itk::MedialVoxelLabelError);
  EXPECT_LT(rows, 6 * size[1]);
  // 255 values that are side by side somewhere, but nowhere more than 128 of them.
  Adjacency spread({ { 12, 255, 255 } }, 0);
  for (std::size_t line = 0; line < std::size_t{ 255 } * 255; ++line)
  {
    Objects pair(12, static_cast<Adjacency::ObjectType>(1 + line / 255));
    std::fill(pair.begin() + 6, pair.end(), static_cast<Adjacency::ObjectType>(1 + line % 255));
    spread.AddRow(pair.data());
  }
  EXPECT_THROW(spread.MakePasses(255), itk::MedialVoxelLabelError);
}

TEST(MedialVoxelObjectAdjacency, ReachGrowsUntilNoPoreHoldsAnObject)
{
  const itk::MedialVoxelIndex cube{ { 100, 100, 100 } };
  EXPECT_EQ(Adjacency::GetReach(cube, 0), 3);
  EXPECT_EQ(Adjacency::GetReach(cube, 32), 3); // 3 * 4 * 4 voxels beside an end of an object
  EXPECT_EQ(Adjacency::GetReach(cube, 48), 4);
  EXPECT_EQ(Adjacency::GetReach({ { 100, 100, 1 } }, 32), 6); // 6 * 7
  EXPECT_EQ(Adjacency::GetReach({ { 100, 1, 1 } }, 32), 33);
  EXPECT_EQ(Adjacency::GetReach({ { 10, 1, 1 } }, 32), 10);
}

TEST(MedialVoxelObjectAdjacency, CloseObjectsHaveDifferentPasses)
{
  std::mt19937 generator(7);
  for (unsigned int trial = 0; trial < 60; ++trial)
  {
    const auto roll = [&](const int low, const int high) {
      return low + static_cast<std::int64_t>(generator() % static_cast<unsigned int>(high - low + 1));
    };
    const itk::MedialVoxelIndex size{ { roll(1, 16), roll(1, 16), roll(1, 12) } };
    const auto                  count = static_cast<std::size_t>(roll(2, 9));
    Objects                     objects(static_cast<std::size_t>(size[0] * size[1] * size[2]), 0);
    for (std::size_t voxel = 0; voxel < 2 * count; ++voxel)
    {
      objects[generator() % objects.size()] = static_cast<Adjacency::ObjectType>(1 + voxel % count);
    }
    const auto maximumPoreSize = static_cast<std::uint64_t>(roll(0, 40));
    const auto passes = FindPasses(size, objects, count, maximumPoreSize);
    const auto reach = Adjacency::GetReach(size, maximumPoreSize);
    for (Adjacency::ObjectType first = 1; first <= count; ++first)
    {
      for (Adjacency::ObjectType second = 1; second < first; ++second)
      {
        if (FindDistance(size, objects, first, second) <= reach)
        {
          EXPECT_NE(passes[first], passes[second]) << "trial " << trial;
        }
      }
    }
  }
}

TEST(MedialVoxelObjectAdjacency, BlocksHoldAnyNumberOfObjects)
{
  const itk::MedialVoxelIndex size{ { 12, 7, 8 } };
  Objects                     objects(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  for (std::size_t voxel = 0; voxel < objects.size(); ++voxel)
  {
    objects[voxel] = static_cast<Adjacency::ObjectType>(voxel / 6 + 1);
  }
  const std::size_t count = objects.size() / 6;
  const auto        passes = FindPasses(size, objects, count);
  for (std::size_t first = 0; first < count; ++first)
  {
    for (std::size_t second = 0; second < first; ++second)
    {
      const auto a = static_cast<Adjacency::ObjectType>(first + 1);
      const auto b = static_cast<Adjacency::ObjectType>(second + 1);
      if (FindDistance(size, objects, a, b) <= Adjacency::GetReach(size, 0))
      {
        EXPECT_NE(passes[a], passes[b]);
      }
    }
  }
}

TEST(MedialVoxelObjectAdjacency, BytesAreThoseOfTwoLayersOfBlocks)
{
  EXPECT_EQ(Adjacency::GetBytes({ { 4000, 4000, 4000 } }, 32), 2 * 1334 * 1334 * 8u);
  EXPECT_EQ(Adjacency::GetBytes({ { 10, 1, 1 } }, 32), 2 * 8u);
}

TEST(MedialVoxelObjectAdjacency, FarObjectsShareAPass)
{
  Objects objects(64 * 8 * 8, 0);
  objects[0] = 1;
  objects[30] = 2;
  objects[60] = 3;
  EXPECT_EQ(FindPasses({ { 64, 8, 8 } }, objects, 3), Objects({ 0, 0, 0, 0 }));
}

TEST(MedialVoxelObjectAdjacency, AFlatMapNeedsFewPasses)
{
  // A brick wall: each brick touches six others, three passes suffice.
  const itk::MedialVoxelIndex size{ { 240, 120, 1 } };
  Objects                     objects;
  for (std::int64_t y = 0; y < size[1]; ++y)
  {
    for (std::int64_t x = 0; x < size[0]; ++x)
    {
      const std::int64_t course = y / 12;
      objects.push_back(static_cast<Adjacency::ObjectType>(1 + course * 11 + (x + course % 2 * 12) / 24));
    }
  }
  const std::size_t                     count = *std::max_element(objects.begin(), objects.end());
  const auto                            passes = FindPasses(size, objects, count);
  const std::set<Adjacency::ObjectType> used(passes.begin() + 1, passes.end());
  EXPECT_LE(used.size(), 4u);
}
