// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MedialVoxelTestWallThickness_h
#define MedialVoxelTestWallThickness_h

// The local thickness of walls by brute force, ball by ball and voxel by voxel.

#include "MedialVoxelTestLocalThickness.h"
#include "MedialVoxelTestThickness.h"

namespace MedialVoxelTest
{
/** Whether \a actual are the same bytes, any NaN being equal to any other. */
inline ::testing::AssertionResult
AreEqualOrNan(std::vector<float> actual, std::vector<float> expected)
{
  const auto isNan = [](const float value) { return std::isnan(value); };
  std::replace_if(actual.begin(), actual.end(), isNan, -1.0f);
  std::replace_if(expected.begin(), expected.end(), isNan, -1.0f);
  return AreEqual(actual, expected);
}

struct WallBall
{
  Vector3 center; ///< in units of the metric
  double  radius;
  float   thickness;
};

/** The thickness at the cells that a medial filter finds with its defaults but without pores. */
template <typename TFilter>
std::vector<float>
ThicknessOfCells(TFilter & filter)
{
  filter.SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  filter.SetMaximumPoreSize(0);
  filter.GenerateThicknessOn();
  filter.Update();
  return PixelsOf(filter.GetThicknessOutput());
}

/** The balls of all medial cells that measure a wall. */
inline std::vector<WallBall>
BallsOfWalls(const Volume & volume, const std::vector<float> & thicknesses, const double maximumThickness)
{
  const itk::MedialVoxelGrid grid({ { volume.size[0], volume.size[1], volume.size[2] } }, volume.spacing);
  const double               maximumRadius = 0.5 * maximumThickness / grid.GetMetricUnit();
  const auto                 sites = BoundarySites(volume);
  const auto                 nearest = NearestBoundaryPoints(volume, sites);
  std::vector<WallBall>      balls;
  for (std::size_t i = 0; i < thicknesses.size(); ++i)
  {
    if (!(thicknesses[i] > 0.0f))
    {
      continue;
    }
    const Index3 cell = volume.IndexAt(i);
    const Pair   pair = ChoosePair(volume, sites, nearest, cell);
    WallBall     ball{ {}, 0.0, std::min(thicknesses[i], static_cast<float>(maximumThickness)) };
    double       squares[2] = { 0.0, 0.0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      const double place = cell[axis] + (volume.size[axis] > 1 ? 0.5 : 0.0);
      const double unit = grid.GetMetricSpacing()[axis];
      ball.center[axis] = place;
      squares[0] += std::pow((sites[static_cast<std::size_t>(pair.ni)][axis] - place) * unit, 2);
      squares[1] += std::pow((sites[static_cast<std::size_t>(pair.nj)][axis] - place) * unit, 2);
    }
    ball.radius = std::min(0.5 * (std::sqrt(squares[0]) + std::sqrt(squares[1])), maximumRadius);
    balls.push_back(ball);
  }
  return balls;
}

/** The thickness of the largest ball that covers each object voxel, the largest of equal ones; NaN without one, 0 in
 * background. */
inline std::vector<float>
ExpectedWallThickness(const Volume & volume, const std::vector<float> & thicknesses, const double maximumThickness)
{
  const itk::MedialVoxelGrid grid({ { volume.size[0], volume.size[1], volume.size[2] } }, volume.spacing);
  const auto                 balls = BallsOfWalls(volume, thicknesses, maximumThickness);
  std::vector<float>         expected(volume.object.size(), 0.0f);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    if (!volume.object[i])
    {
      continue;
    }
    const Index3 voxel = volume.IndexAt(i);
    expected[i] = std::numeric_limits<float>::quiet_NaN();
    std::pair<double, float> largest{ 0.0, 0.0f };
    for (const WallBall & ball : balls)
    {
      double ways[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        ways[axis] = (voxel[axis] - ball.center[axis]) * grid.GetMetricSpacing()[axis];
      }
      const double square = (ways[0] * ways[0] + ways[1] * ways[1]) + ways[2] * ways[2];
      if (square < ball.radius * ball.radius && largest < std::make_pair(ball.radius, ball.thickness))
      {
        largest = { ball.radius, ball.thickness };
        expected[i] = ball.thickness;
      }
    }
  }
  return expected;
}

/** The same, of walls on the object. */
template <unsigned int D>
std::vector<float>
ExpectedWallThickness(const Volume & volume, const double maximumThickness)
{
  return ExpectedWallThickness(volume, ThicknessOfCells(*MakeMedialFilter<D>(volume, 3.0)), maximumThickness);
}
} // namespace MedialVoxelTest

#endif
