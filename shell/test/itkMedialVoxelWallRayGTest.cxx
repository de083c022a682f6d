// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallRay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>

namespace
{

using Index = itk::MedialVoxelIndex;
using Point = itk::MedialVoxelWallRay::Point;
using End = itk::MedialVoxelRayEnd;
using Spacing = itk::MedialVoxelGrid::SpacingType;

constexpr std::int64_t Size = 44;

/** Margins of a part around the middle of the image, from the distance into it at a physical place. */
itk::MedialVoxelMargins
Sample(const Spacing & spacing, const std::function<double(const Point &)> & distance)
{
  itk::MedialVoxelMargins margins({ Size, Size, Size }, Size);
  for (std::int64_t z = 0; z < Size; ++z)
  {
    for (std::int64_t y = 0; y < Size; ++y)
    {
      for (std::int64_t x = 0; x < Size; ++x)
      {
        margins.GetRow(y, z)[x] =
          static_cast<float>(distance({ (x - 21.6) * spacing[0], (y - 22.1) * spacing[1], (z - 21.9) * spacing[2] }));
      }
    }
  }
  return margins;
}

/** The index of a place. */
Point
IndexOf(const Spacing & spacing, const Point & place)
{
  return { 21.6 + place[0] / spacing[0], 22.1 + place[1] / spacing[1], 21.9 + place[2] / spacing[2] };
}

double
Norm(const Point & p)
{
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

Point
DrawDirection(std::mt19937 & draw)
{
  std::normal_distribution<double> normal;
  Point                            point{ normal(draw), normal(draw), normal(draw) };
  const double                     norm = Norm(point);
  std::transform(point.begin(), point.end(), point.begin(), [norm](double c) { return c / norm; });
  return point;
}

Point
Scale(const Point & point, double factor)
{
  return { point[0] * factor, point[1] * factor, point[2] * factor };
}

double
Dot(const Point & a, const Point & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

const Spacing Equal{ 1.0, 1.0, 1.0 };
const Spacing Unequal{ 0.7, 0.7, 1.2 };

TEST(MedialVoxelWallRay, MeasuresPlatesInAllDirections)
{
  std::mt19937 draw(11);
  for (const Spacing & spacing : { Equal, Unequal })
  {
    for (unsigned int i = 0; i < 30; ++i)
    {
      const Point  normal = DrawDirection(draw);
      const double width = 2.0 + 0.1 * i;
      const auto   margins = Sample(spacing, [&](const Point & p) { return width / 2 - std::abs(Dot(p, normal)); });
      const itk::MedialVoxelWallRay ray(margins, spacing, 10.0);
      const auto                    length = ray.Measure(IndexOf(spacing, Scale(normal, width / 2)));
      ASSERT_EQ(length.end, End::Surface);
      EXPECT_NEAR(length.length, width, 0.02);
      const itk::MedialVoxelWallRay shorter(margins, spacing, 0.9 * width);
      EXPECT_EQ(shorter.Measure(IndexOf(spacing, Scale(normal, width / 2))).end, End::Maximum);
    }
  }
}

TEST(MedialVoxelWallRay, MeasuresSpheresAndTubes)
{
  std::mt19937 draw(12);
  const Point  axis = DrawDirection(draw);
  for (const Spacing & spacing : { Equal, Unequal })
  {
    const auto                    ball = Sample(spacing, [](const Point & p) { return 9.3 - Norm(p); });
    const auto                    tube = Sample(spacing, [&axis](const Point & p) {
      const double along = Dot(p, axis);
      return 2.1 - std::abs(std::sqrt(std::max(0.0, Dot(p, p) - along * along)) - 8.4);
    });
    const itk::MedialVoxelWallRay inBall(ball, spacing, 25.0);
    const itk::MedialVoxelWallRay inTube(tube, spacing, 25.0);
    for (unsigned int i = 0; i < 50; ++i)
    {
      const Point direction = DrawDirection(draw);
      const auto  diameter = inBall.Measure(IndexOf(spacing, Scale(direction, 9.3)));
      ASSERT_EQ(diameter.end, End::Surface);
      EXPECT_NEAR(diameter.length, 18.6, 0.1);
      Point        across{};
      const double along = Dot(direction, axis);
      for (unsigned int k = 0; k < 3; ++k)
      {
        across[k] = direction[k] - along * axis[k];
      }
      for (const double radius : { 6.3, 10.5 })
      {
        const auto wall = inTube.Measure(IndexOf(spacing, Scale(across, radius / Norm(across))));
        ASSERT_EQ(wall.end, End::Surface);
        EXPECT_NEAR(wall.length, 4.2, 0.1) << radius;
      }
    }
  }
}

/** The definition without shortcuts: a gradient of all voxels nearby, and many more steps. */
std::optional<double>
SearchRay(const itk::MedialVoxelMargins & margins, const Spacing & spacing, const Point & start, double maximum)
{
  const auto at = [&margins](const Point & point) {
    double value = 0.0;
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      Index  voxel{};
      for (unsigned int k = 0; k < 3; ++k)
      {
        const double lower = std::min(std::floor(point[k]), Size - 2.0);
        const double share = point[k] - lower;
        weight *= (corner >> k & 1u) != 0 ? share : 1.0 - share;
        voxel[k] = static_cast<std::int64_t>(lower) + (corner >> k & 1u);
      }
      value += weight * margins.Get(voxel[0], voxel[1], voxel[2]);
    }
    return value;
  };
  std::array<double, 4> sums{};
  std::array<double, 3> moments{};
  for (std::int64_t z = 0; z < Size; ++z)
  {
    for (std::int64_t y = 0; y < Size; ++y)
    {
      for (std::int64_t x = 0; x < Size; ++x)
      {
        const Point  way{ x - start[0], y - start[1], z - start[2] };
        const double weight = std::exp(-0.5 * Dot(way, way));
        const double value = margins.Get(x, y, z);
        sums[3] += weight;
        for (unsigned int k = 0; k < 3; ++k)
        {
          sums[k] += weight * way[k] * value / spacing[k];
          moments[k] += weight * value;
        }
      }
    }
  }
  Point        direction{ sums[0], sums[1], sums[2] };
  const double norm = Norm(direction);
  double       last = 0.0;
  for (double length = 0.002; length <= maximum; length += 0.002)
  {
    Point point{};
    for (unsigned int k = 0; k < 3; ++k)
    {
      point[k] = start[k] + length * direction[k] / norm / spacing[k];
      if (point[k] < 0.0 || point[k] > Size - 1)
      {
        return std::nullopt;
      }
    }
    const double value = at(point);
    if (last > 0.25 && value < 0.0)
    {
      return length;
    }
    last = value >= 0.0 ? length : last;
  }
  return std::nullopt;
}

TEST(MedialVoxelWallRay, EqualsASearchWithSmallStepsInRoughParts)
{
  std::mt19937                           draw(13);
  std::uniform_real_distribution<double> phase(0.0, 6.0);
  const Point                            shift{ phase(draw), phase(draw), phase(draw) };
  // A gyroid whose walls differ, so that some rays are too long.
  const auto distance = [&shift](const Point & p) {
    const Point q{ 0.35 * p[0] + shift[0], 0.35 * p[1] + shift[1], 0.35 * p[2] + shift[2] };
    return 0.5 + 0.03 * p[0] -
           std::abs(std::sin(q[0]) * std::cos(q[1]) + std::sin(q[1]) * std::cos(q[2]) +
                    std::sin(q[2]) * std::cos(q[0]));
  };
  for (const Spacing & spacing : { Equal, Unequal })
  {
    const auto                                  margins = Sample(spacing, distance);
    const itk::MedialVoxelWallRay               ray(margins, spacing, 3.0);
    std::uniform_int_distribution<std::int64_t> index(6, Size - 8);
    unsigned int                                answered = 0;
    unsigned int                                unanswered = 0;
    unsigned int                                different = 0;
    while (answered + unanswered < 120)
    {
      const Index  voxel{ index(draw), index(draw), index(draw) };
      const double inside = margins.Get(voxel[0], voxel[1], voxel[2]);
      const double outside = margins.Get(voxel[0] + 1, voxel[1], voxel[2]);
      if (inside < 0.0 || outside >= 0.0)
      {
        continue;
      }
      const Point start{ voxel[0] + inside / (inside - outside),
                         static_cast<double>(voxel[1]),
                         static_cast<double>(voxel[2]) };
      const auto  found = ray.Measure(start);
      const auto  expected = SearchRay(margins, spacing, start, 3.0);
      answered += expected ? 1 : 0;
      unanswered += expected ? 0 : 1;
      const bool isAnswered = found.end == End::Surface;
      different +=
        isAnswered != expected.has_value() || (isAnswered && std::abs(found.length - *expected) > 0.05) ? 1 : 0;
    }
    EXPECT_LE(different, 3u) << "grazing rays";
    EXPECT_GT(answered, 60u);
    EXPECT_GT(unanswered, 5u);
  }
}

TEST(MedialVoxelWallRay, HasNoAnswerWithoutGradientOrOpposite)
{
  auto                          margins = Sample(Equal, [](const Point & p) { return p[2] < 0.0 ? -0.5 : 0.5; });
  const itk::MedialVoxelWallRay ray(margins, Equal, 50.0);
  EXPECT_EQ(ray.Measure({ 20.0, 20.0, 21.5 }).end, End::Image) << "leaves it";
  EXPECT_EQ(ray.Measure({ 20.0, 20.0, 5.0 }).end, End::Unknown) << "all margins around it are equal";
  EXPECT_EQ(ray.Measure({ -0.5, 20.0, 21.5 }).end, End::Image) << "outside";
  margins.GetRow(20, 25)[20] = std::numeric_limits<float>::quiet_NaN();
  margins.GetRow(20, 30)[20] = -3.0f;
  EXPECT_EQ(ray.Measure({ 20.0, 20.0, 21.5 }).end, End::Unknown) << "behind a margin that is not known";
}

} // namespace
