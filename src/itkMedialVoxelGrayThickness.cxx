// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayThickness.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using PositionType = MedialVoxelGrayBoundary::PositionType;
using Crossing = MedialVoxelGrayBoundary::Crossing;

double
Dot(const PositionType & a, const PositionType & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Side of a boundary point: 0 nearer to a, 1 nearer to b in voxels, 2 halfway. */
unsigned int
SideOf(const MedialVoxelWallPoints & points, const MedialVoxelIndex & point)
{
  std::int64_t twiceProjection = 0;
  std::int64_t squaredLength = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t across = points.b[axis] - points.a[axis];
    twiceProjection += 2 * across * (point[axis] - points.a[axis]);
    squaredLength += across * across;
  }
  return twiceProjection == squaredLength ? 2u : (twiceProjection < squaredLength ? 0u : 1u);
}

/** Adds a crossing to the sums of its side, as often as lines found it. */
void
AddTo(Crossing & side, const Crossing & crossing)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    side.position[axis] += crossing.numberOfLines * crossing.position[axis];
    side.normal[axis] += crossing.numberOfLines * crossing.normal[axis];
  }
  side.numberOfLines += crossing.numberOfLines;
}

} // namespace

MedialVoxelGrayThickness::MedialVoxelGrayThickness(const MedialVoxelGrid & grid, const double lower, const double upper)
  : m_Grid(grid)
  , m_Boundary(grid, lower, upper)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_CellVolume *= grid.IsActive(axis) ? grid.GetSpacing()[axis] : 1.0;
  }
}

MedialVoxelBox
MedialVoxelGrayThickness::GetReadBox(const MedialVoxelWallPoints & points) const
{
  constexpr std::int64_t reach = MedialVoxelGrayBoundary::Reach;
  MedialVoxelBox         box;
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    box = box.Union({ point, { { point[0] + 1, point[1] + 1, point[2] + 1 } } });
  }
  return box.Expanded({ { reach, reach, reach } }).Intersection(m_Grid.GetVoxelBox());
}

auto
MedialVoxelGrayThickness::FindCrossings(const MedialVoxelGray & gray, const MedialVoxelWallPoints & points) const
  -> Crossings
{
  const PositionType fromA = this->GetDirection(points);
  const PositionType fromB{ { -fromA[0], -fromA[1], -fromA[2] } };
  Crossings          crossings;
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    // Corners of a cell mostly share their boundary points.
    const auto first = std::find(points.corners.begin(), points.corners.begin() + corner, point);
    if (first != points.corners.begin() + corner)
    {
      crossings[corner] = crossings[static_cast<std::size_t>(first - points.corners.begin())];
    }
    else if (SideOf(points, point) < 2)
    {
      crossings[corner] = m_Boundary.Find(gray, point, SideOf(points, point) == 0 ? fromA : fromB);
    }
  }
  return crossings;
}

void
MedialVoxelGrayThickness::Refine(const MedialVoxelWallPoints & points,
                                 const Crossings &             crossings,
                                 MedialVoxelWall &             wall) const
{
  Crossing sides[2];
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const unsigned int side = SideOf(points, points.corners[corner]);
    if (side < 2)
    {
      AddTo(sides[side], crossings[corner]);
    }
  }
  if (sides[0].numberOfLines == 0.0 || sides[1].numberOfLines == 0.0)
  {
    return;
  }
  // The normals of both sides point into the wall.
  PositionType way;
  PositionType normal;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    way[axis] = sides[1].position[axis] / sides[1].numberOfLines - sides[0].position[axis] / sides[0].numberOfLines;
    normal[axis] = sides[0].normal[axis] / sides[0].numberOfLines - sides[1].normal[axis] / sides[1].numberOfLines;
  }
  const double length = std::sqrt(Dot(normal, normal));
  const double thickness = Dot(way, normal) / length;
  if (!(thickness > 0.0))
  {
    return;
  }
  double extent = 0.0; // of a cell along the normal
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    extent += std::abs(normal[axis]) / length * m_Grid.GetSpacing()[axis];
  }
  wall.thickness = static_cast<float>(thickness);
  wall.area = static_cast<float>(m_CellVolume / extent);
}

auto
MedialVoxelGrayThickness::GetDirection(const MedialVoxelWallPoints & points) const -> PositionType
{
  PositionType sums[3] = {};
  double       numbers[3] = { 0.0, 0.0, 0.0 };
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    const unsigned int       side = SideOf(points, point);
    ++numbers[side];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sums[side][axis] += static_cast<double>(point[axis] - points.a[axis]) * m_Grid.GetSpacing()[axis];
    }
  }
  PositionType direction;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    direction[axis] = sums[1][axis] / numbers[1] - sums[0][axis] / numbers[0];
  }
  return direction;
}

} // end namespace itk
