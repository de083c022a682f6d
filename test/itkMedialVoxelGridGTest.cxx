// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelGrid.h"

#include "itkMedialVoxelParameters.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace MedialVoxelTest;

const itk::MedialVoxelBox Box = MakeBox({ { 2, 3, 4 } }, { { 7, 9, 5 } });
const itk::MedialVoxelBox Empty = MakeBox({ { 2, 3, 4 } }, { { 7, 3, 5 } });
} // namespace

TEST(MedialVoxelGrid, BoxesAreHalfOpen)
{
  EXPECT_EQ(Box.Extent(1), 6);
  EXPECT_EQ(Box.NumberOfVoxels(), 30);
  EXPECT_TRUE(Box.Contains(KernelIndex({ { 2, 3, 4 } })));
  EXPECT_TRUE(Box.Contains(KernelIndex({ { 6, 8, 4 } })));
  for (const Index3 & outside :
       { Index3{ { 7, 8, 4 } }, Index3{ { 6, 9, 4 } }, Index3{ { 6, 8, 5 } }, Index3{ { 1, 3, 4 } } })
  {
    EXPECT_FALSE(Box.Contains(KernelIndex(outside)));
  }
  EXPECT_FALSE(Box.IsEmpty());
  EXPECT_TRUE(Empty.IsEmpty());
  EXPECT_EQ(Empty.NumberOfVoxels(), 0);
}

TEST(MedialVoxelGrid, BoxesHoldOtherBoxes)
{
  EXPECT_TRUE(Box.Contains(Box));
  EXPECT_TRUE(Box.Contains(MakeBox({ { 3, 4, 4 } }, { { 7, 8, 5 } })));
  EXPECT_FALSE(Box.Contains(MakeBox({ { 3, 4, 4 } }, { { 8, 8, 5 } })));
  EXPECT_FALSE(Box.Contains(MakeBox({ { 3, 2, 4 } }, { { 7, 8, 5 } })));
  EXPECT_TRUE(Box.Contains(MakeBox({ { 50, 50, 50 } }, { { 50, 60, 60 } }))); // empty
}

TEST(MedialVoxelGrid, BoxesGrowMeetAndJoin)
{
  EXPECT_EQ(Box.Expanded(KernelIndex({ { 1, 2, 0 } })), MakeBox({ { 1, 1, 4 } }, { { 8, 11, 5 } }));
  const auto other = MakeBox({ { 5, 0, 0 } }, { { 9, 4, 9 } });
  EXPECT_EQ(Box.Intersection(other), MakeBox({ { 5, 3, 4 } }, { { 7, 4, 5 } }));
  EXPECT_TRUE(Box.Intersection(MakeBox({ { 7, 0, 0 } }, { { 9, 9, 9 } })).IsEmpty());
  EXPECT_EQ(Box.Union(other), MakeBox({ { 2, 0, 0 } }, { { 9, 9, 9 } }));
  EXPECT_EQ(Box.Union(Empty), Box);
  EXPECT_EQ(Empty.Union(Box), Box);
  EXPECT_NE(Box, other);
}

TEST(MedialVoxelGrid, EqualSpacingsAreComparedInVoxels)
{
  const itk::MedialVoxelGrid grid(KernelIndex({ { 9, 8, 1 } }), { { 0.5, 0.5, 7.0 } });
  EXPECT_TRUE(grid.HasEqualSpacing());
  EXPECT_EQ(grid.SquaredMetricLength(3, 4, 0), 25.0);
  EXPECT_EQ(grid.GetMetricUnit(), 0.5);
  EXPECT_TRUE(grid.IsActive(0) && grid.IsActive(1));
  EXPECT_FALSE(grid.IsActive(2));
  EXPECT_EQ(grid.GetUnitMargin(), KernelIndex({ { 1, 1, 0 } }));
}

TEST(MedialVoxelGrid, SpacingsThatAreNearlyEqualAreEqual)
{
  const itk::MedialVoxelGrid grid(KernelIndex({ { 9, 8, 7 } }), { { 1.0, 1.000000015, 0.9999999 } });
  EXPECT_TRUE(grid.HasEqualSpacing());
  EXPECT_EQ(grid.GetSpacing(), (itk::MedialVoxelGrid::SpacingType{ { 1.0, 1.0, 1.0 } }));
  EXPECT_EQ(grid.GetEdgeLength(6), std::sqrt(2.0));

  const itk::MedialVoxelGrid two(KernelIndex({ { 9, 8, 7 } }), { { 0.9570312, 0.95703119, 1.5 } });
  EXPECT_FALSE(two.HasEqualSpacing());
  EXPECT_EQ(two.GetSpacing(), (itk::MedialVoxelGrid::SpacingType{ { 0.9570312, 0.9570312, 1.5 } }));

  const itk::MedialVoxelGrid other(KernelIndex({ { 9, 8, 7 } }), { { 1.0, 1.0, 1.000002 } });
  EXPECT_FALSE(other.HasEqualSpacing());
}

TEST(MedialVoxelGrid, UnequalSpacingsAreComparedInSpace)
{
  const itk::MedialVoxelGrid grid(KernelIndex({ { 9, 8, 7 } }), { { 0.5, 0.5, 2.0 } });
  EXPECT_FALSE(grid.HasEqualSpacing());
  EXPECT_EQ(grid.SquaredMetricLength(-2, 4, -3), 1.0 + 4.0 + 36.0);
  EXPECT_EQ(grid.GetMetricUnit(), 1.0);
}

TEST(MedialVoxelGrid, EdgesArePhysical)
{
  const Volume               volume({ { 9, 8, 7 } }, { { 0.5, 0.7, 2.0 } });
  const itk::MedialVoxelGrid grid = GridOf(volume);
  for (int mask = 1; mask < 8; ++mask)
  {
    EXPECT_EQ(grid.GetEdgeLength(mask), EdgeLength(volume, mask)) << mask;
  }
  EXPECT_EQ(grid.GetEdgeLength(0), 0.0);
  EXPECT_EQ(grid.GetLongestEdge(), EdgeLength(volume, 7));
  EXPECT_EQ(grid.GetShortestEdge(), 0.5);
  const itk::MedialVoxelGrid point(KernelIndex({ { 1, 1, 1 } }), UnitSpacing);
  EXPECT_TRUE(std::isinf(point.GetShortestEdge()));
  const itk::MedialVoxelGrid flat(KernelIndex({ { 9, 1, 7 } }), { { 0.5, 0.1, 2.0 } });
  EXPECT_EQ(flat.GetShortestEdge(), 0.5);
  EXPECT_EQ(flat.GetLongestEdge(), std::sqrt(0.25 + 4.0));
}

TEST(MedialVoxelGrid, CellsLieBetweenTheVoxels)
{
  EXPECT_EQ(GridOf(Volume({ { 9, 8, 7 } }, UnitSpacing)).GetCellBox(), MakeBox({ { 0, 0, 0 } }, { { 8, 7, 6 } }));
  EXPECT_EQ(GridOf(Volume({ { 9, 1, 7 } }, UnitSpacing)).GetCellBox(), MakeBox({ { 0, 0, 0 } }, { { 8, 1, 6 } }));
  EXPECT_TRUE(GridOf(Volume({ { 1, 1, 1 } }, UnitSpacing)).GetCellBox().IsEmpty());
  EXPECT_EQ(GridOf(Volume({ { 9, 8, 7 } }, UnitSpacing)).GetVoxelBox(), MakeBox({ { 0, 0, 0 } }, { { 9, 8, 7 } }));
}

TEST(MedialVoxelGrid, MarginsCoverTheLength)
{
  const itk::MedialVoxelGrid grid(KernelIndex({ { 90, 80, 1 } }), { { 0.5, 0.7, 2.0 } });
  for (const double length : { 0.1, 0.5, 0.7, 1.0, 3.3, 21.0 })
  {
    const auto margin = grid.MarginForMetricLength(length);
    EXPECT_GE(static_cast<double>(margin[0]) * 0.5, length);
    EXPECT_LE(static_cast<double>(margin[0] - 2) * 0.5, length);
    EXPECT_GE(static_cast<double>(margin[1]) * 0.7, length);
    EXPECT_EQ(margin[2], 0);
  }
}

TEST(MedialVoxelGrid, SizesAre64Bit)
{
  const itk::MedialVoxelGrid grid({ { std::int64_t{ 1 } << 40, 3, 3 } }, UnitSpacing);
  EXPECT_EQ(grid.GetVoxelBox().NumberOfVoxels(), std::int64_t{ 9 } << 40);
}

TEST(MedialVoxelGrid, EpsilonIsHalfACircle)
{
  for (const double thickness : { 0.1, 2.0, 3.0, 5.0 })
  {
    EXPECT_EQ(itk::MedialVoxelParameters::EpsilonFromThickness(thickness), EpsilonOf(thickness));
  }
}

TEST(MedialVoxelGrid, CountsAdd)
{
  itk::MedialVoxelCounts sum;
  std::uint64_t          value = 0;
  for (auto * field : { &sum.objectVoxels,
                        &sum.boundaryVoxels,
                        &sum.notANumberVoxels,
                        &sum.candidateCells,
                        &sum.trivialCells,
                        &sum.boundCells,
                        &sum.geodesicMedialCells,
                        &sum.geodesicNonMedialCells })
  {
    EXPECT_EQ(*field, 0u);
    *field = ++value;
  }
  const itk::MedialVoxelCounts more = sum;
  sum += more;
  EXPECT_EQ(sum.objectVoxels, 2u);
  EXPECT_EQ(sum.boundaryVoxels, 4u);
  EXPECT_EQ(sum.notANumberVoxels, 6u);
  EXPECT_EQ(sum.candidateCells, 8u);
  EXPECT_EQ(sum.trivialCells, 10u);
  EXPECT_EQ(sum.boundCells, 12u);
  EXPECT_EQ(sum.geodesicMedialCells, 14u);
  EXPECT_EQ(sum.geodesicNonMedialCells, 16u);
}
