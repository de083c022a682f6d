// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelBoundedGeodesic.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

const Vector3 CraniumSpacing{ { 0.9570312, 0.9570312, 1.5 } };

struct Case
{
  std::string name;
  Volume      volume;
};

std::vector<Case>
Cases()
{
  return { { "noise", RandomVolume({ { 9, 8, 7 } }, UnitSpacing, 0.3, 171) },
           { "dense noise", RandomVolume({ { 9, 8, 7 } }, UnitSpacing, 0.9, 172) },
           { "boxes", RandomBoxes({ { 12, 11, 10 } }, UnitSpacing, 6, 173) },
           { "boxes, spacing 0.5", RandomBoxes({ { 12, 11, 10 } }, { { 0.5, 0.5, 0.5 } }, 6, 174) },
           { "boxes, cranium", RandomBoxes({ { 11, 10, 9 } }, CraniumSpacing, 6, 175) },
           { "boxes, flat voxels", RandomBoxes({ { 11, 10, 9 } }, { { 2.0, 0.4, 1.0 } }, 6, 176) },
           { "across words", RandomBoxes({ { 80, 5, 5 } }, UnitSpacing, 14, 177) },
           { "plane", RandomVolume({ { 22, 20, 1 } }, UnitSpacing, 0.8, 178) },
           { "plane along x and z", RandomVolume({ { 22, 1, 20 } }, CraniumSpacing, 0.8, 179) },
           { "ball", Ball({ { 13, 13, 13 } }, UnitSpacing, { { 6, 6, 6 } }, 4.6) } };
}

/** How many of the random pairs of sites that are near each other are judged differently from plain Dijkstra. */
std::size_t
Differences(const Volume & volume, double epsilon, std::size_t pairs, unsigned int seed)
{
  const auto                                 sites = BoundarySites(volume);
  const BoundaryGraph                        graph(volume, sites);
  const itk::MedialVoxelBoundedGeodesic      geodesic(GridOf(volume), epsilon);
  itk::MedialVoxelBoundedGeodesic::Workspace workspace;
  std::mt19937                               generator(seed);
  std::size_t                                differences = 0;
  for (std::size_t trial = 0; trial < pairs; ++trial)
  {
    const auto source = static_cast<int>(generator() % sites.size());
    const auto distances = graph.DistancesFrom(source);
    const auto a = KernelIndex(sites[source]);
    for (std::size_t target = 0; target < sites.size(); ++target)
    {
      const auto b = KernelIndex(sites[target]);
      EXPECT_GT(std::abs(distances[target] - epsilon), 1e-9);
      if (PhysicalDistance(volume, sites[source], sites[target]) < epsilon + 2.0)
      {
        // Nothing but the search box is given, so that nothing else can be read.
        const auto box = geodesic.GetSearchBox(a, b).Union({ a, { { a[0] + 1, a[1] + 1, a[2] + 1 } } });
        const auto bits = SiteBits(sites, box.Union({ b, { { b[0] + 1, b[1] + 1, b[2] + 1 } } }));
        geodesic.Begin(bits, box, workspace);
        differences += geodesic.ReachesThreshold(a, b, workspace) != (distances[target] >= epsilon) ? 1 : 0;
      }
    }
  }
  return differences;
}
} // namespace

TEST(MedialVoxelBoundedGeodesic, JudgesLikePlainDijkstra)
{
  unsigned int seed = 0;
  for (const Case & testCase : Cases())
  {
    for (const double thickness : { 0.7, 1.2, 2.0, 3.0, 5.0, 8.0 })
    {
      SCOPED_TRACE(testCase.name + ", thickness " + std::to_string(thickness));
      EXPECT_EQ(Differences(testCase.volume, EpsilonOf(thickness), 6, ++seed), 0u);
    }
  }
}

TEST(MedialVoxelBoundedGeodesic, SearchesThatShareTheirResultsJudgeLikePlainDijkstra)
{
  // One series of searches for all pairs, some of them outside of what is shared around the tile.
  const auto tile = MakeBox({ { 6, 6, 6 } }, { { 14, 12, 12 } });
  for (const Vector3 & spacing : { UnitSpacing, CraniumSpacing })
  {
    const Volume                               volume = RandomBoxes({ { 40, 30, 24 } }, spacing, 12, 191);
    const auto                                 sites = BoundarySites(volume);
    const BoundaryGraph                        graph(volume, sites);
    const auto                                 bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
    itk::MedialVoxelBoundedGeodesic::Workspace workspace;
    std::mt19937                               generator(192);
    for (const double thickness : { 2.0, 6.0, 11.0 })
    {
      const double                          epsilon = EpsilonOf(thickness);
      const itk::MedialVoxelBoundedGeodesic geodesic(GridOf(volume), epsilon);
      geodesic.Begin(bits, tile, workspace);
      for (int trial = 0; trial < 60; ++trial)
      {
        const auto source = static_cast<int>(generator() % sites.size());
        const auto distances = graph.DistancesFrom(source);
        for (std::size_t target = 0; target < sites.size(); ++target)
        {
          ASSERT_EQ(geodesic.ReachesThreshold(KernelIndex(sites[source]), KernelIndex(sites[target]), workspace),
                    distances[target] >= epsilon);
        }
      }
    }
  }
}

TEST(MedialVoxelBoundedGeodesic, LengthsEqualToTheThresholdReachIt)
{
  for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 0.5, 0.5, 0.5 } }, Vector3{ { 1.0, 1.0, 1.5 } } })
  {
    const Volume        volume = RandomVolume({ { 5, 5, 4 } }, spacing, 0.3, 181);
    const auto          sites = BoundarySites(volume);
    const BoundaryGraph graph(volume, sites);
    for (int source = 0; source < static_cast<int>(sites.size()); source += 7)
    {
      const auto exact = graph.ExactDistancesFrom(source, 4.0 * spacing[0]);
      for (std::size_t target = 0; target < sites.size(); ++target)
      {
        if (target == static_cast<std::size_t>(source) || std::isinf(exact[target]))
        {
          continue;
        }
        const auto a = KernelIndex(sites[source]);
        const auto b = KernelIndex(sites[target]);
        for (const double epsilon :
             { std::nextafter(exact[target], 0.0), exact[target], std::nextafter(exact[target], 99.0) })
        {
          const itk::MedialVoxelBoundedGeodesic      geodesic(GridOf(volume), epsilon);
          itk::MedialVoxelBoundedGeodesic::Workspace workspace;
          const auto                                 bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
          geodesic.Begin(bits, bits.GetBox(), workspace);
          ASSERT_EQ(geodesic.ReachesThreshold(a, b, workspace), exact[target] >= epsilon)
            << "epsilon " << epsilon << ", site " << target;
        }
      }
    }
  }
}

TEST(MedialVoxelBoundedGeodesic, RoundingOfRunningSumsDoesNotDecide)
{
  // A straight corridor of boundary points: ten edges of 0.1 are 1, while a running sum is slightly less.
  const Volume        volume({ { 14, 3, 3 } }, { { 0.1, 0.3, 0.7 } });
  std::vector<Index3> corridor;
  for (int x = 0; x < 14; ++x)
  {
    corridor.push_back({ { x, 1, 1 } });
  }
  const auto                                 bits = SiteBits(corridor, GridOf(volume).GetVoxelBox());
  itk::MedialVoxelBoundedGeodesic::Workspace workspace;
  for (int steps = 1; steps < 14; ++steps)
  {
    const double length = steps * 0.1;
    for (const double epsilon : { std::nextafter(length, 0.0), length, std::nextafter(length, 2.0) })
    {
      const itk::MedialVoxelBoundedGeodesic geodesic(GridOf(volume), epsilon);
      geodesic.Begin(bits, bits.GetBox(), workspace);
      EXPECT_EQ(geodesic.ReachesThreshold({ { 0, 1, 1 } }, { { steps, 1, 1 } }, workspace), length >= epsilon) << steps;
      EXPECT_EQ(geodesic.ReachesThreshold({ { steps, 1, 1 } }, { { 0, 1, 1 } }, workspace), length >= epsilon) << steps;
    }
  }
}

TEST(MedialVoxelBoundedGeodesic, SearchBoxesHoldEveryShortPath)
{
  for (const Vector3 & spacing : { UnitSpacing, CraniumSpacing, Vector3{ { 2.0, 0.4, 1.0 } } })
  {
    const Volume volume({ { 40, 40, 40 } }, spacing);
    std::mt19937 generator(6);
    for (const double thickness : { 1.0, 3.0, 8.0 })
    {
      const double                          epsilon = EpsilonOf(thickness);
      const itk::MedialVoxelBoundedGeodesic geodesic(GridOf(volume), epsilon);
      for (int trial = 0; trial < 200; ++trial)
      {
        Index3 a;
        Index3 b;
        Index3 q;
        for (int axis = 0; axis < 3; ++axis)
        {
          a[axis] = 15 + static_cast<int>(generator() % 10);
          b[axis] = a[axis] - 4 + static_cast<int>(generator() % 9);
          q[axis] = a[axis] - 14 + static_cast<int>(generator() % 29);
        }
        // A path through q shorter than epsilon must be inside.
        if (FreeSpaceLength(volume, a, q) + FreeSpaceLength(volume, q, b) < epsilon && volume.Contains(q))
        {
          ASSERT_TRUE(geodesic.GetSearchBox(KernelIndex(a), KernelIndex(b)).Contains(KernelIndex(q)));
        }
      }
    }
  }
}

TEST(MedialVoxelBoundedGeodesic, SearchBoxesStayInTheImage)
{
  const Volume                          volume({ { 12, 11, 1 } }, UnitSpacing);
  const itk::MedialVoxelBoundedGeodesic geodesic(GridOf(volume), 20.0);
  const auto                            box = geodesic.GetSearchBox({ { 0, 0, 0 } }, { { 11, 10, 0 } });
  EXPECT_TRUE(GridOf(volume).GetVoxelBox().Contains(box));
}
