// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelNearestSite.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

const Vector3 CraniumSpacing{ { 0.9570312, 0.9570312, 1.5 } };

using Key = std::tuple<double, int, int, int>;

Key
KeyOf(const itk::MedialVoxelOffset & o)
{
  return Key{ o.squaredLength, o.dz, o.dy, o.dx };
}
} // namespace

TEST(MedialVoxelNearestSite, SortedOffsetsAreTheBallInKeyOrder)
{
  for (const Volume & volume : { Volume({ { 20, 20, 20 } }, UnitSpacing),
                                 Volume({ { 20, 20, 20 } }, CraniumSpacing),
                                 Volume({ { 20, 1, 20 } }, CraniumSpacing),
                                 Volume({ { 20, 20, 1 } }, { { 2.0, 2.0, 9.0 } }) })
  {
    for (const double radius : { 1.0, 2.3, 4.0 })
    {
      const auto  offsets = itk::MedialVoxelSortedOffsets(GridOf(volume), radius);
      std::size_t inBall = 0;
      for (int z = -9; z <= 9; ++z)
      {
        for (int y = -9; y <= 9; ++y)
        {
          for (int x = -9; x <= 9; ++x)
          {
            const bool active = (volume.size[1] > 1 || y == 0) && (volume.size[2] > 1 || z == 0);
            inBall += active && KeyDistance(volume, Index3{}, { { x, y, z } }) <= radius * radius ? 1 : 0;
          }
        }
      }
      EXPECT_EQ(offsets.size(), inBall);
      for (std::size_t i = 0; i < offsets.size(); ++i)
      {
        const auto & o = offsets[i];
        EXPECT_EQ(o.squaredLength, KeyDistance(volume, Index3{}, { { o.dx, o.dy, o.dz } }));
        EXPECT_TRUE(i == 0 || KeyOf(offsets[i - 1]) < KeyOf(o)) << i;
      }
    }
  }
}

TEST(MedialVoxelNearestSite, TheFirstOffsetToASiteLeadsToTheNearest)
{
  for (const Vector3 & spacing : { UnitSpacing, CraniumSpacing })
  {
    const Volume volume = RandomVolume({ { 150, 7, 8 } }, spacing, 0.02, 151);
    const auto   sites = BoundarySites(volume, BoundarySide::Object);
    const auto   offsets = itk::MedialVoxelOffsetTable(itk::MedialVoxelSortedOffsets(GridOf(volume), 3.2));
    const auto   bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
    for (const int x : { 0, 13, 64, 86, 128 })
    {
      for (int z = 0; z < 8; ++z)
      {
        const int        lanes = std::min(64, 150 - x);
        const auto       query = itk::MedialVoxelBits::RangeMask(0, 0, lanes) & 0xfffffffffffffff7u;
        std::vector<int> dx(64, 77);
        std::vector<int> dy(64, 77);
        std::vector<int> dz(64, 77);
        const auto       result =
          itk::MedialVoxelSearchOffsets(offsets, bits, x, 3, z, query, { dx.data(), dy.data(), dz.data(), 0 });
        double largest = 0.0;
        for (int lane = 0; lane < 64; ++lane)
        {
          const Index3 v{ { x + lane, 3, z } };
          const bool   asked = (query >> lane & 1) != 0;
          const long   nearest = asked ? NearestSite(volume, sites, v) : -1;
          const double square = nearest >= 0 ? KeyDistance(volume, v, sites[nearest]) : 0.0;
          const bool   found = nearest >= 0 && square <= 3.2 * 3.2;
          ASSERT_EQ((result.remaining >> lane & 1) != 0, asked && !found);
          if (found)
          {
            const Index3 expected = sites[nearest];
            ASSERT_EQ((Index3{ { v[0] + dx[lane], v[1] + dy[lane], v[2] + dz[lane] } }), expected);
            largest = std::max(largest, square);
          }
          else
          {
            ASSERT_EQ(dx[lane], 77);
          }
        }
        EXPECT_EQ(result.largestSquaredLength, largest);
      }
    }
  }
}

TEST(MedialVoxelNearestSite, RowsAreSearchedBothWays)
{
  const Volume volume = RandomVolume({ { 300, 1, 1 } }, UnitSpacing, 0.015, 152);
  const auto   sites = BoundarySites(volume, BoundarySide::Object);
  const auto   bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
  for (const int first : { 0, 1, 63, 64, 130 })
  {
    for (const int reach : { 1, 5, 64, 400 })
    {
      std::vector<int> displacement(300 - first, 77);
      itk::MedialVoxelNearestInRow(bits, first, 300 - first, 0, 0, reach, displacement.data());
      for (int x = first; x < 300; ++x)
      {
        const Index3 nearest = sites[NearestSite(volume, sites, { { x, 0, 0 } })];
        const int    expected = nearest[0] - x;
        const int    actual = displacement[x - first];
        const bool   isMissed = std::abs(expected) > reach &&
                              (actual == itk::MedialVoxelNoDisplacement || std::abs(actual) >= std::abs(expected));
        ASSERT_TRUE(actual == expected || isMissed) << x << ' ' << actual << ' ' << expected;
      }
    }
  }
  const itk::MedialVoxelBits empty(GridOf(volume).GetVoxelBox());
  std::vector<int>           displacement(300, 0);
  itk::MedialVoxelNearestInRow(empty, 0, 300, 0, 0, 300, displacement.data());
  EXPECT_EQ(displacement, std::vector<int>(300, itk::MedialVoxelNoDisplacement));
}

namespace
{
void
ExpectBruteForceOutward(unsigned int seed)
{
  std::mt19937        generator(seed);
  const std::int64_t  lanes = 37;
  const std::int64_t  pitch = 41;
  const std::int64_t  lines = 23;
  std::vector<double> costs(pitch * lines);
  std::vector<double> squares;
  for (auto & cost : costs)
  {
    cost = generator() % 3 == 0 ? itk::MedialVoxelNoCost : static_cast<double>(generator() % 90);
  }
  for (int i = 0; i < 30; ++i)
  {
    squares.push_back(static_cast<double>(i * i));
  }
  for (std::int64_t lane = 0; lane < 3; ++lane) // lanes without any site
  {
    for (std::int64_t line = 0; line < lines; ++line)
    {
      costs[line * pitch + lane] = itk::MedialVoxelNoCost;
    }
  }
  for (std::int64_t center = 0; center < lines; ++center)
  {
    std::vector<double>       best(lanes);
    std::vector<std::int64_t> position(lanes);
    itk::MedialVoxelSearchOutward(costs.data(), pitch, lines, lanes, center, squares, best.data(), position.data());
    for (std::int64_t lane = 0; lane < lanes; ++lane)
    {
      double       expected = itk::MedialVoxelNoCost;
      std::int64_t at = -1;
      for (std::int64_t line = 0; line < lines; ++line)
      {
        const double cost = costs[line * pitch + lane] + squares[std::abs(line - center)];
        if (costs[line * pitch + lane] < itk::MedialVoxelNoCost && cost < expected)
        {
          expected = cost;
          at = line;
        }
      }
      if (at < 0)
      {
        ASSERT_GE(best[lane], itk::MedialVoxelNoCost);
      }
      else
      {
        ASSERT_EQ(best[lane], expected);
        ASSERT_EQ(static_cast<std::int64_t>(position[lane]), at) << "center " << center << ", lane " << lane;
      }
    }
  }
}
} // namespace

TEST(MedialVoxelNearestSite, OutwardSearchesTakeTheCheapestAndFirstLine)
{
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    ExpectBruteForceOutward(seed);
  }
}

TEST(MedialVoxelNearestSite, OutwardSearchesReachAsFarAsTheSquares)
{
  const std::vector<double> costs{ 0.0, 50.0, 50.0, 50.0, 50.0 };
  double                    cost = -1.0;
  std::int64_t              position = -1;
  itk::MedialVoxelSearchOutward(costs.data(), 1, 5, 1, 4, { 0.0, 1.0, 4.0 }, &cost, &position);
  EXPECT_EQ(cost, 50.0);
  EXPECT_EQ(position, 4);
  itk::MedialVoxelSearchOutward(costs.data(), 1, 5, 1, 4, { 0.0, 1.0, 4.0, 9.0, 16.0 }, &cost, &position);
  EXPECT_EQ(cost, 16.0);
  EXPECT_EQ(position, 0);
}

TEST(MedialVoxelNearestSite, SingleVoxelsFindTheirDistance)
{
  for (const Vector3 & spacing : { UnitSpacing, CraniumSpacing })
  {
    const Volume volume = RandomVolume({ { 70, 21, 19 } }, spacing, 0.0005, 153);
    const auto   sites = BoundarySites(volume, BoundarySide::Object);
    const auto   bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
    ASSERT_GT(sites.size(), 3u);
    for (std::size_t i = 0; i < volume.object.size(); i += 173)
    {
      const Index3 v = volume.IndexAt(i);
      const double expected = KeyDistance(volume, v, sites[NearestSite(volume, sites, v)]);
      for (const double limit : { 5.0, 200.0, std::numeric_limits<double>::infinity() })
      {
        const double actual = itk::MedialVoxelSquaredDistanceToSites(GridOf(volume), bits, KernelIndex(v), limit);
        ASSERT_TRUE(actual == expected || (expected > limit * limit && actual >= expected)) << i;
      }
    }
  }
  const Volume               volume({ { 20, 20, 20 } }, UnitSpacing);
  const itk::MedialVoxelBits empty(GridOf(volume).GetVoxelBox());
  EXPECT_TRUE(std::isinf(itk::MedialVoxelSquaredDistanceToSites(GridOf(volume), empty, { { 3, 3, 3 } }, 1e9)));
}
