// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelBitFlood.h"
#include "itkMedialVoxelBoundedGeodesic.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace MedialVoxelTest;
using Result = itk::MedialVoxelBitFlood::Result;

itk::MedialVoxelDisplacement
Difference(const Index3 & a, const Index3 & b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}

itk::MedialVoxelDisplacement
RandomDifference(std::mt19937 & generator, int reach)
{
  itk::MedialVoxelDisplacement difference;
  for (std::int64_t & steps : difference)
  {
    steps = static_cast<std::int64_t>(generator() % (2 * reach + 1)) - reach;
  }
  return difference;
}

/** Sites of any density, not only borders of objects, far from the faces of the volume; word borders pass through. */
std::vector<Index3>
RandomSites(const Index3 & size, double density, unsigned int seed)
{
  std::mt19937        generator(seed);
  std::vector<Index3> sites;
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        if (std::generate_canonical<double, 32>(generator) < density)
        {
          sites.push_back({ { x, y, z } });
        }
      }
    }
  }
  return sites;
}
} // namespace

TEST(MedialVoxelBitFlood, AgreesWithTheSearchOnRandomSites)
{
  const Index3                               size{ { 86, 22, 22 } };
  itk::MedialVoxelBoundedGeodesic::Workspace workspace;
  unsigned int                               seed = 300;
  for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 0.5, 0.5, 0.5 } } })
  {
    const Volume volume(size, spacing);
    for (const double density : { 0.1, 0.2, 0.35, 0.6 })
    {
      const auto   sites = RandomSites(size, density, ++seed);
      const auto   bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
      std::mt19937 generator(seed);
      for (const double voxels : { 1.3, 2.0, 2.5, 3.0, 4.0, 5.0 })
      {
        const double                          epsilon = EpsilonOf(voxels * spacing[0]);
        const itk::MedialVoxelBitFlood        flood(GridOf(volume), epsilon);
        const itk::MedialVoxelBoundedGeodesic geodesic(GridOf(volume), epsilon);
        const itk::MedialVoxelDualCell        cell(GridOf(volume));
        geodesic.Begin(bits, bits.GetBox(), workspace);
        ASSERT_TRUE(flood.IsAvailable());
        std::array<int, 3> seen{};
        for (int trial = 0; trial < 3000; ++trial)
        {
          const Index3 &              source = sites[generator() % sites.size()];
          const auto                  a = KernelIndex(source);
          const auto                  difference = RandomDifference(generator, trial % 3 == 0 ? 8 : 3);
          const itk::MedialVoxelIndex b{ { a[0] - difference[0], a[1] - difference[1], a[2] - difference[2] } };
          if (!bits.Test(b))
          {
            continue;
          }
          const auto result = flood.Decide(bits, a, difference);
          if (result == Result::Undecided)
          {
            continue;
          }
          ++seen[static_cast<std::size_t>(result)];
          ASSERT_EQ(result == Result::Bounded, cell.FreeSpaceLength(difference) >= epsilon);
          ASSERT_EQ(result != Result::FallsShort, geodesic.ReachesThreshold(a, b, workspace))
            << "thickness " << voxels << ", density " << density;
        }
        EXPECT_GT(seen[static_cast<std::size_t>(Result::Bounded)], 0);
        EXPECT_GT(seen[static_cast<std::size_t>(Result::FallsShort)], 0);
        EXPECT_GT(seen[static_cast<std::size_t>(Result::Reaches)], density > 0.5 ? -1 : 0);
      }
    }
  }
}

TEST(MedialVoxelBitFlood, JudgesLikePlainDijkstra)
{
  const Volume        volume = RandomBoxes({ { 24, 21, 20 } }, UnitSpacing, 12, 301);
  const auto          sites = BoundarySites(volume);
  const auto          bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
  const BoundaryGraph graph(volume, sites);
  for (const double thickness : { 1.5, 2.0, 3.0, 5.0 })
  {
    const double                   epsilon = EpsilonOf(thickness);
    const itk::MedialVoxelBitFlood flood(GridOf(volume), epsilon);
    std::size_t                    decided = 0;
    for (std::size_t source = 0; source < sites.size(); source += 40)
    {
      const auto distances = graph.DistancesFrom(static_cast<int>(source));
      for (std::size_t target = 0; target < sites.size(); ++target)
      {
        const auto result = flood.Decide(bits, KernelIndex(sites[source]), Difference(sites[source], sites[target]));
        if (result != Result::Undecided)
        {
          ++decided;
          ASSERT_EQ(result != Result::FallsShort, distances[target] >= epsilon) << "thickness " << thickness;
        }
        const auto length =
          flood.FindLength(bits, KernelIndex(sites[source]), Difference(sites[source], sites[target]));
        ASSERT_EQ(length.has_value(), result != Result::Undecided);
        if (length && target != source && distances[target] < epsilon)
        {
          ASSERT_NEAR(*length, distances[target], 1e-9) << "thickness " << thickness;
        }
        else if (length && target != source)
        {
          ASSERT_EQ(*length, std::numeric_limits<double>::infinity()) << "thickness " << thickness;
        }
      }
    }
    EXPECT_GT(decided, 1000u);
  }
}

TEST(MedialVoxelBitFlood, LeavesThresholdsThatAreLengthsToTheSearch)
{
  const itk::MedialVoxelGrid grid({ { 30, 30, 30 } }, UnitSpacing);
  for (const double length : { 2.0, 3.0, 1.0 + std::sqrt(2.0), std::sqrt(2.0) + std::sqrt(3.0), 4.0 + std::sqrt(3.0) })
  {
    EXPECT_FALSE(itk::MedialVoxelBitFlood(grid, length).IsAvailable());
    EXPECT_FALSE(itk::MedialVoxelBitFlood(grid, std::nextafter(length, 0.0)).IsAvailable());
    EXPECT_FALSE(itk::MedialVoxelBitFlood(grid, length * (1.0 + 5e-10)).IsAvailable());
    EXPECT_TRUE(itk::MedialVoxelBitFlood(grid, length * (1.0 + 1e-6)).IsAvailable());
  }
}

TEST(MedialVoxelBitFlood, LeavesOtherGridsAndThresholdsToTheSearch)
{
  const double               epsilon = EpsilonOf(3.0);
  const itk::MedialVoxelGrid grid({ { 30, 30, 30 } }, UnitSpacing);
  EXPECT_TRUE(itk::MedialVoxelBitFlood(grid, epsilon).IsAvailable());
  EXPECT_FALSE(itk::MedialVoxelBitFlood(grid, 1.7).IsAvailable());
  EXPECT_FALSE(itk::MedialVoxelBitFlood(grid, 8.1).IsAvailable());
  EXPECT_FALSE(itk::MedialVoxelBitFlood({ { { 30, 30, 30 } }, { { 1.0, 1.0, 1.1 } } }, epsilon).IsAvailable());
  EXPECT_FALSE(itk::MedialVoxelBitFlood({ { { 30, 30, 1 } }, UnitSpacing }, epsilon).IsAvailable());
  const itk::MedialVoxelBits bits(grid.GetVoxelBox());
  EXPECT_EQ(itk::MedialVoxelBitFlood(grid, 8.1).Decide(bits, { { 9, 9, 9 } }, { { 0, 0, 3 } }), Result::Undecided);
}

TEST(MedialVoxelBitFlood, IsUndecidedWhereTheBoundaryIsNotKnown)
{
  const Volume                   volume({ { 30, 30, 30 } }, UnitSpacing);
  const itk::MedialVoxelBitFlood flood(GridOf(volume), EpsilonOf(3.0));
  const std::vector<Index3>      sites{ { { 12, 12, 12 } }, { { 12, 12, 15 } } };
  // A path from 12 to 15 can turn back at most to 12 and come no further than a voxel from the straight line.
  const auto enough = MakeBox({ { 11, 11, 12 } }, { { 14, 14, 16 } });
  EXPECT_EQ(flood.Decide(SiteBits(sites, enough), { { 12, 12, 12 } }, { { 0, 0, -3 } }), Result::Reaches);
  for (int axis = 0; axis < 3; ++axis)
  {
    auto tooSmall = enough;
    ++tooSmall.lower[axis];
    EXPECT_EQ(flood.Decide(SiteBits(sites, tooSmall), { { 12, 12, 12 } }, { { 0, 0, -3 } }), Result::Undecided);
    tooSmall = enough;
    --tooSmall.upper[axis];
    EXPECT_EQ(flood.Decide(SiteBits(sites, tooSmall), { { 12, 12, 12 } }, { { 0, 0, -3 } }), Result::Undecided);
  }
}
