// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelLengthRow.h"
#include "itkMedialVoxelSquaredLengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using itk::MedialVoxelLengthRow;

namespace
{
constexpr std::int32_t None = itk::MedialVoxelSquaredLengths::None;

/** A spacing with which a length of three voxels lies in the middle between two floats. */
constexpr double DoubtfulSpacing = (1.0 + 1.0 / (1 << 24)) / 3.0;
} // namespace

TEST(MedialVoxelLengthRow, WritesRoundedRoots)
{
  std::mt19937 random(21);
  for (int trial = 0; trial < 3000; ++trial)
  {
    const double        spacing = std::vector<double>{ 1.0, 0.25, 0.75, 0.1, 1e-12, 1024.0 }[random() % 6];
    const bool          isSquared = random() % 4 == 0;
    const auto          number = static_cast<std::int64_t>(random() % 65);
    const std::uint64_t negatives = (std::uint64_t{ random() } << 32) | random();
    const unsigned int  most = random() % 5 == 0 ? None : (random() % 2 == 0 ? 20u : 5000000u);

    std::vector<std::int32_t> squares;
    for (std::int64_t i = 0; i < number; ++i)
    {
      squares.push_back(random() % 50 == 0 ? None + static_cast<int>(random() % 9)
                                           : static_cast<std::int32_t>(random() % most));
    }
    std::vector<float> target(static_cast<std::size_t>(number) + 1, 7.0f);
    MedialVoxelLengthRow(spacing, isSquared).Write(squares.data(), number, negatives, target.data());
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
      const double square = squares[i] * (spacing * spacing);
      const auto   length = static_cast<float>(isSquared ? square : std::sqrt(square));
      const float  expected = (negatives >> i & 1u) != 0 ? 0.0f - length : length;
      EXPECT_TRUE(squares[i] < None ? target[i] == expected && std::signbit(target[i]) == std::signbit(expected)
                                    : std::isnan(target[i]));
    }
    EXPECT_EQ(target.back(), 7.0f);
  }
}

TEST(MedialVoxelLengthRow, KnowsWhichSpacingsAreExact)
{
  for (const double spacing : { 1.0, 0.5, 0.75, 2047.0, 2047.0 / 1024.0 })
  {
    EXPECT_TRUE(MedialVoxelLengthRow::HasExactLengths(spacing)) << spacing;
  }
  for (const double spacing : { 0.1, 2049.0, 1.0 / 3.0, DoubtfulSpacing })
  {
    EXPECT_FALSE(MedialVoxelLengthRow::HasExactLengths(spacing)) << spacing;
  }
}

TEST(MedialVoxelLengthRow, FindsTheDoubtfulLengths)
{
  std::vector<std::int32_t> squares;
  MedialVoxelLengthRow::AppendDoubtful(DoubtfulSpacing, 0, 9, squares);
  EXPECT_TRUE(squares.empty());
  MedialVoxelLengthRow::AppendDoubtful(DoubtfulSpacing, 9, 10, squares);
  EXPECT_EQ(squares, std::vector<std::int32_t>{ 9 });
}
