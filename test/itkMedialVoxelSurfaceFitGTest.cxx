// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSurfaceFit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace
{
using Point = itk::MedialVoxelSurfaceFit::PointType;

constexpr Point Far{ { 100.0, 100.0, 100.0 } };

double
Dot(const Point & a, const Point & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Squared distances of a point to the mid-planes of the pairs, and to the center. */
double
Cost(const std::vector<std::array<Point, 2>> & pairs, double pull, const Point & x)
{
  double cost = pull * Dot(x, x);
  for (const auto & pair : pairs)
  {
    Point  across;
    Point  toMiddle;
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      across[axis] = pair[1][axis] - pair[0][axis];
      toMiddle[axis] = x[axis] - 0.5 * (pair[0][axis] + pair[1][axis]);
      squared += across[axis] * across[axis];
    }
    cost += Dot(across, toMiddle) * Dot(across, toMiddle) / squared;
  }
  return cost;
}
} // namespace

TEST(MedialVoxelSurfaceFit, ThreePlanesMeetInAPoint)
{
  itk::MedialVoxelSurfaceFit fit;
  fit.AddPair({ { -2.0, 0.0, 0.0 } }, { { 3.0, 0.0, 0.0 } });
  fit.AddPair({ { 0.0, 1.0, 5.0 } }, { { 0.0, -2.0, 5.0 } });
  fit.AddPair({ { 7.0, 3.0, -1.0 } }, { { 7.0, 3.0, 0.5 } });
  const Point point = fit.GetPoint(1e-9, Far);
  EXPECT_NEAR(point[0], 0.5, 1e-6);
  EXPECT_NEAR(point[1], -0.5, 1e-6);
  EXPECT_NEAR(point[2], -0.25, 1e-6);
}

TEST(MedialVoxelSurfaceFit, TangentsOfAWedgeMeetInThePlaneBetweenThem)
{
  // Walls that open by 60 degrees, touched at unlike distances from where they meet.
  const double               s = std::sqrt(0.75);
  itk::MedialVoxelSurfaceFit fit;
  fit.AddTangents({ { { 4.0 * s, 2.0, 1.0 } }, { { 0.5, -s, 0.0 } } },
                  { { { 2.0 * s, -1.0, 7.0 } }, { { 0.5, s, 0.0 } } });
  const auto plane = fit.GetPlane();
  EXPECT_NEAR(std::abs(plane.normal[1]), 1.0, 1e-12);
  EXPECT_NEAR(plane.distance, 0.0, 1e-12);
  // Walls that are parallel have it in their middle.
  itk::MedialVoxelSurfaceFit parallel;
  parallel.AddTangents({ { { 9.0, -1.0, 0.0 } }, { { 0.0, 1.0, 0.0 } } },
                       { { { 3.0, 2.5, 0.0 } }, { { 0.0, -1.0, 0.0 } } });
  EXPECT_EQ(parallel.GetPlane().distance, 0.75);
  EXPECT_EQ(parallel.GetPoint(1e-9, Far)[0], 0.0);
}

TEST(MedialVoxelSurfaceFit, OnePlanePullsAlongItsNormalAlone)
{
  itk::MedialVoxelSurfaceFit fit;
  fit.AddPair({ { 4.0, -1.0, 9.0 } }, { { 4.0, 3.0, 9.0 } });
  EXPECT_EQ(fit.GetPoint(0.25, Far), (Point{ { 0.0, 0.8, 0.0 } }));
  EXPECT_EQ(fit.GetPoint(0.25, { { 1.0, 0.5, 1.0 } }), (Point{ { 0.0, 0.5, 0.0 } })) << "the reach is not kept";
  const auto plane = fit.GetPlane();
  EXPECT_EQ(plane.normal, (Point{ { 0.0, 1.0, 0.0 } }));
  EXPECT_EQ(plane.distance, 1.0);
}

TEST(MedialVoxelSurfaceFit, TheOrderOfASidesDoesNotCancelThePlane)
{
  itk::MedialVoxelSurfaceFit fit;
  fit.AddPair({ { 0.0, 0.0, -2.0 } }, { { 0.0, 0.0, 2.5 } });
  fit.AddPair({ { 1.0, 0.0, 2.5 } }, { { 1.0, 0.0, -2.0 } });
  const auto plane = fit.GetPlane();
  EXPECT_EQ(std::abs(plane.normal[2]), 1.0);
  EXPECT_EQ(plane.distance * plane.normal[2], 0.25);
}

TEST(MedialVoxelSurfaceFit, NoPointIsBetter)
{
  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> coordinate(-3.0, 3.0);
  const auto random = [&] { return Point{ { coordinate(generator), coordinate(generator), coordinate(generator) } }; };
  for (int trial = 0; trial < 50; ++trial)
  {
    std::vector<std::array<Point, 2>> pairs(1 + trial % 12);
    itk::MedialVoxelSurfaceFit        fit;
    for (auto & pair : pairs)
    {
      pair = { { random(), random() } };
      fit.AddPair(pair[0], pair[1]);
    }
    const Point  best = fit.GetPoint(0.1, Far);
    const double cost = Cost(pairs, 0.1, best);
    for (int other = 0; other < 20; ++other)
    {
      const Point step = random();
      EXPECT_LE(cost,
                Cost(pairs, 0.1, { { best[0] + step[0] / 9, best[1] + step[1] / 9, best[2] + step[2] / 9 } }) + 1e-12);
    }
  }
}
