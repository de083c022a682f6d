// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelColumnPass.h"
#include "itkMedialVoxelSquaredLengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
constexpr std::int64_t Columns = itk::MedialVoxelColumnPass::Columns;
constexpr std::int32_t None = itk::MedialVoxelSquaredLengths::None;

/** Costs as passes before leave them, none in some columns; one voxel in `gap` has one. */
std::vector<std::int32_t>
RandomCosts(std::int64_t length, unsigned int gap, std::int32_t largest, std::mt19937 & random)
{
  std::vector<std::int32_t> costs;
  const unsigned int        emptyColumns = random();
  for (std::int64_t i = 0; i < length * Columns; ++i)
  {
    const bool isEmpty = ((emptyColumns >> (i % Columns)) & 3u) == 0;
    const auto cost = static_cast<std::int32_t>(random() % (static_cast<unsigned int>(largest) + 1));
    costs.push_back(isEmpty || random() % gap != 0 ? None : cost);
  }
  return costs;
}

std::int32_t
SmallestSum(const std::vector<std::int32_t> & costs, std::int64_t row, std::int64_t column)
{
  std::int32_t smallest = None;
  for (std::int64_t j = 0; j < static_cast<std::int64_t>(costs.size()) / Columns; ++j)
  {
    const auto square = static_cast<std::int32_t>((row - j) * (row - j));
    smallest = std::min(smallest, costs[static_cast<std::size_t>(j * Columns + column)] + square);
  }
  return smallest;
}

void
ExpectSmallestSums(const std::vector<std::int32_t> & costs,
                   std::int64_t                      first,
                   std::int64_t                      number,
                   itk::MedialVoxelColumnPass &      pass)
{
  const std::int64_t        length = static_cast<std::int64_t>(costs.size()) / Columns;
  std::vector<std::int32_t> result(
    static_cast<std::size_t>(itk::MedialVoxelColumnPass::GetResultRows(number) * Columns));
  pass.Search(costs.data(), length, first, number, result.data());
  std::size_t differences = 0;
  for (std::int64_t i = 0; i < number * Columns; ++i)
  {
    const std::int32_t expected = SmallestSum(costs, first + i / Columns, i % Columns);
    differences += result[static_cast<std::size_t>(i)] != expected ? 1 : 0;
  }
  EXPECT_EQ(differences, 0u) << length << " rows, " << number << " from " << first;
}
} // namespace

TEST(MedialVoxelColumnPass, FindsWhatBruteForceFinds)
{
  std::mt19937               random(11);
  itk::MedialVoxelColumnPass pass; // one for all: nothing of a search may leak into the next
  for (int trial = 0; trial < 400; ++trial)
  {
    const std::int64_t length = 1 + random() % 120;
    const std::int64_t first = random() % length;
    const std::int64_t number = 1 + random() % (length - first);
    const std::int32_t largest = trial % 3 == 0 ? 3 : (trial % 3 == 1 ? 400 : 30000);
    ExpectSmallestSums(RandomCosts(length, 1 + random() % 40, largest, random), first, number, pass);
  }
}

TEST(MedialVoxelColumnPass, HoldsTheLargestSizes)
{
  constexpr std::int64_t     length = itk::MedialVoxelSquaredLengths::LargestSize;
  constexpr std::int32_t     largest = 2 * (length - 1) * (length - 1);
  std::vector<std::int32_t>  costs(static_cast<std::size_t>(length * Columns), None);
  itk::MedialVoxelColumnPass pass;
  costs[5] = largest;
  costs[6] = 0;
  std::vector<std::int32_t> result(static_cast<std::size_t>(length * Columns));
  pass.Search(costs.data(), length, 0, length, result.data());
  const auto last = static_cast<std::size_t>((length - 1) * Columns);
  EXPECT_EQ(result[last + 4], None);
  EXPECT_EQ(result[last + 5], largest + (length - 1) * (length - 1));
  EXPECT_EQ(result[last + 6], (length - 1) * (length - 1));
  EXPECT_LT(result[last + 5], None);
}
