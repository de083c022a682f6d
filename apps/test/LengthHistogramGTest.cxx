// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "LengthHistogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using medialvoxel::LengthHistogram;

TEST(MedialVoxelLengthHistogram, OfNothingIsZero)
{
  const LengthHistogram histogram(0.25);
  EXPECT_EQ(histogram.GetTotal(), 0u);
  EXPECT_EQ(histogram.GetMean(), 0.0);
  EXPECT_EQ(histogram.GetStandardDeviation(), 0.0);
  EXPECT_EQ(histogram.GetPercentile(50), 0.0);
}

TEST(MedialVoxelLengthHistogram, TellsWhatItWasGiven)
{
  LengthHistogram histogram(0.5);
  for (const double length : { 1.0, 3.0, 1.2, 2.8 })
  {
    histogram.Add(histogram.GetBin(length));
  }
  EXPECT_EQ(histogram.GetNumbers(), (std::vector<std::uint64_t>{ 0, 0, 2, 0, 0, 0, 2 }));
  EXPECT_EQ(histogram.GetTotal(), 4u);
  EXPECT_EQ(histogram.GetMean(), 2.0);
  EXPECT_EQ(histogram.GetStandardDeviation(), 1.0);
}

TEST(MedialVoxelLengthHistogram, PercentilesAreLengthsThatWereGiven)
{
  LengthHistogram histogram(1.0);
  for (int length = 1; length <= 10; ++length)
  {
    histogram.Add(histogram.GetBin(length));
  }
  EXPECT_EQ(histogram.GetPercentile(0), 1.0);
  EXPECT_EQ(histogram.GetPercentile(10), 1.0);
  EXPECT_EQ(histogram.GetPercentile(10.1), 2.0);
  EXPECT_EQ(histogram.GetPercentile(50), 5.0);
  EXPECT_EQ(histogram.GetPercentile(95), 10.0);
  EXPECT_EQ(histogram.GetPercentile(100), 10.0);
  EXPECT_THROW(histogram.GetPercentile(-1), std::invalid_argument);
  EXPECT_THROW(histogram.GetPercentile(101), std::invalid_argument);
}

TEST(MedialVoxelLengthHistogram, AnyOrderAndAnyPartsGiveTheSameBits)
{
  std::mt19937        generator(5);
  LengthHistogram     whole(0.1);
  LengthHistogram     backwards(0.1);
  LengthHistogram     parts(0.1);
  std::vector<double> lengths;
  for (int i = 0; i < 1000; ++i)
  {
    lengths.push_back(static_cast<double>(generator() % 100000) / 7919.0);
  }
  for (const double length : lengths)
  {
    whole.Add(whole.GetBin(length));
  }
  for (auto length = lengths.rbegin(); length != lengths.rend(); ++length)
  {
    backwards.Add(backwards.GetBin(*length));
  }
  for (std::size_t begin = 0; begin < lengths.size(); begin += 250)
  {
    LengthHistogram part(0.1);
    for (std::size_t i = begin; i < begin + 250; ++i)
    {
      part.Add(part.GetBin(lengths[i]));
    }
    parts.Add(part);
  }
  for (const LengthHistogram * other : { &backwards, &parts })
  {
    EXPECT_EQ(whole.GetNumbers(), other->GetNumbers());
    EXPECT_EQ(whole.GetTotal(), other->GetTotal());
    EXPECT_EQ(whole.GetMean(), other->GetMean());
    EXPECT_EQ(whole.GetStandardDeviation(), other->GetStandardDeviation());
  }
  double sum = 0.0;
  for (const double length : lengths)
  {
    sum += length;
  }
  EXPECT_NEAR(whole.GetMean(), sum / 1000.0, 0.005);
}

TEST(MedialVoxelLengthHistogram, ClearForgets)
{
  LengthHistogram histogram(1.0);
  histogram.Add(3, 7);
  histogram.Add(9, 0);
  EXPECT_EQ(histogram.GetNumbers().size(), 4u);
  histogram.Clear();
  EXPECT_EQ(histogram.GetTotal(), 0u);
  EXPECT_TRUE(histogram.GetNumbers().empty());
}

TEST(MedialVoxelLengthHistogram, WidthsThatAreNoneAreRefused)
{
  for (const double width : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    EXPECT_THROW(LengthHistogram{ width }, std::invalid_argument);
  }
}
