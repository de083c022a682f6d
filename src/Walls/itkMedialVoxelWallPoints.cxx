// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallPoints.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using SidesType = MedialVoxelWallPoints::SidesType;

/** The displacement through a wall, between the means of the points on both sides. */
struct WallAxis
{
  MedialVoxelIndex across{};    // the displacement, times the numbers of points of both sides
  std::int64_t     middle{ 0 }; // how far along it the middle is, times twice these numbers
  std::int64_t     factor{ 0 }; // twice these numbers
};

std::int64_t
DotProduct(const MedialVoxelIndex & a, const MedialVoxelIndex & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

MedialVoxelIndex
FromTo(const MedialVoxelIndex & a, const MedialVoxelIndex & b)
{
  return { { b[0] - a[0], b[1] - a[1], b[2] - a[2] } };
}

/** From the points in the first and the last quarter of the line from a to b, including a and b. */
WallAxis
FindWallAxis(const MedialVoxelWallPoints & wall)
{
  const MedialVoxelIndex across = FromTo(wall.a, wall.b);
  const std::int64_t     squaredLength = DotProduct(across, across);
  MedialVoxelIndex       sums[2] = {};
  std::int64_t           numbers[2] = {};
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex place = FromTo(wall.a, wall.corners[corner]);
    const std::int64_t     quarters = 4 * DotProduct(across, place);
    if (quarters <= squaredLength || quarters >= 3 * squaredLength)
    {
      const unsigned int side = quarters <= squaredLength ? 0 : 1;
      ++numbers[side];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sums[side][axis] += place[axis];
      }
    }
  }
  WallAxis         wallAxis;
  MedialVoxelIndex ends;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    wallAxis.across[axis] = numbers[0] * sums[1][axis] - numbers[1] * sums[0][axis];
    ends[axis] = numbers[0] * sums[1][axis] + numbers[1] * sums[0][axis];
  }
  wallAxis.middle = DotProduct(wallAxis.across, ends);
  wallAxis.factor = 2 * numbers[0] * numbers[1];
  return wallAxis;
}

/** Points this near to the middle are on the end of the wall and belong to no side; a share of half the
 * displacement. */
double
ShareOfEnds(const WallAxis & wallAxis)
{
  constexpr double largestShare = 0.3;
  constexpr double voxelsOfSides = 3.0; // of thin tilted walls, the points of a side are as far apart along it
  const double     length = 2.0 * std::sqrt(static_cast<double>(DotProduct(wallAxis.across, wallAxis.across))) /
                        static_cast<double>(wallAxis.factor);
  return std::clamp(1.0 - voxelsOfSides / length, 0.0, largestShare);
}

/** Corners whose partner through the wall belongs to no side leave their side too, so that the means of both sides are
 * at the same place; not where a side would lose all. */
SidesType
WithoutHalfPairs(const MedialVoxelWallPoints & wall, const SidesType & sides)
{
  const unsigned int bit = wall.GetBitOfPairs(sides);
  SidesType          pairs = sides;
  unsigned int       numbers[3] = {};
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    pairs[corner] = sides[corner ^ bit] == 2 ? 2 : sides[corner];
    ++numbers[pairs[corner]];
  }
  return numbers[0] > 0 && numbers[1] > 0 ? pairs : sides;
}

} // namespace

auto
MedialVoxelWallPoints::GetSides() const -> SidesType
{
  const WallAxis wallAxis = FindWallAxis(*this);
  const double   ends = ShareOfEnds(wallAxis) * static_cast<double>(DotProduct(wallAxis.across, wallAxis.across));
  SidesType      sides;
  sides.fill(2);
  for (unsigned int corner = 0; corner < numberOfCorners; ++corner)
  {
    const std::int64_t side =
      wallAxis.factor * DotProduct(wallAxis.across, FromTo(a, corners[corner])) - wallAxis.middle;
    sides[corner] = std::abs(static_cast<double>(side)) <= ends ? 2 : (side < 0 ? 0 : 1);
  }
  return WithoutHalfPairs(*this, sides);
}

auto
MedialVoxelWallPoints::GetNearerSides() const -> SidesType
{
  const MedialVoxelIndex across = FromTo(a, b);
  SidesType              sides;
  sides.fill(2);
  for (unsigned int corner = 0; corner < numberOfCorners; ++corner)
  {
    const std::int64_t side = 2 * DotProduct(across, FromTo(a, corners[corner])) - DotProduct(across, across);
    sides[corner] = side == 0 ? 2 : (side < 0 ? 0 : 1);
  }
  return sides;
}

bool
MedialVoxelWallPoints::IsThin() const
{
  constexpr std::int64_t largestSquaredLength = 12;
  const MedialVoxelIndex across = FromTo(a, b);
  return DotProduct(across, across) <= largestSquaredLength;
}

unsigned int
MedialVoxelWallPoints::GetBitOfPairs(const SidesType & sides) const
{
  unsigned int best = 1;
  unsigned int largest = 0;
  for (unsigned int bit = 1; bit < numberOfCorners; bit <<= 1)
  {
    unsigned int number = 0;
    for (unsigned int corner = 0; corner < numberOfCorners; ++corner)
    {
      number += sides[corner] + sides[corner ^ bit] == 1 ? 1 : 0;
    }
    best = number > largest ? bit : best;
    largest = std::max(largest, number);
  }
  return best;
}

} // end namespace itk
