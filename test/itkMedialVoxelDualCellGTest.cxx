// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelDualCell.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

itk::MedialVoxelDisplacement
Between(const Index3 & from, const Index3 & to)
{
  return { { to[0] - from[0], to[1] - from[1], to[2] - from[2] } };
}

std::vector<Volume>
Grids()
{
  const Index3 size{ { 30, 30, 30 } };
  return { Volume(size, UnitSpacing),
           Volume(size, { { 0.5, 0.5, 0.5 } }),
           Volume(size, { { 0.9570312, 0.9570312, 1.5 } }),
           Volume(size, { { 2.0, 0.3, 1.1 } }),
           Volume({ { 30, 30, 1 } }, { { 0.7, 1.1, 1.3 } }),
           Volume({ { 30, 1, 30 } }, { { 0.7, 1.1, 1.3 } }),
           Volume({ { 1, 30, 30 } }, { { 0.7, 1.1, 1.1 } }),
           Volume({ { 1, 30, 1 } }, { { 0.7, 1.1, 1.3 } }) };
}

Index3
RandomVoxel(const Volume & volume, std::mt19937 & generator)
{
  return { { static_cast<int>(generator() % volume.size[0]),
             static_cast<int>(generator() % volume.size[1]),
             static_cast<int>(generator() % volume.size[2]) } };
}
} // namespace

TEST(MedialVoxelDualCell, CornersAndDiagonalsFollowTheActiveAxes)
{
  for (const Volume & volume : Grids())
  {
    const itk::MedialVoxelDualCell cell(GridOf(volume));
    const auto                     corners = 1u << volume.Axes().size();
    ASSERT_EQ(cell.GetNumberOfCorners(), corners);
    EXPECT_EQ(cell.GetNumberOfDiagonals(), corners / 2);
    for (unsigned int k = 0; k < corners; ++k)
    {
      EXPECT_EQ(cell.GetCorner(k), KernelIndex(CellCorner(volume, Index3{}, static_cast<int>(k))));
      EXPECT_EQ(cell.GetOppositeCorner(k), corners - 1 - k);
    }
  }
}

TEST(MedialVoxelDualCell, MeasuresOfPairsAreTheDefinitions)
{
  std::mt19937 generator(5);
  for (const Volume & volume : Grids())
  {
    const itk::MedialVoxelDualCell cell(GridOf(volume));
    for (int trial = 0; trial < 3000; ++trial)
    {
      const Index3 at = RandomVoxel(volume, generator);
      const auto   k = static_cast<unsigned int>(generator() % cell.GetNumberOfDiagonals());
      const Index3 vi = CellCorner(volume, at, static_cast<int>(k));
      const Index3 vj = CellCorner(volume, at, static_cast<int>(cell.GetOppositeCorner(k)));
      const Index3 ni = RandomVoxel(volume, generator);
      const Index3 nj = RandomVoxel(volume, generator);
      ASSERT_EQ(cell.CosineKey(k, Between(vi, ni), Between(vj, nj)), CosineKey(volume, at, ni, nj));
      ASSERT_NEAR(cell.PseudoGeodesicDistance(Between(vi, ni), Between(vj, nj)),
                  std::max(0.0, PaperPseudoGeodesic(volume, vi, ni, vj, nj)),
                  1e-6); // acos and atan2 differ by 1e-8 near pi
    }
  }
}

TEST(MedialVoxelDualCell, FreeSpaceLengthIsTheShortestOfAllPaths)
{
  for (const Volume & volume : Grids())
  {
    const itk::MedialVoxelDualCell cell(GridOf(volume));
    for (int x = -6; x <= 6; ++x)
    {
      for (int y = -5; y <= 5; ++y)
      {
        for (int z = -6; z <= 6; ++z)
        {
          const Index3 b{ { volume.size[0] > 1 ? x : 0, volume.size[1] > 1 ? y : 0, volume.size[2] > 1 ? z : 0 } };
          ASSERT_EQ(cell.FreeSpaceLength(KernelIndex(b)), FreeSpaceLength(volume, Index3{}, b));
        }
      }
    }
  }
}

TEST(MedialVoxelDualCell, NeighborsByAShortEdgeAreTrivial)
{
  for (const Volume & volume : Grids())
  {
    const itk::MedialVoxelDualCell cell(GridOf(volume));
    for (int mask = 1; mask < 8; ++mask)
    {
      const double edge = EdgeLength(volume, mask);
      for (const double epsilon : { edge, std::nextafter(edge, 0.0), std::nextafter(edge, 9.0), 0.01, 100.0 })
      {
        for (int code = 0; code < 125; ++code)
        {
          const Index3 b{ { volume.size[0] > 1 ? code % 5 - 2 : 0,
                            volume.size[1] > 1 ? code / 5 % 5 - 2 : 0,
                            volume.size[2] > 1 ? code / 25 - 2 : 0 } };
          ASSERT_EQ(cell.IsTrivial(KernelIndex(b), epsilon), IsTrivialPair(volume, Index3{}, b, epsilon));
        }
      }
    }
  }
}

TEST(MedialVoxelDualCell, PaperBoundTakesTheSmallerNorm)
{
  const itk::MedialVoxelDualCell cell(GridOf(Volume({ { 30, 30, 30 } }, UnitSpacing)));
  EXPECT_EQ(cell.PseudoGeodesicDistance({ { 0, 0, -2 } }, { { 0, 0, 3 } }), 2.0 * 3.14159265358979323846);
  EXPECT_EQ(cell.PseudoGeodesicDistance({ { 0, 0, 0 } }, { { 0, 0, 3 } }), 0.0);
  EXPECT_EQ(cell.PseudoGeodesicDistance({ { 0, 4, 0 } }, { { 0, 0, 0 } }), 0.0);
  EXPECT_NEAR(cell.PseudoGeodesicDistance({ { 0, 4, 0 } }, { { 0, 0, 5 } }), 2.0 * 3.14159265358979323846, 1e-12);
}

TEST(MedialVoxelDualCell, PathLengthsAreSummedInMaskOrder)
{
  const Volume     volume({ { 9, 9, 9 } }, { { 0.7, 1.1, 1.3 } });
  const EdgeCounts counts{ { 0, 3, 1, 4, 1, 5, 9, 2 } };
  EXPECT_EQ(itk::MedialVoxelPathLength(GridOf(volume), { { 0, 3, 1, 4, 1, 5, 9, 2 } }), PathLength(volume, counts));
}
