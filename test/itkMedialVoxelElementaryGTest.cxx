// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelElementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{
using namespace itk::MedialVoxelElementary;

/** The bounds that the header promises, and half of an ulp that the library may be off itself. */
void
ExpectWithin(double found, double expected, double ulps)
{
  const double unit = std::nextafter(std::abs(expected), std::numeric_limits<double>::infinity()) - std::abs(expected);
  ASSERT_LE(std::abs(found - expected), (ulps + 0.5) * unit) << found << " instead of " << expected;
}
} // namespace

TEST(MedialVoxelElementary, FunctionsAreThoseOfTheLibrary)
{
  std::mt19937                     generator(3);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  for (int i = 0; i < 200000; ++i)
  {
    const double x = uniform(generator);
    const double near = 1.0 - std::ldexp(std::abs(x), -i % 50);
    const double wide = std::ldexp(1.0 + std::abs(x), i % 2000 - 1000);
    ExpectWithin(ArcCosine(x), std::acos(x), 4.0);
    ExpectWithin(ArcCosine(near), std::acos(near), 4.0);
    ExpectWithin(ArcCosine(-near), std::acos(-near), 4.0);
    ExpectWithin(Logarithm(wide), std::log(wide), 4.0);
    ExpectWithin(Logarithm(near), std::log(near), 4.0);
    ExpectWithin(Exponential(0.25 * x), std::exp(0.25 * x), 8.0);
    ExpectWithin(Exponential(30.0 * x), std::exp(30.0 * x), 32.0 * 30.0);
    ASSERT_NEAR(Sine(10.0 * x), std::sin(10.0 * x), 2e-15);
    ASSERT_NEAR(Cosine(10.0 * x), std::cos(10.0 * x), 2e-15);
    ExpectWithin(Power(0.01 + std::abs(x), 2.4), std::pow(0.01 + std::abs(x), 2.4), 32.0 * 11.0);
  }
}

TEST(MedialVoxelElementary, EndsAreExact)
{
  EXPECT_EQ(ArcCosine(1.0), 0.0);
  EXPECT_EQ(ArcCosine(std::nextafter(1.0, 2.0)), 0.0);
  EXPECT_EQ(ArcCosine(0.0), 0.5 * ArcCosine(-1.0));
  EXPECT_EQ(ArcCosine(-1.0), 3.14159265358979323846);
  EXPECT_EQ(ArcCosine(-2.0), ArcCosine(-1.0));
  EXPECT_EQ(Exponential(0.0), 1.0);
  EXPECT_EQ(Exponential(-1e9), 0.0);
  EXPECT_EQ(Exponential(1e9), std::numeric_limits<double>::infinity());
  EXPECT_EQ(Exponential(-std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_EQ(Logarithm(1.0), 0.0);
  EXPECT_EQ(Power(1.0, 1.0 / 3.0), 1.0);
  EXPECT_EQ(Sine(0.0), 0.0);
}
