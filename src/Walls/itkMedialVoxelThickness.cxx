// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelThickness.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using PositionType = std::array<double, 3>;
using BlockType = std::uint32_t; // the 3^3 voxels around a point, see GetObjectAround()

constexpr int CenterOfBlock = 13;

/** Sums over the boundary points of one side of a wall. */
struct Side
{
  MedialVoxelIndex sum{ { 0, 0, 0 } }; // of the positions, seen from a
  int              number{ 0 };
  int              excess{ 0 };              // of background over object voxels around the points
  std::int64_t     inwards[3] = { 0, 0, 0 }; // sum of the offsets of the object voxels
};

/** Components of the offset at a bit of a block. */
PositionType
OffsetAt(const int bit)
{
  return {
    { static_cast<double>(bit % 3 - 1), static_cast<double>(bit / 3 % 3 - 1), static_cast<double>(bit / 9 - 1) }
  };
}

/** The voxels at the opposite offsets: the bits in reverse order. */
BlockType
Mirror(BlockType block)
{
  constexpr BlockType halves[5] = { 0x55555555, 0x33333333, 0x0F0F0F0F, 0x00FF00FF, 0x0000FFFF };
  for (unsigned int i = 0; i < 5; ++i)
  {
    block = ((block >> (1u << i)) & halves[i]) | ((block & halves[i]) << (1u << i));
  }
  return block >> (31 - 2 * CenterOfBlock);
}

/** Leaves out the voxels of another wall behind a narrow gap.
 *
 * \param inwards  normal of the wall in voxels, of any length, from the point towards its side of the wall */
BlockType
WithoutOtherWall(const BlockType block, const PositionType & inwards)
{
  constexpr double slack = 0.25;
  const double     length = std::sqrt(inwards[0] * inwards[0] + inwards[1] * inwards[1] + inwards[2] * inwards[2]);
  BlockType        kept = block;
  for (BlockType rest = block & Mirror(block); rest != 0; rest &= rest - 1)
  {
    const int          bit = MedialVoxelLowestBit(rest);
    const PositionType offset = OffsetAt(bit);
    if (inwards[0] * offset[0] + inwards[1] * offset[1] + inwards[2] * offset[2] < -slack * length)
    {
      kept &= ~(BlockType{ 1 } << bit);
    }
  }
  return kept;
}

void
AddOffsets(const BlockType block, Side & side)
{
  constexpr BlockType lower[3] = { 0x1249249, 0x01C0E07, 0x00001FF };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    constexpr unsigned int toUpper[3] = { 2, 6, 18 };
    side.inwards[axis] += MedialVoxelPopulationCount(block & (lower[axis] << toUpper[axis])) -
                          MedialVoxelPopulationCount(block & lower[axis]);
  }
}

/** By how much the distance of a plane from the center of a block of 3 voxels grows, for each third of the block that
 * it cuts off, near the center: the inverse of the area of a unit cube's section.
 *
 * \param normal  in voxels, times the length that a voxel has along it */
double
GetStep(const PositionType & normal)
{
  std::array<double, 3> n{ { std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2]) } };
  std::sort(n.begin(), n.end());
  const double cut = n[0] + n[1] - n[2];
  return cut > 0.0 ? 1.0 / (1.0 / n[2] - cut * cut / (4.0 * n[0] * n[1] * n[2])) : n[2];
}

/** Whether the surfaces of both sides are far from parallel. */
bool
IsRim(const Side (&sides)[2], const MedialVoxelGrid::SpacingType & spacing)
{
  constexpr double leastCosine = 0.8;
  double           dot = 0.0;
  double           squaredLengths[2] = { 0.0, 0.0 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double a = static_cast<double>(sides[0].inwards[axis]) / spacing[axis];
    const double b = static_cast<double>(sides[1].inwards[axis]) / spacing[axis];
    dot += a * b;
    squaredLengths[0] += a * a;
    squaredLengths[1] += b * b;
  }
  return !(-dot >= leastCosine * std::sqrt(squaredLengths[0] * squaredLengths[1])) || !(dot < 0.0);
}

} // namespace

unsigned int
MedialVoxelWallPoints::SideOf(const MedialVoxelIndex & point) const
{
  std::int64_t twiceProjection = 0;
  std::int64_t squaredLength = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t across = b[axis] - a[axis];
    twiceProjection += 2 * across * (point[axis] - a[axis]);
    squaredLength += across * across;
  }
  return twiceProjection == squaredLength ? 2u : (twiceProjection < squaredLength ? 0u : 1u);
}

MedialVoxelThickness::MedialVoxelThickness(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{
  constexpr double smallestShare = 1.0 / 64;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double spacing = grid.GetSpacing()[axis];
    m_BlockVoxels *= grid.IsActive(axis) ? 3 : 1;
    m_CellVolume *= grid.IsActive(axis) ? spacing : 1.0;
    m_Smallest = grid.IsActive(axis) && (m_Smallest == 0.0 || smallestShare * spacing < m_Smallest)
                   ? smallestShare * spacing
                   : m_Smallest;
  }
}

MedialVoxelWall
MedialVoxelThickness::Measure(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall) const
{
  Side                        sides[2];
  std::array<unsigned int, 8> sideOf;
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    sideOf[corner] = wall.SideOf(wall.corners[corner]);
    if (sideOf[corner] < 2)
    {
      Side & side = sides[sideOf[corner]];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        side.sum[axis] += wall.corners[corner][axis] - wall.a[axis];
      }
      ++side.number;
    }
  }

  const double    numbers[2] = { static_cast<double>(sides[0].number), static_cast<double>(sides[1].number) };
  const auto &    spacing = m_Grid.GetSpacing();
  PositionType    across; // in voxels, times the distance
  double          squaredDistance = 0.0;
  double          longest = 0.0;
  double          extent = 0.0; // of a cell across the wall, times the distance
  MedialVoxelWall measured;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double way =
      (static_cast<double>(sides[1].sum[axis]) / numbers[1] - static_cast<double>(sides[0].sum[axis]) / numbers[0]) *
      spacing[axis];
    across[axis] = way * spacing[axis];
    squaredDistance += way * way;
    extent += std::abs(across[axis]);
    measured.axis = static_cast<std::uint8_t>(std::abs(way) > longest ? axis : measured.axis);
    longest = std::max(longest, std::abs(way));
  }

  const PositionType inwards[2] = { across, { { -across[0], -across[1], -across[2] } } };
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    if (sideOf[corner] < 2)
    {
      Side &          side = sides[sideOf[corner]];
      const BlockType block =
        WithoutOtherWall(this->GetObjectAround(object, wall.corners[corner]), inwards[sideOf[corner]]);
      side.excess += m_BlockVoxels - 2 * MedialVoxelPopulationCount(block);
      AddOffsets(block, side);
    }
  }
  const double distance = std::sqrt(squaredDistance);
  // The block is three voxels long; a share of one half puts the plane through its center.
  const double excess = sides[0].excess / numbers[0] + sides[1].excess / numbers[1];
  const double toFaces = 1.5 * excess / m_BlockVoxels * (GetStep(across) / distance);
  measured.thickness = static_cast<float>(std::max(m_Smallest, distance - toFaces));
  measured.area = static_cast<float>(m_CellVolume * distance / extent);
  measured.isRim = IsRim(sides, spacing);
  return measured;
}

std::uint32_t
MedialVoxelThickness::GetObjectAround(const MedialVoxelBits & object, const MedialVoxelIndex & point) const
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (point[axis] < 1 || point[axis] + 1 >= m_Grid.GetSize()[axis])
    {
      return this->GetAtFaceOfImage(object, point);
    }
  }
  using WordType = MedialVoxelBits::WordType;
  const std::int64_t     x = point[0] - 1;
  const auto             shift = static_cast<unsigned int>(x & (MedialVoxelBits::BitsPerWord - 1));
  const std::int64_t     slicePitch = object.GetBox().Extent(1) * object.GetRowPitch();
  const WordType * const first = object.GetRow(point[1] - 1, point[2] - 1) + ((x >> 6) - object.GetFirstWord());
  WordType               bits = 0;
  for (unsigned int dz = 0; dz < 3; ++dz)
  {
    for (unsigned int dy = 0; dy < 3; ++dy)
    {
      const WordType * const row = first + dz * slicePitch + dy * object.GetRowPitch();
      const WordType         three = (row[0] >> shift) | ((row[1] << 1) << (MedialVoxelBits::BitsPerWord - 1 - shift));
      bits |= (three & 7) << (9 * dz + 3 * dy);
    }
  }
  return static_cast<std::uint32_t>(bits);
}

std::uint32_t
MedialVoxelThickness::GetAtFaceOfImage(const MedialVoxelBits & object, const MedialVoxelIndex & point) const
{
  const MedialVoxelIndex margin = m_Grid.GetUnitMargin();
  const auto             inImage = [&](const unsigned int axis, const std::int64_t offset) {
    return std::clamp<std::int64_t>(point[axis] + offset, 0, m_Grid.GetSize()[axis] - 1);
  };
  std::uint32_t bits = 0;
  for (std::int64_t dz = -margin[2]; dz <= margin[2]; ++dz)
  {
    for (std::int64_t dy = -margin[1]; dy <= margin[1]; ++dy)
    {
      for (std::int64_t dx = -margin[0]; dx <= margin[0]; ++dx)
      {
        const bool isObject = object.Test({ { inImage(0, dx), inImage(1, dy), inImage(2, dz) } });
        bits |= (isObject ? std::uint32_t{ 1 } : 0) << (CenterOfBlock + dx + 3 * dy + 9 * dz);
      }
    }
  }
  return bits;
}

} // end namespace itk
