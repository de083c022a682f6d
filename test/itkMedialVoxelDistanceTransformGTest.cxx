// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelDistanceTransform.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelDistanceTransform;
constexpr std::int32_t None = itk::MedialVoxelSquaredLengths::None;

/** How many squared distances of a tile differ from brute force. */
std::size_t
Differences(const Volume &                         volume,
            const std::vector<Index3> &            sites,
            const itk::MedialVoxelBox &            tile,
            const itk::MedialVoxelSquaredLengths & lengths)
{
  std::size_t differences = 0;
  ForEachVoxel(tile, [&](const itk::MedialVoxelIndex & index) {
    const Index3 v = OracleIndex(index);
    const long   n = NearestSite(volume, sites, v);
    std::int32_t expected = None;
    if (n >= 0)
    {
      expected = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        expected += (sites[n][axis] - v[axis]) * (sites[n][axis] - v[axis]);
      }
    }
    differences += lengths.values[lengths.box.OffsetOf(index)] != expected ? 1 : 0;
  });
  return differences;
}

std::vector<Volume>
Volumes()
{
  return { RandomBoxes({ { 75, 40, 18 } }, UnitSpacing, 12, 161),
           RandomVolume({ { 70, 15, 14 } }, UnitSpacing, 0.003, 162),
           RandomVolume({ { 33, 50, 40 } }, UnitSpacing, 0.0001, 163),
           LatticeOfHoles({ { 40, 22, 21 } }, UnitSpacing, 9),
           RandomVolume({ { 90, 40, 1 } }, UnitSpacing, 0.01, 164),
           RandomVolume({ { 1, 50, 40 } }, UnitSpacing, 0.99, 165),
           RandomVolume({ { 300, 1, 1 } }, UnitSpacing, 0.97, 166),
           RandomVolume({ { 20, 20, 20 } }, UnitSpacing, 0.0, 167) };
}
} // namespace

TEST(MedialVoxelDistanceTransform, WholeVolumesAreBruteForce)
{
  for (const BoundarySide side : { BoundarySide::Object, BoundarySide::Background })
  {
    for (const Volume & volume : Volumes())
    {
      const auto                              image = GridOf(volume).GetVoxelBox();
      const auto                              sites = BoundarySites(volume, side);
      const auto                              bits = SiteBits(sites, image);
      const MedialVoxelDistanceTransform      transform(GridOf(volume));
      MedialVoxelDistanceTransform::Workspace workspace;
      itk::MedialVoxelSquaredLengths          lengths;
      EXPECT_TRUE(transform.Compute(bits, image, workspace, lengths).IsEmpty());
      EXPECT_EQ(Differences(volume, sites, image, lengths), 0u);
      EXPECT_EQ(workspace.GetLargest() >= None, sites.empty());
    }
  }
}

TEST(MedialVoxelDistanceTransform, TilesInSmallWindowsAreFinalOrSayWhatTheyMiss)
{
  std::mt19937                            generator(4);
  MedialVoxelDistanceTransform::Workspace workspace; // one for all tiles: nothing of a tile may leak into the next
  itk::MedialVoxelSquaredLengths          lengths;
  int                                     asked = 0;
  int                                     final = 0;
  for (const Volume & volume : Volumes())
  {
    const auto                         image = GridOf(volume).GetVoxelBox();
    const auto                         sites = BoundarySites(volume, BoundarySide::Object);
    const MedialVoxelDistanceTransform transform(GridOf(volume));
    for (int trial = 0; trial < 60; ++trial)
    {
      const itk::MedialVoxelBox tile = RandomBox(volume.size, generator);
      const int                 margin = static_cast<int>(generator() % 9) - 2;
      itk::MedialVoxelBox       known = tile.Expanded(KernelIndex({ { margin, margin, margin } })).Intersection(image);
      for (int round = 0;; ++round)
      {
        ASSERT_LT(round, 10);
        const auto bits = SiteBits(sites, known);
        const auto missing = transform.Compute(bits, tile, workspace, lengths);
        if (missing.IsEmpty())
        {
          break;
        }
        EXPECT_TRUE(image.Contains(missing));
        EXPECT_FALSE(known.Contains(missing));
        known = missing;
        ++asked;
      }
      ++final;
      EXPECT_EQ(Differences(volume, sites, tile, lengths), 0u);
    }
  }
  EXPECT_GT(asked, 50);
  EXPECT_GT(final, 400);
}

/** A site that is not known is nearer than the nearest one that is. */
TEST(MedialVoxelDistanceTransform, AsksForSitesBesideANarrowWindow)
{
  const itk::MedialVoxelGrid              grid({ { 21, 21, 21 } }, UnitSpacing);
  const auto                              tile = MakeBox({ { 10, 10, 10 } }, { { 11, 11, 11 } });
  const auto                              known = MakeBox({ { 0, 9, 9 } }, { { 21, 12, 12 } });
  const std::vector<Index3>               sites{ { { 12, 11, 10 } }, { { 10, 12, 10 } } };
  MedialVoxelDistanceTransform::Workspace workspace;
  itk::MedialVoxelSquaredLengths          lengths;
  const MedialVoxelDistanceTransform      transform(grid);
  EXPECT_FALSE(transform.Compute(SiteBits(sites, known), tile, workspace, lengths).IsEmpty());
  EXPECT_EQ(workspace.GetLargest(), 5);
  EXPECT_TRUE(transform.Compute(SiteBits(sites, grid.GetVoxelBox()), tile, workspace, lengths).IsEmpty());
  EXPECT_EQ(workspace.GetLargest(), 4);
}

/** The nearest site lies beyond what is searched first, and another one in a corner of that. */
TEST(MedialVoxelDistanceTransform, SearchesFurtherThanTheReachThatItGuessed)
{
  const itk::MedialVoxelGrid grid({ { 161, 161, 161 } }, UnitSpacing);
  const auto                 tile = MakeBox({ { 80, 80, 80 } }, { { 81, 81, 81 } });
  for (int reach = 2; reach < 78; ++reach)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Index3 corner{ { 80 + reach, 80 + reach, 80 - reach } };
      Index3 beyond{ { 80, 80, 80 } };
      beyond[axis] += reach + 1;
      MedialVoxelDistanceTransform::Workspace workspace;
      itk::MedialVoxelSquaredLengths          lengths;
      const auto                              bits = SiteBits({ corner, beyond }, grid.GetVoxelBox());
      EXPECT_TRUE(MedialVoxelDistanceTransform(grid).Compute(bits, tile, workspace, lengths).IsEmpty());
      EXPECT_EQ(workspace.GetLargest(), (reach + 1) * (reach + 1));
    }
  }
}

TEST(MedialVoxelDistanceTransform, NeedsEqualSpacingsAndSizesThatFit)
{
  EXPECT_TRUE(MedialVoxelDistanceTransform::CanTransform({ { { 16384, 9, 9 } }, { { 0.3, 0.3, 0.3 } } }));
  EXPECT_TRUE(MedialVoxelDistanceTransform::CanTransform({ { { 9, 9, 1 } }, { { 0.3, 0.3, 5.0 } } }));
  EXPECT_FALSE(MedialVoxelDistanceTransform::CanTransform({ { { 16385, 9, 9 } }, { { 0.3, 0.3, 0.3 } } }));
  EXPECT_FALSE(MedialVoxelDistanceTransform::CanTransform({ { { 9, 9, 9 } }, { { 0.3, 0.3, 0.4 } } }));
}
