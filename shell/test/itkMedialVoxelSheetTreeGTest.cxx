// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSheetTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace
{

using Tree = itk::MedialVoxelSheetTree;
using Index = Tree::Index;
using Point = Tree::Point;

double
Distance(const Point & a, const Point & b)
{
  return itk::MedialVoxelNorm(itk::MedialVoxelSubtract(a, b));
}

TEST(MedialVoxelSheetTree, FindsTheNearestOfAGroupAsATryOfAllDoes)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> coordinate(0.0, 10.0);
  const auto somewhere = [&] { return Point{ { coordinate(random), coordinate(random), coordinate(random) } }; };
  std::vector<Point>          points;
  std::vector<Tree::Triangle> triangles;
  std::vector<Index>          groups;
  for (Index number = 0; number < 300; ++number)
  {
    points.insert(points.end(), { somewhere(), somewhere(), somewhere() });
    triangles.push_back({ { 3 * number, 3 * number + 1, 3 * number + 2 } });
    groups.push_back(number % 3);
  }
  const Tree tree(points, triangles, groups);
  for (unsigned int trial = 0; trial < 500; ++trial)
  {
    const Point point = somewhere();
    const Index group = trial % 3;
    double      distance = Tree::Anywhere;
    for (Index number = group; number < triangles.size(); number += 3)
    {
      const Point & a = points[3 * number];
      distance = std::min(
        distance,
        Distance(point,
                 itk::MedialVoxelNearestOfTriangle(point, { { a, points[3 * number + 1], points[3 * number + 2] } })));
    }
    EXPECT_NEAR(tree.Find(point, group).distance, distance, 1e-12);
    EXPECT_FALSE(tree.HasWithin(point, group, 0.999 * distance));
    EXPECT_TRUE(tree.HasWithin(point, group, 1.001 * distance));
  }
}

// Orders that libraries of C++ leave in a tree must not show.
TEST(MedialVoxelSheetTree, TakesTheFirstOfEqualDistances)
{
  // A fan around the first point.
  constexpr Index    number = 100;
  std::vector<Point> points{ Point{} };
  for (Index corner = 0; corner < number; ++corner)
  {
    const double angle = 0.1 + 6.28 / number * corner;
    points.push_back({ { 3.0 * std::cos(angle), std::sin(angle), 0.0 } });
  }
  std::vector<Index> places(number);
  std::iota(places.begin(), places.end(), Index{ 0 });
  std::mt19937 random(11);
  for (unsigned int trial = 0; trial < 20; ++trial)
  {
    std::shuffle(places.begin(), places.end(), random);
    std::vector<Tree::Triangle> triangles;
    for (const Index place : places)
    {
      triangles.push_back({ { 0, 1 + place, 1 + (place + 1) % number } });
    }
    const Tree tree(points, triangles, std::vector<Index>(number, 0));
    EXPECT_EQ(tree.Find({ { 0.0, 0.0, 1.0 } }, 0).triangle, 0u) << trial;
  }
}

} // namespace
