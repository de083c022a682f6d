// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// What decides pairs with thresholds of their own: components of a box, the search on bits, and both together.

#include "itkMedialVoxelBlockSeparation.h"
#include "itkMedialVoxelBoxComponents.h"
#include "itkMedialVoxelPairSeparation.h"
#include "itkMedialVoxelPathSearch.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

struct Scene
{
  Volume               volume;
  std::vector<Index3>  sites;
  itk::MedialVoxelBits bits;

  explicit Scene(Volume v)
    : volume(std::move(v))
    , sites(BoundarySites(volume))
    , bits(SiteBits(sites, GridOf(volume).GetVoxelBox()))
  {}
};

std::vector<Scene>
Scenes()
{
  std::vector<Scene> scenes;
  scenes.emplace_back(RandomBoxes({ { 26, 21, 20 } }, UnitSpacing, 12, 701));
  scenes.emplace_back(RandomVolume({ { 20, 17, 15 } }, UnitSpacing, 0.03, 702));
  scenes.emplace_back(RandomBoxes({ { 20, 21, 16 } }, { { 0.7, 1.1, 1.3 } }, 10, 703));
  scenes.emplace_back(RandomBoxes({ { 45, 40, 1 } }, UnitSpacing, 11, 704));
  return scenes;
}
/** The same pairs of points for every seed, each with a threshold above its free-space length, and their geodesic
 * distances. */
std::vector<itk::MedialVoxelSeparationQuery>
RandomQueries(const Scene & scene, const unsigned int seed, std::vector<double> & distances)
{
  const BoundaryGraph                          graph(scene.volume, scene.sites);
  const itk::MedialVoxelDualCell               cell(GridOf(scene.volume));
  std::mt19937                                 generator(seed);
  std::vector<itk::MedialVoxelSeparationQuery> queries;
  for (std::size_t i = 0; i < scene.sites.size(); i += scene.sites.size() / 25 + 1)
  {
    const auto fromHere = graph.DistancesFrom(static_cast<int>(i));
    for (std::size_t j = 0; j < scene.sites.size(); j += 7)
    {
      const double epsilon = 3.05 + 0.1 * static_cast<double>(generator() % 130);
      const auto   a = KernelIndex(scene.sites[i]);
      const auto   b = KernelIndex(scene.sites[j]);
      if (i != j && cell.FreeSpaceLength({ { a[0] - b[0], a[1] - b[1], a[2] - b[2] } }) < epsilon)
      {
        queries.push_back({ a, b, epsilon, distances.size() });
        distances.push_back(fromHere[j]);
      }
    }
  }
  return queries;
}

} // namespace

TEST(MedialVoxelBoxComponents, PointsAreConnectedWhenAPathInTheBoxJoinsThem)
{
  std::size_t joined = 0;
  std::size_t apart = 0;
  for (const Scene & scene : Scenes())
  {
    std::mt19937 generator(9);
    for (int trial = 0; trial < 6; ++trial)
    {
      const auto          box = RandomBox(scene.volume.size, generator);
      std::vector<Index3> inside;
      std::copy_if(scene.sites.begin(), scene.sites.end(), std::back_inserter(inside), [&](const Index3 & site) {
        return box.Contains(KernelIndex(site));
      });
      itk::MedialVoxelBoxComponents components;
      components.Label(scene.bits, box);
      const BoundaryGraph graph(scene.volume, inside);
      for (std::size_t i = 0; i < inside.size(); i += 17)
      {
        const auto distances = graph.DistancesFrom(static_cast<int>(i));
        for (std::size_t j = 0; j < inside.size(); ++j)
        {
          const bool isJoined = distances[j] < std::numeric_limits<double>::infinity();
          ++(isJoined ? joined : apart);
          ASSERT_EQ(components.AreConnected(KernelIndex(inside[i]), KernelIndex(inside[j])), isJoined);
        }
      }
    }
  }
  EXPECT_GT(joined, 1000u);
  EXPECT_GT(apart, 100u);
}

TEST(MedialVoxelBlockSeparation, LowerBoundsAreNeverAboveTheDistances)
{
  std::size_t separated = 0;
  std::size_t longer = 0;
  for (const Scene & scene : Scenes())
  {
    const itk::MedialVoxelBlockSeparation      blocks(GridOf(scene.volume));
    itk::MedialVoxelBlockSeparation::Workspace workspace;
    const itk::MedialVoxelNoProgress           progress;
    std::vector<double>                        distances;
    auto                                       queries = RandomQueries(scene, 12, distances);
    // Those that nobody asks for stay as they are.
    queries.front().epsilon = 0.0;
    blocks.Tighten(scene.bits, progress, workspace, queries);
    EXPECT_EQ(queries.front().bounds.shortest, 0.0);
    for (const auto & query : queries)
    {
      ASSERT_LE(query.bounds.shortest, distances[query.cell] * (1.0 + 1e-12));
      ASSERT_EQ(query.bounds.longest, std::numeric_limits<double>::infinity());
      ASSERT_TRUE(query.bounds.shortest == 0.0 || query.bounds.Reach(query.epsilon));
      separated += query.bounds.shortest > 0.0 ? 1 : 0;
      longer += distances[query.cell] >= query.epsilon ? 1 : 0;
    }
  }
  EXPECT_GT(separated, 100u);
  EXPECT_GT(longer, separated);
}

TEST(MedialVoxelBlockSeparation, SidesOfAWallAreSeparated)
{
  // A wall of three voxels across the volume, and pairs of points straight through it.
  const Scene scene(
    MakeVolume({ { 90, 50, 20 } }, UnitSpacing, [](const Index3 & v) { return v[2] > 7 && v[2] < 11; }));
  std::vector<itk::MedialVoxelSeparationQuery> queries;
  for (int y = 0; y < 50; ++y)
  {
    for (int x = 0; x < 90; ++x)
    {
      queries.push_back({ { { x, y, 7 } }, { { x, y, 11 } }, 8.0, 0 });
    }
  }
  itk::MedialVoxelBlockSeparation::Workspace workspace;
  const itk::MedialVoxelBlockSeparation      blocks(GridOf(scene.volume));
  blocks.Tighten(scene.bits, itk::MedialVoxelNoProgress(), workspace, queries);
  EXPECT_TRUE(std::all_of(queries.begin(), queries.end(), [](const auto & query) { return query.bounds.Reach(8.0); }));
  // Nothing is known of what lies beyond the points that a box holds.
  const auto few = SiteBits(scene.sites, MakeBox({ { 0, 0, 0 } }, { { 40, 50, 20 } }));
  for (auto & query : queries)
  {
    query.bounds = {};
  }
  blocks.Tighten(few, itk::MedialVoxelNoProgress(), workspace, queries);
  for (const auto & query : queries)
  {
    ASSERT_TRUE(query.bounds.shortest == 0.0 || query.a[0] < 32);
  }
}

TEST(MedialVoxelPathSearch, LengthsAreThoseOfDijkstra)
{
  for (const Scene & scene : Scenes())
  {
    const BoundaryGraph                   graph(scene.volume, scene.sites);
    const itk::MedialVoxelPathSearch      search(GridOf(scene.volume));
    itk::MedialVoxelPathSearch::Workspace workspace;
    const auto                            image = GridOf(scene.volume).GetVoxelBox();
    const double                          most = 14.0;
    for (std::size_t i = 0; i < scene.sites.size(); i += scene.sites.size() / 6 + 1)
    {
      const auto distances = graph.DistancesFrom(static_cast<int>(i));
      for (std::size_t j = 0; j < scene.sites.size(); j += 9)
      {
        if (i == j)
        {
          continue;
        }
        const auto a = KernelIndex(scene.sites[i]);
        const auto b = KernelIndex(scene.sites[j]);
        const auto length = search.FindLength(scene.bits, image, a, b, 0.0, most, workspace);
        if (distances[j] > most)
        {
          ASSERT_GT(length, most);
        }
        else
        {
          ASSERT_NEAR(length, distances[j], 1e-9);
        }
        const auto any = search.FindLength(scene.bits, image, a, b, 9.0, most, workspace);
        ASSERT_EQ(any < 9.0, distances[j] < 9.0);
      }
    }
  }
}

TEST(MedialVoxelPairSeparation, PairsWithTheirOwnThresholdAreDecidedLikeByDijkstra)
{
  std::size_t separated = 0;
  std::size_t shorter = 0;
  for (const Scene & scene : Scenes())
  {
    const itk::MedialVoxelPairSeparation      separation(GridOf(scene.volume));
    itk::MedialVoxelPairSeparation::Workspace workspace;
    const itk::MedialVoxelNoProgress          progress;
    std::vector<double>                       distances;
    auto                                      queries = RandomQueries(scene, 10, distances);
    EXPECT_TRUE(separation.FindSeparated(scene.bits, progress, workspace, queries).IsEmpty());
    for (auto & query : queries)
    {
      const double distance = distances[query.cell];
      const bool   reaches = distance >= query.epsilon;
      ASSERT_TRUE(reaches || !query.isSeparated);
      ASSERT_LE(query.bounds.shortest, distance * (1.0 + 1e-12));
      ASSERT_EQ(separation.Reaches(scene.bits, query, workspace), reaches);
      ASSERT_LE(query.bounds.shortest, distance * (1.0 + 1e-12));
      ASSERT_GE(query.bounds.longest, distance * (1.0 - 1e-12));
      separated += query.isSeparated ? 1 : 0;
      shorter += reaches ? 0 : 1;
    }
  }
  EXPECT_GT(separated, 100u);
  EXPECT_GT(shorter, 100u);
}

TEST(MedialVoxelPairSeparation, WhatWasFoundForOneThresholdServesOthers)
{
  std::size_t decided = 0;
  for (const Scene & scene : Scenes())
  {
    const itk::MedialVoxelPairSeparation      separation(GridOf(scene.volume));
    itk::MedialVoxelPairSeparation::Workspace workspace;
    for (const unsigned int seed : { 11u, 12u, 13u, 14u })
    {
      std::vector<double> distances;
      for (auto & query : RandomQueries(scene, seed, distances))
      {
        ASSERT_EQ(separation.Reaches(scene.bits, query, workspace), distances[query.cell] >= query.epsilon);
        ++decided;
      }
    }
  }
  EXPECT_GT(decided, 1000u);
}

TEST(MedialVoxelPairSeparation, AnotherBoundaryIsForgotten)
{
  const Scene                               plate(AxisPlate({ { 40, 40, 20 } }, UnitSpacing, 2, 8, 6));
  const auto                                empty = SiteBits({}, GridOf(plate.volume).GetVoxelBox());
  const itk::MedialVoxelPairSeparation      separation(GridOf(plate.volume));
  itk::MedialVoxelPairSeparation::Workspace workspace;
  itk::MedialVoxelSeparationQuery           query{ { { 20, 20, 7 } }, { { 23, 20, 7 } }, 6.0, 0 };
  EXPECT_FALSE(separation.Reaches(plate.bits, query, workspace));
  workspace.Forget();
  query.bounds = {};
  auto other = empty;
  other.Set(query.a);
  other.Set(query.b);
  EXPECT_TRUE(separation.Reaches(other, query, workspace));
}

TEST(MedialVoxelBoundedGeodesic, TheLengthWithinABoxIsNearlyTheLargestOne)
{
  std::mt19937 generator(12);
  const auto   roll = [&](const int least, const int most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(generator);
  };
  using Geodesic = itk::MedialVoxelBoundedGeodesic;
  const auto isIn = [](const itk::MedialVoxelBox & box, const itk::MedialVoxelBox & part) {
    return box.Contains(part);
  };
  for (const auto & spacing : { itk::MedialVoxelGrid::SpacingType{ { 1.0, 1.0, 1.0 } },
                                itk::MedialVoxelGrid::SpacingType{ { 0.4, 0.7, 2.5 } } })
  {
    const itk::MedialVoxelGrid grid({ { 60, 50, 40 } }, spacing);
    for (int repeat = 0; repeat < 1000; ++repeat)
    {
      const itk::MedialVoxelIndex a{ { roll(20, 39), roll(15, 34), roll(10, 29) } };
      const itk::MedialVoxelIndex b{ { a[0] + roll(-5, 5), a[1] + roll(-5, 5), a[2] + roll(-5, 5) } };
      itk::MedialVoxelBox         box = grid.GetVoxelBox();
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        box.lower[axis] = std::max<std::int64_t>(0, std::min(a[axis], b[axis]) - roll(0, 20));
        box.upper[axis] = std::min(box.upper[axis], std::max(a[axis], b[axis]) + 1 + roll(0, 20));
      }
      const double length = Geodesic::LengthWithin(grid, a, b, box);
      ASSERT_TRUE(isIn(box, Geodesic::SearchBoxOf(grid, a, b, length)));
      if (length < std::numeric_limits<double>::infinity())
      {
        ASSERT_FALSE(
          isIn(box,
               Geodesic::SearchBoxOf(
                 grid, a, b, length + 2.5 * *std::max_element(spacing.begin(), spacing.end()) + 0.5 * length)));
      }
    }
    EXPECT_EQ(Geodesic::LengthWithin(grid, { { 3, 3, 3 } }, { { 9, 9, 9 } }, grid.GetVoxelBox()),
              std::numeric_limits<double>::infinity());
  }
}

TEST(MedialVoxelPairSeparation, SmallBoundariesSayWhatTheyMiss)
{
  const Scene                          plate(AxisPlate({ { 40, 40, 20 } }, UnitSpacing, 2, 8, 6));
  const auto                           small = SiteBits(plate.sites, MakeBox({ { 17, 17, 6 } }, { { 23, 23, 16 } }));
  const itk::MedialVoxelPairSeparation separation(GridOf(plate.volume));
  itk::MedialVoxelPairSeparation::Workspace    workspace;
  const itk::MedialVoxelNoProgress             progress;
  std::vector<itk::MedialVoxelSeparationQuery> queries{ { { { 20, 20, 7 } }, { { 20, 20, 14 } }, 10.5, 0 } };
  const auto                                   missing = separation.FindSeparated(small, progress, workspace, queries);
  ASSERT_FALSE(missing.IsEmpty());
  const auto enough = SiteBits(plate.sites, missing);
  EXPECT_TRUE(separation.FindSeparated(enough, progress, workspace, queries).IsEmpty());
  EXPECT_TRUE(queries[0].isSeparated);
}
