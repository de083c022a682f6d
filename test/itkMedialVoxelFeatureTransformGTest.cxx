// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelSlabPlan.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelFeatureTransform;

const Vector3 CraniumSpacing{ { 0.9570312, 0.9570312, 1.5 } };

bool
IsInRegion(itk::MedialVoxelRegion region, bool isObject)
{
  return region == itk::MedialVoxelRegion::Both || (region == itk::MedialVoxelRegion::Inside) == isObject;
}

/** How many displacements of a tile differ from brute force. */
std::size_t
Differences(const Volume &                   volume,
            const std::vector<Index3> &      sites,
            const itk::MedialVoxelFeatures & features,
            itk::MedialVoxelRegion           region,
            double                           maximum = std::numeric_limits<double>::infinity())
{
  std::size_t differences = 0;
  ForEachVoxel(features.box, [&](const itk::MedialVoxelIndex & index) {
    const Index3 v = OracleIndex(index);
    const auto   i = features.OffsetOf(index[0], index[1], index[2]);
    const long   n = NearestSite(volume, sites, v);
    Index3       expected{};
    if (IsInRegion(region, volume.IsObject(v)))
    {
      const bool has = n >= 0 && PhysicalDistance(volume, v, sites[n]) <= maximum;
      for (int axis = 0; axis < 3; ++axis)
      {
        expected[axis] = has ? sites[n][axis] - v[axis] : itk::MedialVoxelNoDisplacement;
      }
    }
    differences += Index3{ { features.dx[i], features.dy[i], features.dz[i] } } != expected ? 1 : 0;
  });
  return differences;
}

/** What the transform says about one voxel: what it misses, and the site that it found. */
struct Outcome
{
  itk::MedialVoxelBox missing;
  Index3              site;
};

Outcome
TransformVoxel(const Volume &              volume,
               const std::vector<Index3> & sites,
               const Index3 &              voxel,
               const itk::MedialVoxelBox & known)
{
  const auto                             object = ObjectBits(volume, known);
  const auto                             bits = SiteBits(sites, known);
  const MedialVoxelFeatureTransform      transform(GridOf(volume));
  MedialVoxelFeatureTransform::Workspace workspace;
  itk::MedialVoxelFeatures               features;
  const auto                             tile = MakeBox(voxel, { { voxel[0] + 1, voxel[1] + 1, voxel[2] + 1 } });
  const auto                             missing = transform.Compute({ &object, &bits }, tile, workspace, features);
  return { missing, { { voxel[0] + features.dx[0], voxel[1] + features.dy[0], voxel[2] + features.dz[0] } } };
}

struct Case
{
  Volume                 volume;
  BoundarySide           side;
  itk::MedialVoxelRegion region;
};

std::vector<Case>
Cases()
{
  const auto inside = itk::MedialVoxelRegion::Inside;
  const auto outside = itk::MedialVoxelRegion::Outside;
  const auto both = itk::MedialVoxelRegion::Both;
  return { { RandomBoxes({ { 75, 20, 18 } }, UnitSpacing, 12, 161), BoundarySide::Background, inside },
           { RandomBoxes({ { 75, 20, 18 } }, CraniumSpacing, 12, 162), BoundarySide::Object, both },
           { RandomVolume({ { 70, 15, 14 } }, CraniumSpacing, 0.995, 163), BoundarySide::Background, inside },
           { RandomVolume({ { 70, 15, 14 } }, UnitSpacing, 0.003, 164), BoundarySide::Object, outside },
           { LatticeOfHoles({ { 40, 22, 21 } }, UnitSpacing, 9), BoundarySide::Background, inside },
           { LatticeOfHoles({ { 40, 22, 21 } }, CraniumSpacing, 9), BoundarySide::Object, inside },
           { RandomVolume({ { 90, 40, 1 } }, CraniumSpacing, 0.99, 165), BoundarySide::Background, both },
           { RandomVolume({ { 1, 50, 40 } }, CraniumSpacing, 0.99, 166), BoundarySide::Background, both },
           { RandomVolume({ { 300, 1, 1 } }, UnitSpacing, 0.97, 167), BoundarySide::Background, both } };
}
} // namespace

TEST(MedialVoxelFeatureTransform, WholeVolumesAreBruteForce)
{
  for (const Case & testCase : Cases())
  {
    const auto                             image = GridOf(testCase.volume).GetVoxelBox();
    const auto                             sites = BoundarySites(testCase.volume, testCase.side);
    const auto                             object = ObjectBits(testCase.volume, image);
    const auto                             bits = SiteBits(sites, image);
    const MedialVoxelFeatureTransform      transform(GridOf(testCase.volume), testCase.region);
    MedialVoxelFeatureTransform::Workspace workspace;
    itk::MedialVoxelFeatures               features;
    const auto                             missing = transform.Compute({ &object, &bits }, image, workspace, features);
    EXPECT_TRUE(missing.IsEmpty());
    EXPECT_EQ(features.box, image);
    EXPECT_EQ(Differences(testCase.volume, sites, features, testCase.region), 0u);
  }
}

TEST(MedialVoxelFeatureTransform, TilesInSmallWindowsAreFinalOrSayWhatTheyMiss)
{
  std::mt19937                           generator(4);
  MedialVoxelFeatureTransform::Workspace workspace; // one for all tiles: nothing of a tile may leak into the next
  int                                    asked = 0;
  int                                    final = 0;
  for (const Case & testCase : Cases())
  {
    const auto                        image = GridOf(testCase.volume).GetVoxelBox();
    const auto                        sites = BoundarySites(testCase.volume, testCase.side);
    const MedialVoxelFeatureTransform transform(GridOf(testCase.volume), testCase.region);
    for (int trial = 0; trial < 150; ++trial)
    {
      itk::MedialVoxelBox tile = RandomBox(testCase.volume.size, generator);
      for (int axis = 0; axis < 3; ++axis)
      {
        tile.upper[axis] = std::min(tile.upper[axis], tile.lower[axis] + 9);
      }
      const auto isThin = tile.Extent(0) < 7 || tile.Extent(1) < 7 || tile.Extent(2) < 7;
      // The tile may reach beyond what is known, of sites and object alike.
      const int                margin = std::max(static_cast<int>(generator() % 9) - 3, isThin ? 0 : -3);
      itk::MedialVoxelBox      known = tile.Expanded(KernelIndex({ { margin, margin, margin } })).Intersection(image);
      itk::MedialVoxelFeatures features;
      for (int round = 0;; ++round)
      {
        const auto object = ObjectBits(testCase.volume, known.Expanded({ { 1, 1, 1 } }).Intersection(image));
        const auto bits = SiteBits(sites, known);
        const auto missing = transform.Compute({ &object, &bits }, tile, workspace, features);
        if (missing.IsEmpty())
        {
          final += round == 0 ? 1 : 0;
          break;
        }
        ++asked;
        ASSERT_FALSE(known.Contains(missing.Intersection(image))) << "asks for what is known";
        ASSERT_LT(round, 12);
        known = known.Union(missing).Intersection(image);
      }
      EXPECT_EQ(Differences(testCase.volume, sites, features, testCase.region), 0u);
    }
  }
  EXPECT_GT(asked, 20);
  EXPECT_GT(final, 20);
}

TEST(MedialVoxelFeatureTransform, AnEqualDistanceOutsideTheWindowIsNotOverlooked)
{
  // Sites at both ends of a row, equally far from the middle: the left one has the smaller key.
  const Volume  row = MakeVolume({ { 9, 1, 1 } }, UnitSpacing, [](const Index3 & v) { return v[0] > 0 && v[0] < 8; });
  const Outcome outcome =
    TransformVoxel(row, BoundarySites(row), { { 4, 0, 0 } }, MakeBox({ { 1, 0, 0 } }, { { 9, 1, 1 } }));
  EXPECT_TRUE(outcome.missing.Contains(KernelIndex({ { 0, 0, 0 } })));
}

TEST(MedialVoxelFeatureTransform, ANearerSiteJustOutsideTheWindowIsNotOverlooked)
{
  // One site 4 away in the first layer that the window lacks, another one sqrt(17) away on the other side.
  const Volume solid = Complement(Volume({ { 21, 21, 21 } }, UnitSpacing));
  const Index3 center{ { 10, 10, 10 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int side : { -1, 1 })
    {
      Index3 outside = center;
      outside[axis] += 4 * side;
      Index3 inside = center;
      inside[axis] -= 4 * side;
      inside[(axis + 1) % 3] += 1;
      auto known = GridOf(solid).GetVoxelBox();
      (side < 0 ? known.lower : known.upper)[axis] = side < 0 ? 7 : 14;
      const Outcome first = TransformVoxel(solid, { inside, outside }, center, known);
      EXPECT_TRUE(first.missing.Contains(KernelIndex(outside))) << "axis " << axis << ", side " << side;
      const Outcome second = TransformVoxel(solid, { inside, outside }, center, GridOf(solid).GetVoxelBox());
      EXPECT_TRUE(second.missing.IsEmpty());
      EXPECT_EQ(second.site, outside);
    }
  }
}

TEST(MedialVoxelFeatureTransform, LengthsThatRoundToTheSameSumAreTies)
{
  // Two sites whose lengths in the plane differ in the last bit, which the square along z rounds away.
  int tried = 0;
  for (const Vector3 & spacing : { CraniumSpacing, Vector3{ { 0.7, 0.7, 1.3 } }, Vector3{ { 0.9, 1.2, 0.3 } } })
  {
    const Volume solid = Complement(Volume({ { 61, 61, 41 } }, spacing));
    const Index3 center{ { 30, 30, 20 } };
    for (int dz = 5; dz <= 20; dz += 5)
    {
      for (int code = 0; code < 31 * 31 * 31; ++code)
      {
        const Index3 low{ { 30 - code % 31, 30 - code / 31 % 31, 20 - dz } };
        const Index3 high{ { 30 + code / 961, 30, 20 - dz } };
        const Volume plane({ { 61, 61, 2 } }, spacing);
        const bool   sameSum = KeyDistance(solid, center, low) == KeyDistance(solid, center, high);
        if (low[1] < 30 && sameSum &&
            KeyDistance(plane, { { 30, 30, 0 } }, { { low[0], low[1], 0 } }) >
              KeyDistance(plane, { { 30, 30, 0 } }, { { high[0], 30, 0 } }))
        {
          ++tried;
          const Outcome outcome = TransformVoxel(solid, { low, high }, center, GridOf(solid).GetVoxelBox());
          ASSERT_EQ(outcome.site, low) << "the smaller y wins";
        }
      }
    }
  }
  EXPECT_GT(tried, 3);
}

TEST(MedialVoxelFeatureTransform, MaximumDistanceIsPhysicalAndNeedsNoMore)
{
  for (const Vector3 & spacing : { Vector3{ { 0.5, 0.5, 0.5 } }, CraniumSpacing })
  {
    const Volume                           volume = RandomVolume({ { 70, 30, 20 } }, spacing, 0.999, 168);
    const auto                             image = GridOf(volume).GetVoxelBox();
    const auto                             sites = BoundarySites(volume);
    const auto                             tile = MakeBox({ { 30, 12, 8 } }, { { 41, 19, 13 } });
    MedialVoxelFeatureTransform::Workspace workspace;
    itk::MedialVoxelFeatures               features;
    for (const double maximum : { 0.5, 1.0, 2.5, 4.0 })
    {
      const MedialVoxelFeatureTransform transform(GridOf(volume), itk::MedialVoxelRegion::Both, maximum);
      const auto                        known = tile.Expanded(KernelIndex({ { 10, 10, 10 } })).Intersection(image);
      const auto                        object = ObjectBits(volume, known);
      const auto                        bits = SiteBits(sites, known);
      EXPECT_TRUE(transform.Compute({ &object, &bits }, tile, workspace, features).IsEmpty());
      EXPECT_EQ(Differences(volume, sites, features, itk::MedialVoxelRegion::Both, maximum), 0u);
    }
  }
}

TEST(MedialVoxelFeatureTransform, WithoutSitesItAsksForTheWholeImageOnce)
{
  const Volume                           full = Complement(Volume({ { 50, 40, 30 } }, UnitSpacing));
  const auto                             image = GridOf(full).GetVoxelBox();
  const MedialVoxelFeatureTransform      transform(GridOf(full));
  MedialVoxelFeatureTransform::Workspace workspace;
  itk::MedialVoxelFeatures               features;
  const auto                             tile = MakeBox({ { 20, 20, 20 } }, { { 24, 24, 24 } });
  itk::MedialVoxelBox                    known = tile.Expanded(KernelIndex({ { 2, 2, 2 } }));
  for (int round = 0; known != image; ++round)
  {
    ASSERT_LT(round, 8);
    const auto                 object = ObjectBits(full, known);
    const itk::MedialVoxelBits none(known);
    known = known.Union(transform.Compute({ &object, &none }, tile, workspace, features)).Intersection(image);
  }
  const auto                 object = ObjectBits(full, image);
  const itk::MedialVoxelBits none(image);
  EXPECT_TRUE(transform.Compute({ &object, &none }, tile, workspace, features).IsEmpty());
  EXPECT_EQ(Differences(full, {}, features, itk::MedialVoxelRegion::Inside), 0u);
}

namespace
{
/** How many displacements of a whole volume differ from brute force, cut into tiles whose workspace is shared. */
std::size_t
DifferencesInTiles(const Volume &              volume,
                   const std::vector<Index3> & sites,
                   const Index3 &              tileSize,
                   itk::MedialVoxelRegion      region)
{
  const auto                             image = GridOf(volume).GetVoxelBox();
  const auto                             object = ObjectBits(volume, image);
  const auto                             bits = SiteBits(sites, image);
  const MedialVoxelFeatureTransform      transform(GridOf(volume), region);
  MedialVoxelFeatureTransform::Workspace workspace;
  itk::MedialVoxelFeatures               features;
  std::size_t                            differences = 0;
  for (const auto & tile : itk::MedialVoxelCutIntoTiles(image, KernelIndex(tileSize)))
  {
    EXPECT_TRUE(transform.Compute({ &object, &bits }, tile, workspace, features).IsEmpty());
    differences += Differences(volume, sites, features, region);
  }
  return differences;
}
} // namespace

TEST(MedialVoxelFeatureTransform, SolidsWithFewHolesAreBruteForce)
{
  // Distances of hundreds of voxels along each axis, at which thick and thin tiles follow each other.
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const Vector3 & spacing : { UnitSpacing, CraniumSpacing })
    {
      Index3 size{ { 11, 11, 11 } };
      size[axis] = 900;
      Volume solid = Complement(Volume(size, spacing));
      for (const int hole : { 3, 310, 313, 720, 725, 727, 731 })
      {
        Index3 at{ { 2 + hole % 7, hole % 5, hole % 9 } };
        at[axis] = hole;
        solid.object[solid.Offset(at)] = 0;
      }
      for (const auto side : { BoundarySide::Background, BoundarySide::Object })
      {
        const auto sites = BoundarySites(solid, side);
        Index3     tileSize{ { 64, 6, 5 } };
        tileSize[axis] = 230;
        EXPECT_EQ(DifferencesInTiles(solid, sites, tileSize, itk::MedialVoxelRegion::Inside), 0u) << axis;
        EXPECT_EQ(DifferencesInTiles(solid, sites, size, itk::MedialVoxelRegion::Both), 0u) << axis;
      }
    }
  }
}

TEST(MedialVoxelFeatureTransform, DistancesBeyondTheReachOfKeysAreBruteForce)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    Index3 size{ { 2, 2, 2 } };
    size[axis] = 4200;
    Volume solid = Complement(Volume(size, UnitSpacing));
    solid.object[solid.Offset({ { 0, 0, 0 } })] = 0;
    const auto                             sites = BoundarySites(solid);
    const auto                             image = GridOf(solid).GetVoxelBox();
    const auto                             object = ObjectBits(solid, image);
    const auto                             bits = SiteBits(sites, image);
    const MedialVoxelFeatureTransform      transform(GridOf(solid));
    MedialVoxelFeatureTransform::Workspace workspace;
    itk::MedialVoxelFeatures               features;
    auto                                   tile = image;
    tile.lower[axis] = 4085;
    tile.upper[axis] = 4105;
    EXPECT_TRUE(transform.Compute({ &object, &bits }, tile, workspace, features).IsEmpty());
    EXPECT_EQ(Differences(solid, sites, features, itk::MedialVoxelRegion::Inside), 0u) << axis;
  }
}

TEST(MedialVoxelFeatureTransform, DenseSitesDoNotLimitTheSlicesOfATile)
{
  // More sites in the slices than the search remembers at once, around voxels that the table does not reach.
  const Volume volume = MakeVolume({ { 34, 26, 30 } }, UnitSpacing, [](const Index3 & v) {
    const bool inCore = v[0] > 4 && v[0] < 30 && v[1] > 4 && v[1] < 22 && v[2] > 4 && v[2] < 26;
    return inCore || (v[0] + v[1] + v[2]) % 2 == 0;
  });
  EXPECT_EQ(DifferencesInTiles(volume, BoundarySites(volume), volume.size, itk::MedialVoxelRegion::Inside), 0u);
}

TEST(MedialVoxelFeatureTransform, NothingStaysOfTheTilesBefore)
{
  // Tiles that grow and shrink, some with objects all over and some with few, one after the other in the same memory.
  const itk::MedialVoxelBox              tiles[] = { MakeBox({ { 0, 0, 0 } }, { { 150, 9, 8 } }),
                                                     MakeBox({ { 70, 2, 1 } }, { { 75, 5, 4 } }),
                                                     MakeBox({ { 3, 0, 0 } }, { { 140, 9, 7 } }),
                                                     MakeBox({ { 0, 0, 0 } }, { { 150, 10, 9 } }) };
  MedialVoxelFeatureTransform::Workspace workspace;
  itk::MedialVoxelFeatures               features;
  for (const double density : { 0.9, 0.01, 0.0, 0.3, 0.002 })
  {
    const Volume                      volume = RandomVolume({ { 150, 10, 9 } }, UnitSpacing, density, 168);
    const auto                        sites = BoundarySites(volume);
    const auto                        object = ObjectBits(volume, GridOf(volume).GetVoxelBox());
    const auto                        bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
    const MedialVoxelFeatureTransform transform(GridOf(volume));
    for (const itk::MedialVoxelBox & tile : tiles)
    {
      EXPECT_TRUE(transform.Compute({ &object, &bits }, tile, workspace, features).IsEmpty());
      EXPECT_EQ(Differences(volume, sites, features, itk::MedialVoxelRegion::Inside), 0u) << density;
    }
  }
}

TEST(MedialVoxelFeatureTransform, FeaturesAreZeroAfterReset)
{
  itk::MedialVoxelFeatures features;
  features.Reset(MakeBox({ { 1, 2, 3 } }, { { 4, 4, 4 } }));
  EXPECT_EQ(features.dx, std::vector<std::int32_t>(6, 0));
  EXPECT_EQ(features.dy, std::vector<std::int32_t>(6, 0));
  EXPECT_EQ(features.dz, std::vector<std::int32_t>(6, 0));
  EXPECT_EQ(features.OffsetOf(3, 3, 3), 5u);
  EXPECT_TRUE(features.HasSite(0));
  features.dx[0] = itk::MedialVoxelNoDisplacement;
  EXPECT_FALSE(features.HasSite(0));
}
