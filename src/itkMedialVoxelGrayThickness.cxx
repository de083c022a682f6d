// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayThickness.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using PositionType = std::array<double, 3>;

double
Dot(const PositionType & a, const PositionType & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

PositionType
Along(const PositionType & start, const PositionType & way, const double times)
{
  return { { start[0] + times * way[0], start[1] + times * way[1], start[2] + times * way[2] } };
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

} // namespace

struct MedialVoxelGrayThickness::Field
{
  const MedialVoxelGray & gray;
  const MedialVoxelGrid & grid;
  double                  level;
  double                  sign; // positive values are object

  /** Trilinear; axes of one voxel drop out. */
  double
  At(const PositionType & position) const
  {
    MedialVoxelIndex below;
    MedialVoxelIndex above;
    PositionType     share;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double       floor = std::floor(position[axis]);
      const auto         index = static_cast<std::int64_t>(floor);
      const std::int64_t last = grid.GetSize()[axis] - 1;
      share[axis] = position[axis] - floor;
      below[axis] = std::clamp<std::int64_t>(index, 0, last);
      above[axis] = share[axis] > 0.0 ? std::clamp<std::int64_t>(index + 1, 0, last) : below[axis];
    }
    double sum = 0.0;
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      double           weight = 1.0;
      MedialVoxelIndex voxel;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const bool isAbove = ((corner >> axis) & 1u) != 0;
        weight *= isAbove ? share[axis] : 1.0 - share[axis];
        voxel[axis] = isAbove ? above[axis] : below[axis];
      }
      sum += weight > 0.0 ? weight * static_cast<double>(gray.Get(voxel)) : 0.0;
    }
    return sign * (sum - level);
  }

  /** Of the voxels around a position, smoothed across each axis so that steep components count as much as others
   * (Scharr). */
  PositionType
  GetGradient(const PositionType & position) const
  {
    constexpr double       smooth[3] = { 3.0 / 16, 10.0 / 16, 3.0 / 16 };
    PositionType           gradient{ { 0.0, 0.0, 0.0 } };
    const MedialVoxelIndex margin = grid.GetUnitMargin();
    for (std::int64_t z = -margin[2]; z <= margin[2]; ++z)
    {
      for (std::int64_t y = -margin[1]; y <= margin[1]; ++y)
      {
        for (std::int64_t x = -margin[0]; x <= margin[0]; ++x)
        {
          const double value = this->At({ { position[0] + static_cast<double>(x),
                                            position[1] + static_cast<double>(y),
                                            position[2] + static_cast<double>(z) } });
          gradient[0] += static_cast<double>(x) * smooth[y + 1] * smooth[z + 1] * value;
          gradient[1] += static_cast<double>(y) * smooth[x + 1] * smooth[z + 1] * value;
          gradient[2] += static_cast<double>(z) * smooth[x + 1] * smooth[y + 1] * value;
        }
      }
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] /= grid.GetSpacing()[axis];
    }
    return gradient;
  }

  /** Where the values rise through the threshold along a line, in multiples of \a way; false when they do not. */
  bool
  FindCrossing(const PositionType & start, const PositionType & way, double & times) const
  {
    constexpr double step = 0.25;
    constexpr int    first = -3;
    constexpr int    last = 8;
    double           outside = this->At(Along(start, way, first * step));
    if (!(outside < 0.0))
    {
      return false;
    }
    for (int i = first + 1; i <= last; ++i)
    {
      const double inside = this->At(Along(start, way, i * step));
      if (inside >= 0.0)
      {
        times = step * (i - inside / (inside - outside));
        return true;
      }
      outside = inside;
    }
    return false;
  }
};

struct MedialVoxelGrayThickness::Side
{
  PositionType position{ { 0.0, 0.0, 0.0 } }; // of the crossings, in the units of the spacing
  PositionType normal{ { 0.0, 0.0, 0.0 } };   // of unit length each
  double       number{ 0.0 };
};


MedialVoxelGrayThickness::MedialVoxelGrayThickness(const MedialVoxelGrid & grid, const double lower, const double upper)
  : m_Grid(grid)
  , m_Lower(lower)
  , m_Upper(upper)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_CellVolume *= grid.IsActive(axis) ? grid.GetSpacing()[axis] : 1.0;
  }
}

MedialVoxelBox
MedialVoxelGrayThickness::GetReadBox(const MedialVoxelWallPoints & points) const
{
  MedialVoxelBox box;
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    box = box.Union({ point, { { point[0] + 1, point[1] + 1, point[2] + 1 } } });
  }
  return box.Expanded({ { Reach, Reach, Reach } }).Intersection(m_Grid.GetVoxelBox());
}

void
MedialVoxelGrayThickness::Refine(const MedialVoxelGray &       gray,
                                 const MedialVoxelWallPoints & points,
                                 MedialVoxelWall &             wall) const
{
  const PositionType direction = this->GetDirection(points);
  Side               sides[2];
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const unsigned int side = SideOf(points, points.corners[corner]);
    if (side < 2)
    {
      const double sign = side == 0 ? 1.0 : -1.0;
      this->AddCrossings(gray, points.corners[corner], Along({ { 0.0, 0.0, 0.0 } }, direction, sign), sides[side]);
    }
  }
  if (sides[0].number == 0.0 || sides[1].number == 0.0)
  {
    return;
  }
  // The normals of both sides point into the wall.
  PositionType way;
  PositionType normal;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    way[axis] = sides[1].position[axis] / sides[1].number - sides[0].position[axis] / sides[0].number;
    normal[axis] = sides[0].normal[axis] / sides[0].number - sides[1].normal[axis] / sides[1].number;
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

auto
MedialVoxelGrayThickness::ToVoxels(const PositionType & direction) const -> PositionType
{
  PositionType voxels;
  double       largest = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    voxels[axis] = direction[axis] / m_Grid.GetSpacing()[axis];
    largest = std::max(largest, std::abs(voxels[axis]));
  }
  return Along({ { 0.0, 0.0, 0.0 } }, voxels, 1.0 / largest);
}

/** Adds where the values cross the threshold, on four lines along their gradient around a boundary point. What a line
 * sees depends on where it passes between the voxels; half a voxel further it errs the other way. */
void
MedialVoxelGrayThickness::AddCrossings(const MedialVoxelGray &  gray,
                                       const MedialVoxelIndex & point,
                                       const PositionType &     inwards,
                                       Side &                   side) const
{
  const bool         isBelow = static_cast<double>(gray.Get(point)) < m_Lower;
  const Field        field{ gray, m_Grid, isBelow ? m_Lower : m_Upper, isBelow ? 1.0 : -1.0 };
  const PositionType start{
    { static_cast<double>(point[0]), static_cast<double>(point[1]), static_cast<double>(point[2]) }
  };
  const PositionType gradient = field.GetGradient(Along(start, this->ToVoxels(inwards), 0.5));
  const double       length = std::sqrt(Dot(gradient, gradient));
  if (!(length > 0.0) || !std::isfinite(length) || !(Dot(gradient, inwards) > 0.0))
  {
    return;
  }
  const PositionType way = this->ToVoxels(gradient);
  PositionType       across[2];
  this->GetTangents(gradient, across);
  for (const double first : { -0.25, 0.25 })
  {
    for (const double second : { -0.25, 0.25 })
    {
      const PositionType beside = Along(Along(start, across[0], first), across[1], second);
      double             times = 0.0;
      if (field.FindCrossing(beside, way, times))
      {
        const PositionType crossing = Along(beside, way, times);
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          side.position[axis] += crossing[axis] * m_Grid.GetSpacing()[axis];
          side.normal[axis] += gradient[axis] / length;
        }
        side.number += 1.0;
      }
    }
  }
}

/** Two directions in voxels along which the values do not change, the largest component of each 1, or 0 where an image
 * has no such direction. */
void
MedialVoxelGrayThickness::GetTangents(const PositionType & gradient, PositionType (&tangents)[2]) const
{
  PositionType steep; // in voxels
  unsigned int steepest = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    steep[axis] = gradient[axis] * m_Grid.GetSpacing()[axis];
    steepest = std::abs(steep[axis]) > std::abs(steep[steepest]) ? axis : steepest;
  }
  for (unsigned int i = 0; i < 2; ++i)
  {
    const unsigned int axis = (steepest + 1 + i) % 3;
    tangents[i] = { { 0.0, 0.0, 0.0 } };
    if (m_Grid.IsActive(axis))
    {
      tangents[i][axis] = 1.0;
      tangents[i][steepest] = -steep[axis] / steep[steepest];
    }
  }
}

} // end namespace itk
