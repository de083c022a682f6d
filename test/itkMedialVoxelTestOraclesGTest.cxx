// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The oracles themselves, against numbers worked out by hand.

#include "MedialVoxelTestClassification.h"
#include "MedialVoxelTestPhantoms.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

const double kRoot2 = std::sqrt(2.0);
const double kRoot3 = std::sqrt(3.0);

Volume
OneVoxel(const Index3 & size, const Index3 & at, const Vector3 & spacing = UnitSpacing)
{
  return MakeVolume(size, spacing, [at](const Index3 & v) { return v == at; });
}
} // namespace

TEST(MedialVoxelTestOracles, BoundaryOfOneVoxelIsItsNeighborhood)
{
  EXPECT_EQ(BoundarySites(OneVoxel({ { 3, 3, 3 } }, { { 1, 1, 1 } })).size(), 26u);
  EXPECT_EQ(BoundarySites(OneVoxel({ { 5, 5, 1 } }, { { 2, 2, 0 } })).size(), 8u);
  EXPECT_EQ(BoundarySites(OneVoxel({ { 1, 9, 1 } }, { { 0, 4, 0 } })).size(), 2u);
  EXPECT_EQ(BoundarySites(OneVoxel({ { 3, 3, 3 } }, { { 0, 0, 0 } })).size(), 7u);
  EXPECT_EQ(BoundarySites(OneVoxel({ { 3, 3, 3 } }, { { 1, 1, 1 } }), BoundarySide::Object).size(), 1u);
  EXPECT_TRUE(BoundarySites(Volume({ { 3, 3, 3 } }, UnitSpacing)).empty());
  EXPECT_TRUE(BoundarySites(Complement(Volume({ { 3, 3, 3 } }, UnitSpacing))).empty());
}

TEST(MedialVoxelTestOracles, TiesGoToTheLowestSlice)
{
  const Volume volume = OneVoxel({ { 3, 3, 3 } }, { { 1, 1, 1 } });
  const auto   sites = BoundarySites(volume);
  const Index3 expected{ { 1, 1, 0 } };
  EXPECT_EQ(sites[NearestSite(volume, sites, { { 1, 1, 1 } })], expected);
  EXPECT_EQ(CountNearestSites(volume, sites, { { 1, 1, 1 } }), 6);
}

TEST(MedialVoxelTestOracles, TiesInASliceGoToTheLowestRow)
{
  const Volume volume = OneVoxel({ { 3, 3, 1 } }, { { 1, 1, 0 } });
  const auto   sites = BoundarySites(volume);
  const Index3 expected{ { 1, 0, 0 } };
  EXPECT_EQ(sites[NearestSite(volume, sites, { { 1, 1, 0 } })], expected);
}

TEST(MedialVoxelTestOracles, SpacingDecidesWhichSiteIsNearest)
{
  const Volume volume = OneVoxel({ { 3, 3, 3 } }, { { 1, 1, 1 } }, { { 1.0, 0.5, 2.0 } });
  const auto   sites = BoundarySites(volume);
  const Index3 expected{ { 1, 0, 1 } };
  EXPECT_EQ(sites[NearestSite(volume, sites, { { 1, 1, 1 } })], expected);
  EXPECT_DOUBLE_EQ(KeyDistance(volume, { { 0, 0, 0 } }, { { 2, 2, 1 } }), 4.0 + 1.0 + 4.0);
}

TEST(MedialVoxelTestOracles, EqualSpacingIsJudgedOverLongAxes)
{
  EXPECT_FALSE(Volume({ { 4, 4, 4 } }, { { 0.7, 0.7, 3.0 } }).HasEqualSpacing());
  EXPECT_TRUE(Volume({ { 4, 4, 1 } }, { { 0.7, 0.7, 3.0 } }).HasEqualSpacing());
  EXPECT_TRUE(Volume({ { 1, 4, 1 } }, { { 9.0, 0.7, 3.0 } }).HasEqualSpacing());
  EXPECT_EQ(KeyDistance(Volume({ { 4, 4, 1 } }, { { 0.7, 0.7, 3.0 } }), { { 0, 0, 0 } }, { { 1, 2, 0 } }), 5.0);
}

TEST(MedialVoxelTestOracles, FreeSpacePathsUseTheWidestMovesFirst)
{
  const Volume unit({ { 9, 9, 9 } }, UnitSpacing);
  EXPECT_DOUBLE_EQ(FreeSpaceLength(unit, { { 4, 4, 4 } }, { { 1, 6, 5 } }), 1.0 + kRoot2 + kRoot3);
  EXPECT_DOUBLE_EQ(FreeSpaceLength(unit, { { 0, 0, 0 } }, { { 0, 0, 5 } }), 5.0);
  const Volume flat({ { 9, 9, 9 } }, { { 3.0, 4.0, 12.0 } });
  EXPECT_DOUBLE_EQ(FreeSpaceLength(flat, { { 0, 0, 0 } }, { { 1, 2, 3 } }), 13.0 + std::sqrt(160.0) + 12.0);
}

TEST(MedialVoxelTestOracles, FreeSpacePathsAreDijkstraOnTheCompleteGrid)
{
  const Volume        volume = Complement(Volume({ { 5, 4, 4 } }, { { 0.7, 1.1, 2.3 } }));
  std::vector<Index3> all;
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    all.push_back(volume.IndexAt(i));
  }
  const auto distances = BoundaryGraph(volume, all).DistancesFrom(0);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    EXPECT_NEAR(distances[i], FreeSpaceLength(volume, all[0], all[i]), 1e-12);
  }
}

TEST(MedialVoxelTestOracles, GeodesicsWalkAroundTheObject)
{
  // Row y = 2 of object pixels x = 2..4: the ring of its boundary has 5 + 2 + 5
  // = 12 pixels.
  const Volume volume =
    MakeVolume({ { 7, 5, 1 } }, UnitSpacing, [](const Index3 & v) { return v[1] == 2 && v[0] >= 2 && v[0] <= 4; });
  const auto sites = BoundarySites(volume);
  ASSERT_EQ(sites.size(), 12u);
  const auto above = std::find(sites.begin(), sites.end(), Index3{ { 3, 1, 0 } }) - sites.begin();
  const auto below = std::find(sites.begin(), sites.end(), Index3{ { 3, 3, 0 } }) - sites.begin();
  const auto plain = BoundaryGraph(volume, sites).DistancesFrom(static_cast<int>(above));
  const auto exact = BoundaryGraph(volume, sites).ExactDistancesFrom(static_cast<int>(above), 6.0);
  EXPECT_NEAR(plain[below], 2.0 + 2.0 * kRoot2, 1e-12);
  EXPECT_EQ(exact[below], 2.0 + 2.0 * kRoot2);
}

TEST(MedialVoxelTestOracles, ExactAndPlainDijkstraAgree)
{
  const Volume        volume = RandomVolume({ { 4, 4, 3 } }, { { 1.0, 1.0, 1.3 } }, 0.35, 7);
  const auto          sites = BoundarySites(volume);
  const BoundaryGraph graph(volume, sites);
  ASSERT_GT(sites.size(), 10u);
  const auto plain = graph.DistancesFrom(0, 5.0);
  const auto exact = graph.ExactDistancesFrom(0, 5.0);
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    if (plain[i] < 5.0)
    {
      EXPECT_NEAR(plain[i], exact[i], 1e-12);
    }
    else
    {
      EXPECT_GE(exact[i], 5.0);
    }
  }
}

TEST(MedialVoxelTestOracles, CellsNeedOneCornerInTheObject)
{
  const Volume volume = OneVoxel({ { 4, 4, 4 } }, { { 1, 1, 1 } });
  EXPECT_EQ(Classify(volume, 3.0, Bound::Off).counts.candidateCells, 8u);
  EXPECT_EQ(Classify(OneVoxel({ { 4, 4, 1 } }, { { 0, 1, 0 } }), 3.0, Bound::Off).counts.candidateCells, 2u);
  EXPECT_EQ(Classify(OneVoxel({ { 1, 1, 4 } }, { { 0, 0, 3 } }), 3.0, Bound::Off).counts.candidateCells, 1u);
  EXPECT_EQ(Classify(OneVoxel({ { 1, 1, 1 } }, { { 0, 0, 0 } }), 3.0, Bound::Off).counts.candidateCells, 0u);
}

TEST(MedialVoxelTestOracles, CosineKeyIsTheSignedSquareOfTheCosine)
{
  const Volume plane({ { 4, 4, 1 } }, UnitSpacing);
  EXPECT_DOUBLE_EQ(CosineKey(plane, { { 1, 1, 0 } }, { { 1, 0, 0 } }, { { 2, 2, 0 } }), -0.8);
  EXPECT_DOUBLE_EQ(CosineKey(plane, { { 1, 1, 0 } }, { { 1, 1, 0 } }, { { 2, 2, 0 } }), -1.0);
  EXPECT_DOUBLE_EQ(CosineKey(plane, { { 1, 1, 0 } }, { { 1, 1, 0 } }, { { 2, 1, 0 } }), 0.0);
}

TEST(MedialVoxelTestOracles, PaperBoundIsRadiusTimesAngle)
{
  const Volume volume({ { 9, 9, 9 } }, { { 1.0, 1.0, 0.5 } });
  EXPECT_DOUBLE_EQ(PaperPseudoGeodesic(volume, { { 4, 4, 4 } }, { { 4, 4, 0 } }, { { 5, 5, 5 } }, { { 5, 5, 8 } }),
                   1.5 * std::acos(-1.0));
  EXPECT_LT(PaperPseudoGeodesic(volume, { { 4, 4, 4 } }, { { 4, 4, 4 } }, { { 5, 5, 5 } }, { { 5, 5, 8 } }), 0.0);
}

TEST(MedialVoxelTestOracles, APathAsLongAsEpsilonIsMedial)
{
  // The pair of cell (0, 0) is its two background corners (1, 0) and (0, 1),
  // neighbors by an edge of sqrt(2).
  const Volume volume = OneVoxel({ { 3, 3, 1 } }, { { 1, 1, 0 } });
  const double thickness = ThicknessForEpsilon(kRoot2);
  ASSERT_GT(thickness, 0.0);
  EXPECT_EQ(Classify(volume, thickness, Bound::FreeSpace, PathSums::Exact).labels[0], 2);
  EXPECT_EQ(Classify(volume, thickness, Bound::Off, PathSums::Exact).labels[0], 3);
  EXPECT_EQ(Classify(volume, std::nextafter(thickness, 2.0), Bound::Off, PathSums::Exact).labels[0], 1);
}

TEST(MedialVoxelTestOracles, EveryCellIsCountedOnce)
{
  const Volume volume = RandomVolume({ { 9, 8, 7 } }, UnitSpacing, 0.5, 3);
  for (const Bound bound : { Bound::FreeSpace, Bound::Paper, Bound::Off })
  {
    const Counts c = Classify(volume, 2.0, bound).counts;
    EXPECT_EQ(c.candidateCells, c.trivialCells + c.boundCells + c.geodesicMedialCells + c.geodesicNonMedialCells);
  }
}
