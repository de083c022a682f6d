// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayThickness.h"

#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using PositionType = MedialVoxelGrayBoundary::PositionType;
using Crossing = MedialVoxelGrayBoundary::Crossing;

/** Adds a crossing to the sums of its side, as often as lines found it. */
void
AddTo(Crossing & side, const Crossing & crossing)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    side.position[axis] += crossing.numberOfLines * crossing.position[axis];
    side.normal[axis] += crossing.numberOfLines * crossing.normal[axis];
  }
  side.isRising = side.numberOfLines > 0.0 ? side.isRising : crossing.isRising;
  side.numberOfLines += crossing.numberOfLines;
}

} // namespace

MedialVoxelGrayThickness::MedialVoxelGrayThickness(const MedialVoxelGrid & grid, const double lower, const double upper)
  : m_Grid(grid)
  , m_Boundary(grid, lower, upper)
  , m_Smallest(MedialVoxelThickness(grid).GetSmallest())
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_CellVolume *= grid.IsActive(axis) ? grid.GetSpacing()[axis] : 1.0;
  }
}

MedialVoxelBox
MedialVoxelGrayThickness::GetBoxAround(const MedialVoxelWallPoints & points)
{
  constexpr std::int64_t reach = MedialVoxelGrayBoundary::Reach;
  MedialVoxelBox         box;
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    box = box.Union({ point, { { point[0] + 1, point[1] + 1, point[2] + 1 } } });
  }
  return box.Expanded({ { reach, reach, reach } });
}

MedialVoxelBox
MedialVoxelGrayThickness::GetReadBox(const MedialVoxelWallPoints & points) const
{
  return GetBoxAround(points).Intersection(m_Grid.GetVoxelBox());
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
    else if (points.SideOf(point) < 2)
    {
      crossings[corner] = m_Boundary.Find(gray, point, points.SideOf(point) == 0 ? fromA : fromB);
    }
  }
  return crossings;
}

void
MedialVoxelGrayThickness::Refine(const MedialVoxelGray &       gray,
                                 const MedialVoxelWallPoints & points,
                                 const Crossings &             crossings,
                                 MedialVoxelWall &             wall) const
{
  Crossing sides[2];
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const unsigned int side = points.SideOf(points.corners[corner]);
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
  PositionType normal;
  PositionType center; // of the cell
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = sides[0].normal[axis] / sides[0].numberOfLines - sides[1].normal[axis] / sides[1].numberOfLines;
    center[axis] =
      (static_cast<double>(points.cell[axis]) + (m_Grid.IsActive(axis) ? 0.5 : 0.0)) * m_Grid.GetSpacing()[axis];
  }
  const double length = MedialVoxelNorm(normal);
  double       extent = 0.0; // of a cell along the normal
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    normal[axis] /= length;
    extent += std::abs(normal[axis]) * m_Grid.GetSpacing()[axis];
  }
  double thickness = 0.0;
  for (Crossing & side : sides)
  {
    const double sign = &side == &sides[0] ? 1.0 : -1.0;
    double       position = sign * MedialVoxelDot(side.position, normal) / side.numberOfLines;
    PositionType foot;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      foot[axis] = center[axis] + (sign * position - MedialVoxelDot(center, normal)) * normal[axis];
      side.normal[axis] = sign * normal[axis];
    }
    m_Boundary.FindAround(gray, GetBoxAround(points), foot, side, position);
    thickness -= position;
  }
  if (thickness > 0.0)
  {
    wall.thickness = static_cast<float>(std::max(m_Smallest, thickness));
    wall.area = static_cast<float>(m_CellVolume / extent);
  }
}

auto
MedialVoxelGrayThickness::GetDirection(const MedialVoxelWallPoints & points) const -> PositionType
{
  PositionType sums[3] = {};
  double       numbers[3] = { 0.0, 0.0, 0.0 };
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    const unsigned int       side = points.SideOf(point);
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
