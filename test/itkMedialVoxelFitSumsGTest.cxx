// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Sums of fits against their definition, and fits against the least sum of squares.

#include "itkMedialVoxelFitSums.h"
#include "itkMedialVoxelWallFit.h"

#include "gtest/gtest.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace
{
double
Cumulative(const double x)
{
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

/** Values of a blurred wall at a place. */
double
WallAt(const double s, const double center, const double thickness, const double blur)
{
  return Cumulative((s - center + 0.5 * thickness) / blur) - Cumulative((s - center - 0.5 * thickness) / blur);
}
} // namespace

TEST(MedialVoxelFitSums, AreThoseOfTheirDefinition)
{
  std::mt19937_64                    random(3);
  std::uniform_real_distribution<>   uniform(-1.0, 1.0);
  itk::MedialVoxelGrayLocal::Samples samples;
  std::vector<std::array<double, 3>> list;
  for (int i = 0; i < 203; ++i)
  {
    list.push_back({ { 8.0 * uniform(random), 0.5 + 0.5 * uniform(random), uniform(random) } });
    samples.Add(list.back()[0], list.back()[1], list.back()[2]);
  }
  constexpr double center = 0.3;
  constexpr double thickness = 2.7;
  constexpr double blur = 0.8;
  constexpr double reach = 5.0;
  const auto       model = [](const double s, const double c, const double t) { return WallAt(s, c, t, blur); };
  double           tt = 0.0, rc = 0.0, cost[3] = {}, rest = 0.0, weights = 0.0;
  for (const auto & [along, weight, value] : list)
  {
    if (std::abs(along) <= reach)
    {
      constexpr double step = 1e-4;
      const double     r = value - model(along, center, thickness);
      const double t = (model(along, center, thickness + step) - model(along, center, thickness - step)) / (2 * step);
      const double c = (model(along, center + step, thickness) - model(along, center - step, thickness)) / (2 * step);
      tt += weight * t * t;
      rc += weight * r * c;
      for (int i = 0; i < 3; ++i)
      {
        const double moved = value - model(along, center, thickness + 0.01 * (i - 1));
        cost[i] += 0.5 * weight * moved * moved;
      }
      if (std::abs(along - center) <= 0.7)
      {
        rest += weight * r;
        weights += weight;
      }
    }
  }
  const itk::MedialVoxelFitSums sums(samples, 0.0, reach);
  const auto                    wall = sums.SumWall(center, thickness, blur);
  EXPECT_NEAR(wall.tt, tt, 1e-5 * tt);
  EXPECT_NEAR(wall.rc, rc, 1e-4 * std::abs(rc));
  // Of the sum of squares: the second derivative, by differences.
  EXPECT_NEAR(wall.tt - wall.bendTT, (cost[0] - 2 * cost[1] + cost[2]) / 1e-4, 0.01 * wall.tt);
  const auto misfit = sums.SumMisfit(center, thickness, blur, 0.7);
  EXPECT_NEAR(misfit.rest, rest, 1e-4);
  EXPECT_NEAR(misfit.weight, weights, 1e-5 * weights);
}

TEST(MedialVoxelFitSums, LeadBrightWallsToTheLeastSumOfSquares)
{
  // Steps without second derivatives would go to and fro here, and farther each time.
  constexpr double blur = 0.9;
  for (const double bright : { 1.2, 1.5, 1.8 })
  {
    for (const double place : { -0.4, 0.0, 0.3 })
    {
      itk::MedialVoxelGrayLocal::Samples samples;
      const auto                         valueAt = [&](const double s) { return bright * WallAt(s, place, 3.0, 1.3); };
      for (int i = -80; i <= 80; ++i)
      {
        samples.Add(0.1 * i, 1.0, valueAt(0.1 * i));
      }
      const auto measured =
        itk::MedialVoxelWallFit(itk::MedialVoxelScan{ 0.0, 1.0, blur, 0.05, 1.0 }, 3).FitWall(samples);
      ASSERT_TRUE(measured) << bright << ", " << place;
      const auto squares = [&](const double thickness, const double center) {
        double sum = 0.0;
        for (int i = -80; i <= 80; ++i)
        {
          const double rest = valueAt(0.1 * i) - WallAt(0.1 * i, center, thickness, blur);
          sum += rest * rest;
        }
        return sum;
      };
      const double least = squares(measured->thickness, measured->center);
      for (const double step : { -0.1, 0.1 })
      {
        EXPECT_LT(least, squares(measured->thickness + step, measured->center)) << bright << ", " << place;
        EXPECT_LT(least, squares(measured->thickness, measured->center + step)) << bright << ", " << place;
      }
    }
  }
}
