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

} // namespace

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
    objects[voxel] = static_cast<Adjacency::ObjectType>(voxel + 1);
  }
  const auto passes = FindPasses(size, objects, objects.size());
  for (std::size_t first = 0; first < objects.size(); ++first)
  {
    for (std::size_t second = 0; second < first; ++second)
    {
      if (FindDistance(size, objects, objects[first], objects[second]) <= Adjacency::GetReach(size, 0))
      {
        EXPECT_NE(passes[first + 1], passes[second + 1]);
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
