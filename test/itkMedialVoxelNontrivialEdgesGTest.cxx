// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelNontrivialEdges.h"

#include "itkMedialVoxelFeatures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

namespace
{

using Components = std::array<std::vector<std::int32_t>, 3>;

itk::MedialVoxelDisplacementRows
RowsAt(const Components & components, std::size_t first)
{
  return { { components[0].data() + first, components[1].data() + first, components[2].data() + first } };
}

/** Displacements of a row, some of them far, some undefined. */
Components
RandomRow(std::mt19937 & random, std::size_t length)
{
  std::uniform_int_distribution<int> near(-2, 2);
  std::uniform_int_distribution<int> kind(0, 9);
  Components                         row;
  for (std::size_t i = 0; i < length; ++i)
  {
    const int which = kind(random);
    for (auto & component : row)
    {
      component.push_back(which == 0   ? itk::MedialVoxelNoDisplacement
                          : which == 1 ? 100000 * near(random)
                                       : near(random));
    }
  }
  return row;
}

bool
IsUndefined(const Components & row, std::size_t i)
{
  return row[0][i] == itk::MedialVoxelNoDisplacement;
}

bool
IsNontrivial(const Components & lower, const Components & upper, unsigned int axis, std::size_t i, std::size_t j)
{
  bool result = false;
  for (unsigned int component = 0; component < 3; ++component)
  {
    const std::int64_t difference =
      std::int64_t{ lower[component][i] } - upper[component][j] - (component == axis ? 1 : 0);
    result = result || std::abs(difference) > 1;
  }
  return result;
}

} // namespace

TEST(MedialVoxelNontrivialEdges, AgreesWithTheDifferences)
{
  std::mt19937                                 random(811);
  std::uniform_int_distribution<std::uint64_t> bits;
  std::uniform_int_distribution<int>           lengths(1, 64);
  unsigned int                                 nontrivial = 0;
  for (int round = 0; round < 600; ++round)
  {
    const auto         number = static_cast<std::size_t>(lengths(random));
    const unsigned int axis = static_cast<unsigned int>(round) % 3;
    // The upper voxels of edges along x are those of the same row.
    const Components    lower = RandomRow(random, number + (axis == 0 ? 1 : 0));
    const Components    upper = axis == 0 ? lower : RandomRow(random, number);
    const std::size_t   toUpper = axis == 0 ? 1 : 0;
    const std::uint64_t inRow = number == 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << number) - 1;
    const std::uint64_t edges = (round % 4 == 0 ? ~std::uint64_t{ 0 } : bits(random) & bits(random)) & inRow;
    const std::uint64_t result = itk::MedialVoxelNontrivialEdges(
      RowsAt(lower, 0), RowsAt(upper, toUpper), axis, edges, static_cast<std::int64_t>(number));
    EXPECT_EQ(result & ~edges, 0u);
    for (std::size_t i = 0; i < number; ++i)
    {
      const std::size_t j = i + toUpper;
      if ((edges >> i & 1) == 0 || IsUndefined(lower, i) != IsUndefined(upper, j))
      {
        continue;
      }
      const bool expected = !IsUndefined(lower, i) && IsNontrivial(lower, upper, axis, i, j);
      EXPECT_EQ((result >> i & 1) != 0, expected) << round << ' ' << i;
      nontrivial += expected ? 1 : 0;
    }
  }
  EXPECT_GT(nontrivial, 1000u);
}
