// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelThickness.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

/** Sums over the boundary points of one side of a wall. */
struct Side
{
  MedialVoxelIndex sum{ { 0, 0, 0 } }; // of the positions, seen from a
  int              number{ 0 };
  int              excess{ 0 }; // of background over object voxels around the points
};

} // namespace

MedialVoxelThickness::MedialVoxelThickness(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_BlockVoxels *= grid.IsActive(axis) ? 3 : 1;
    m_CellVolume *= grid.IsActive(axis) ? grid.GetSpacing()[axis] : 1.0;
  }
}

MedialVoxelWall
MedialVoxelThickness::Measure(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall) const
{
  const MedialVoxelIndex across{ { wall.b[0] - wall.a[0], wall.b[1] - wall.a[1], wall.b[2] - wall.a[2] } };
  const std::int64_t     squaredLength = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];

  Side sides[2];
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = wall.corners[corner];
    const MedialVoxelIndex   position{ { point[0] - wall.a[0], point[1] - wall.a[1], point[2] - wall.a[2] } };
    const std::int64_t       twiceProjection =
      2 * (across[0] * position[0] + across[1] * position[1] + across[2] * position[2]);
    if (twiceProjection == squaredLength)
    {
      continue;
    }
    Side & side = sides[twiceProjection < squaredLength ? 0 : 1];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      side.sum[axis] += position[axis];
    }
    ++side.number;
    side.excess += m_BlockVoxels - 2 * this->CountObjectAround(object, point);
  }

  const double    numbers[2] = { static_cast<double>(sides[0].number), static_cast<double>(sides[1].number) };
  const auto &    spacing = m_Grid.GetSpacing();
  double          squaredDistance = 0.0;
  double          steepest = 0.0; // largest component of the direction in voxels, times the distance
  double          longest = 0.0;
  double          extent = 0.0; // of a cell across the wall, times the distance
  MedialVoxelWall measured;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double way =
      (static_cast<double>(sides[1].sum[axis]) / numbers[1] - static_cast<double>(sides[0].sum[axis]) / numbers[0]) *
      spacing[axis];
    const double length = std::abs(way);
    squaredDistance += way * way;
    steepest = std::max(steepest, length * spacing[axis]);
    extent += length * spacing[axis];
    measured.axis = length > longest ? axis : measured.axis;
    longest = std::max(longest, length);
  }
  const double distance = std::sqrt(squaredDistance);
  // The block is three voxels long; a share of one half puts the plane through its center.
  const double excess = sides[0].excess / numbers[0] + sides[1].excess / numbers[1];
  const double toFaces = 1.5 * excess / m_BlockVoxels * (steepest / distance);
  measured.thickness = static_cast<float>(std::max(0.0, distance - toFaces));
  measured.area = static_cast<float>(m_CellVolume * distance / extent);
  return measured;
}

int
MedialVoxelThickness::CountObjectAround(const MedialVoxelBits & object, const MedialVoxelIndex & point) const
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (point[axis] < 1 || point[axis] + 1 >= m_Grid.GetSize()[axis])
    {
      return this->CountAtFaceOfImage(object, point);
    }
  }
  using WordType = MedialVoxelBits::WordType;
  const std::int64_t     x = point[0] - 1;
  const auto             shift = static_cast<unsigned int>(x & (MedialVoxelBits::BitsPerWord - 1));
  const std::int64_t     slicePitch = object.GetBox().Extent(1) * object.GetRowPitch();
  const WordType * const first = object.GetRow(point[1] - 1, point[2] - 1) + ((x >> 6) - object.GetFirstWord());
  WordType               bits = 0;
  for (int dz = 0; dz < 3; ++dz)
  {
    for (int dy = 0; dy < 3; ++dy)
    {
      const WordType * const row = first + dz * slicePitch + dy * object.GetRowPitch();
      const WordType         three = (row[0] >> shift) | ((row[1] << 1) << (MedialVoxelBits::BitsPerWord - 1 - shift));
      bits = (bits << 3) | (three & 7);
    }
  }
  return MedialVoxelPopulationCount(bits);
}

int
MedialVoxelThickness::CountAtFaceOfImage(const MedialVoxelBits & object, const MedialVoxelIndex & point) const
{
  const MedialVoxelIndex margin = m_Grid.GetUnitMargin();
  const auto             inImage = [&](const unsigned int axis, const std::int64_t offset) {
    return std::clamp<std::int64_t>(point[axis] + offset, 0, m_Grid.GetSize()[axis] - 1);
  };
  int count = 0;
  for (std::int64_t dz = -margin[2]; dz <= margin[2]; ++dz)
  {
    for (std::int64_t dy = -margin[1]; dy <= margin[1]; ++dy)
    {
      for (std::int64_t dx = -margin[0]; dx <= margin[0]; ++dx)
      {
        count += object.Test({ { inImage(0, dx), inImage(1, dy), inImage(2, dz) } }) ? 1 : 0;
      }
    }
  }
  return count;
}

} // end namespace itk
