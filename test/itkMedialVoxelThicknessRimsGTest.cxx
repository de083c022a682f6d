// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestMeasurement.h"
#include "MedialVoxelTestPhantoms.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

bool
Everywhere(const itk::MedialVoxelIndex &)
{
  return true;
}

/** A block along the axes; its edges are square. */
Volume
Block(const Index3 & extent)
{
  return MakeVolume({ { extent[0] + 12, extent[1] + 12, extent[2] + 12 } }, UnitSpacing, [=](const Index3 & v) {
    bool isInside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      isInside = isInside && v[axis] >= 6 && v[axis] < 6 + extent[axis];
    }
    return isInside;
  });
}
} // namespace

TEST(MedialVoxelThicknessRims, CellsBesideSquareRimsAreExact)
{
  for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 1.0, 1.0, 1.3 } }, Vector3{ { 0.7, 1.2, 0.7 } } })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int thickness = 1; thickness <= 9; ++thickness)
      {
        Index3 extent{ { 22, 24, 26 } };
        extent[axis] = thickness;
        Volume volume = Block(extent);
        volume.spacing = spacing;
        // Without branches into the edges.
        const Measurement measured(volume, std::max(3.0, thickness - 1.0) * spacing[axis], Everywhere);
        const auto        values = measured.GetWallValues();
        ASSERT_GT(values.size(), 20u);
        const float expected = static_cast<float>(thickness * spacing[axis]);
        EXPECT_NEAR(values.front(), expected, 1e-6 * expected) << axis << ' ' << thickness << ' ' << spacing[2];
        EXPECT_NEAR(values.back(), expected, 1e-6 * expected) << axis << ' ' << thickness << ' ' << spacing[2];
      }
    }
  }
}

TEST(MedialVoxelThicknessRims, CellsInBranchesIntoEdgesAreMarked)
{
  for (int turn = 0; turn < 3; ++turn)
  {
    const Index3      extent{ { 30, 34, 8 } };
    const Measurement measured(
      Block({ { extent[turn], extent[(turn + 1) % 3], extent[(turn + 2) % 3] } }), 3.0, Everywhere);
    const std::vector<double> values = measured.GetWallValues();
    ASSERT_GT(values.size(), 20u);
    EXPECT_LT(2 * values.size(), measured.GetValues().size());
    EXPECT_EQ(values.front(), 8.0) << turn;
    EXPECT_EQ(values.back(), 8.0) << turn;
  }
}
