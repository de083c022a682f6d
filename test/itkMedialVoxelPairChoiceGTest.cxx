// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelPairChoice.h"

#include "itkMedialVoxelNearestSite.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

/** Displacements of the four rows of corners of `cells` cells. */
struct Rows
{
  std::array<std::array<std::vector<std::int32_t>, 4>, 3> values;

  Rows(std::size_t cells, int reach, std::mt19937 & generator)
  {
    for (auto & component : values)
    {
      for (auto & row : component)
      {
        for (std::size_t i = 0; i < cells + 1; ++i)
        {
          row.push_back(static_cast<std::int32_t>(generator() % (2 * reach + 1)) - reach);
        }
      }
    }
  }

  itk::MedialVoxelCornerRows
  Pointers() const
  {
    itk::MedialVoxelCornerRows pointers;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (std::size_t row = 0; row < 4; ++row)
      {
        pointers.rows[axis][row] = values[axis][row].data();
      }
    }
    return pointers;
  }

  itk::MedialVoxelDisplacement
  Of(std::size_t cell, unsigned int corner) const
  {
    const std::size_t x = cell + (corner & 1u);
    return { { values[0][corner >> 1][x], values[1][corner >> 1][x], values[2][corner >> 1][x] } };
  }

  /** Between the boundary points of a diagonal. */
  itk::MedialVoxelDisplacement
  DifferenceOf(std::size_t cell, unsigned int corner) const
  {
    const auto                   first = this->Of(cell, corner);
    const auto                   second = this->Of(cell, 7 - corner);
    itk::MedialVoxelDisplacement difference;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      difference[axis] = first[axis] - second[axis] + 2 * static_cast<std::int64_t>((corner >> axis) & 1u) - 1;
    }
    return difference;
  }
};

int
WidestOf(const Rows & rows)
{
  std::int8_t widest = 77;
  itk::MedialVoxelWidestDiagonals(rows.Pointers(), 1, 1, &widest);
  return widest;
}

const itk::MedialVoxelGrid UnitGrid({ { 99, 99, 99 } }, { { 1.0, 1.0, 1.0 } });
} // namespace

TEST(MedialVoxelPairChoice, NontrivialCellsHaveANontrivialDiagonal)
{
  const itk::MedialVoxelDualCell cell(UnitGrid);
  std::mt19937                   generator(21);
  std::size_t                    spreadCells = 0;
  for (const std::size_t cells : { 64u, 63u, 48u, 17u, 16u, 15u, 1u })
  {
    for (int trial = 0; trial < 200; ++trial)
    {
      const Rows          rows(cells, trial % 2, generator);
      const std::uint64_t all = cells == 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << cells) - 1;
      const std::uint64_t asked = all & (trial % 4 < 2 ? all : ((std::uint64_t{ generator() } << 32) | generator()));
      std::uint64_t       expected = 0;
      for (std::size_t i = 0; i < cells; ++i)
      {
        for (unsigned int k = 0; k < 4; ++k)
        {
          if (!cell.IsTrivial(rows.DifferenceOf(i, k), 2.0))
          {
            expected |= asked & (std::uint64_t{ 1 } << i);
          }
        }
      }
      ASSERT_EQ(itk::MedialVoxelNontrivialCells(rows.Pointers(), asked, static_cast<std::int64_t>(cells)), expected);
      spreadCells += expected != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(spreadCells, 100u);
}

TEST(MedialVoxelPairChoice, OneNontrivialDiagonalAndAxisIsSeen)
{
  const itk::MedialVoxelDualCell cell(UnitGrid);
  std::mt19937                   generator(22);
  // All corners share one boundary point but one corner, which is moved by at most two voxels.
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (int moved = -2; moved <= 2; ++moved)
      {
        Rows rows(1, 0, generator);
        for (unsigned int k = 0; k < 8; ++k)
        {
          for (unsigned int i = 0; i < 3; ++i)
          {
            rows.values[i][k >> 1][k & 1u] = 1 - static_cast<int>((k >> i) & 1u);
          }
        }
        rows.values[axis][corner >> 1][corner & 1u] += moved;
        EXPECT_EQ(itk::MedialVoxelNontrivialCells(rows.Pointers(), 1, 1), std::abs(moved) > 1 ? 1u : 0u);
      }
    }
  }
}

TEST(MedialVoxelPairChoice, CornersWithoutAPointAreNeverNear)
{
  std::mt19937 generator(23);
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    Rows rows(1, 1, generator);
    for (auto & component : rows.values)
    {
      component[corner >> 1][corner & 1u] = itk::MedialVoxelNoDisplacement;
    }
    EXPECT_EQ(itk::MedialVoxelNontrivialCells(rows.Pointers(), 1, 1), 1u);
    EXPECT_EQ(WidestOf(rows), -1);
  }
}

TEST(MedialVoxelPairChoice, TheWidestDiagonalHasTheSmallestKey)
{
  const itk::MedialVoxelDualCell cell(UnitGrid);
  const auto                     smallestKeyOf = [&cell](const Rows & rows, const std::size_t i) {
    int          number = 0;
    double       smallest = 2.0;
    std::int64_t longest = -1;
    for (unsigned int k = 0; k < 4; ++k)
    {
      const double key = cell.CosineKey(k, rows.Of(i, k), rows.Of(i, 7 - k));
      if (key < smallest)
      {
        smallest = key;
        number = static_cast<int>(k);
      }
    }
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      for (const std::int64_t steps : rows.Of(i, corner))
      {
        longest = std::max(longest, steps >= 0 ? steps : -1 - steps);
      }
    }
    return longest < 16 ? number : -1;
  };
  std::mt19937 generator(24);
  for (const int reach : { 1, 2, 4, 15, 16, 17, 40 })
  {
    int chosen = 0;
    for (int trial = 0; trial < 1000; ++trial)
    {
      const std::size_t           cells = 1 + generator() % 64;
      const Rows                  rows(cells, reach, generator);
      const std::uint64_t         asked = (std::uint64_t{ generator() } << 32) | generator();
      std::array<std::int8_t, 64> widest;
      widest.fill(77);
      itk::MedialVoxelWidestDiagonals(rows.Pointers(), asked, static_cast<std::int64_t>(cells), widest.data());
      for (std::size_t i = 0; i < 64; ++i)
      {
        const bool isAsked = i < cells && (asked >> i & 1u) != 0;
        ASSERT_EQ(widest[i], isAsked ? smallestKeyOf(rows, i) : i < cells ? widest[i] : 77) << "reach " << reach;
        chosen += isAsked && widest[i] >= 0 ? 1 : 0;
      }
    }
    EXPECT_GT(chosen, reach > 17 ? -1 : 0);
  }
}
