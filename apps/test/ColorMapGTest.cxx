// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ColorMap.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace medialvoxel;

namespace
{

/** Lightness of CIELAB, from 0 to 100. */
double
LightnessOf(const Color & color)
{
  constexpr double weights[3] = { 0.2126, 0.7152, 0.0722 };
  double           luminance = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double value = color[i] / 255.0;
    luminance += weights[i] * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  return 116.0 * std::cbrt(luminance) - 16.0;
}

} // namespace

TEST(ColorMap, EqualStepsAreStepsOfEqualLightness)
{
  const double darkest = LightnessOf(GetMapColor(0.0));
  const double lightest = LightnessOf(GetMapColor(1.0));
  EXPECT_LT(darkest, 35.0);
  EXPECT_GT(lightest, 85.0);
  for (double share = 0.0; share <= 1.0; share += 1.0 / 64)
  {
    EXPECT_NEAR(LightnessOf(GetMapColor(share)), darkest + share * (lightest - darkest), 1.0) << share;
  }
}

TEST(ColorMap, NeighborsAreAlikeAndFarOnesAreNot)
{
  const auto distance = [](const Color & a, const Color & b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
  };
  for (double share = 0.0; share < 1.0; share += 1.0 / 64)
  {
    EXPECT_LT(distance(GetMapColor(share), GetMapColor(share + 1.0 / 64)), 40) << share;
  }
  EXPECT_GT(distance(GetMapColor(0.0), GetMapColor(0.5)), 100);
  EXPECT_GT(distance(GetMapColor(0.5), GetMapColor(1.0)), 100);
}

TEST(ColorMap, SharesOutsideAreThoseOfTheEnds)
{
  EXPECT_EQ(GetMapColor(-3.0), GetMapColor(0.0));
  EXPECT_EQ(GetMapColor(7.0), GetMapColor(1.0));
}
