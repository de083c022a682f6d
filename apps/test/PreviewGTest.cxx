// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Preview.h"

#include <gtest/gtest.h>

#include <functional>

using namespace medialvoxel;

namespace
{

using Rule = std::function<int(std::uint64_t, std::uint64_t, std::uint64_t)>;

std::vector<std::uint8_t>
MakeLabels(const std::vector<std::uint64_t> & size, const Rule & rule)
{
  std::vector<std::uint8_t> labels;
  for (std::uint64_t z = 0; z < size[2]; ++z)
  {
    for (std::uint64_t y = 0; y < size[1]; ++y)
    {
      for (std::uint64_t x = 0; x < size[0]; ++x)
      {
        labels.push_back(static_cast<std::uint8_t>(rule(x, y, z)));
      }
    }
  }
  return labels;
}

VolumeGeometry
MakeGeometry(const std::vector<std::uint64_t> & size)
{
  VolumeGeometry geometry;
  geometry.size = size;
  geometry.spacing.assign(size.size(), 1.0);
  return geometry;
}

std::vector<std::uint64_t>
GetBestSlices(const std::vector<std::uint64_t> & size, const Rule & rule, std::uint64_t slicesPerPiece)
{
  const std::vector<std::uint8_t> labels = MakeLabels(size, rule);
  SliceScores                     scores(MakeGeometry(size));
  for (std::uint64_t z = 0; z < size[2]; z += slicesPerPiece)
  {
    scores.Add(z, std::min(slicesPerPiece, size[2] - z), labels.data() + z * size[0] * size[1]);
  }
  return { scores.GetBestSlice(0), scores.GetBestSlice(1), scores.GetBestSlice(2) };
}

} // namespace

TEST(SliceScores, PreferLinesToBlots)
{
  // A sheet across z at z = 12, and a short one across x that makes the slices 20..24 of z and 3..7 of y special.
  const Rule rule = [](auto x, auto y, auto z) {
    return z == 12 || (x == 9 && y >= 3 && y < 8 && z >= 20 && z < 25) ? 2 : 1;
  };
  for (const std::uint64_t slicesPerPiece : { 1, 4, 40 })
  {
    const auto best = GetBestSlices({ 19, 30, 40 }, rule, slicesPerPiece);
    EXPECT_EQ(best[0], 9u);
    EXPECT_GE(best[1], 3u);
    EXPECT_LT(best[1], 8u);
    EXPECT_GE(best[2], 20u);
    EXPECT_LT(best[2], 25u);
  }
}

TEST(SliceScores, BothMedialLabelsCountAndOthersDoNot)
{
  for (const int label : { 2, 3 })
  {
    const Rule rule = [label](auto x, auto y, auto z) { return x == 17 && y == 5 && z == 6 ? label : z % 2 ? 1 : 0; };
    EXPECT_EQ(GetBestSlices({ 21, 20, 20 }, rule, 3), (std::vector<std::uint64_t>{ 17, 5, 6 }));
  }
}

TEST(SliceScores, WithoutMedialCellsTheMiddleIsShown)
{
  EXPECT_EQ(
    GetBestSlices({ 21, 10, 7 }, [](auto, auto, auto) { return 1; }, 7), (std::vector<std::uint64_t>{ 10, 5, 3 }));
}

TEST(SliceScores, SlicesAtTheFacesAreNotShown)
{
  const Rule rule = [](auto x, auto, auto z) { return (z == 0 && x % 2 == 0) || (z == 30 && x == 10) ? 2 : 1; };
  EXPECT_EQ(GetBestSlices({ 40, 40, 40 }, rule, 40)[2], 30u);
}

TEST(SliceScores, RowsWithLabelsAreKnown)
{
  const std::vector<std::uint64_t> size{ 130, 4, 9 };
  const Rule  rule = [](auto x, auto y, auto z) { return x == 129 && y == 3 && z == 5 ? 1 : x == 0 && z == 2 ? 3 : 0; };
  SliceScores scores(MakeGeometry(size));
  const auto  labels = MakeLabels(size, rule);
  scores.Add(0, 4, labels.data());
  scores.Add(4, 5, labels.data() + 4 * 130 * 4);
  for (std::uint64_t z = 0; z < size[2]; ++z)
  {
    for (std::uint64_t y = 0; y < size[1]; ++y)
    {
      EXPECT_EQ(scores.HasLabels(y, z), z == 2 || (z == 5 && y == 3)) << y << ", " << z;
    }
  }
}

TEST(SliceScores, EmptySlicesNeedNoLabels)
{
  const std::vector<std::uint64_t> size{ 40, 40, 40 };
  const Rule                       rule = [](auto x, auto y, auto z) {
    return z >= 9 && z < 12 && x + y == 33 ? 2 : z == 5 && x > y ? 3 : 0;
  };
  const auto  labels = MakeLabels(size, rule);
  SliceScores all(MakeGeometry(size));
  all.Add(0, 40, labels.data());
  SliceScores some(MakeGeometry(size));
  some.Add(0, 6, labels.data());
  some.AddEmpty();
  some.Add(9, 3, labels.data() + 9 * 1600);
  some.AddEmpty();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(some.GetBestSlice(axis), all.GetBestSlice(axis)) << axis;
  }
  EXPECT_EQ(some.HasLabels(20, 11), all.HasLabels(20, 11));
}
