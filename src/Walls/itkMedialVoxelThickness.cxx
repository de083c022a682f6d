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

/** What a slice of nine voxels of a block adds. Tables are faster than counting bits. */
struct Slice
{
  BlockType     mirrored{ 0 }; // the bits in reverse order
  std::uint32_t number{ 0 };   // of object voxels
  std::int32_t  x{ 0 };        // sums of the offsets of the object voxels
  std::int32_t  y{ 0 };
};

constexpr unsigned int BitsOfSlice = 9;
constexpr BlockType    SliceMask = (BlockType{ 1 } << BitsOfSlice) - 1;

constexpr std::array<Slice, SliceMask + 1>
MakeSlices()
{
  std::array<Slice, SliceMask + 1> slices{};
  for (BlockType bits = 0; bits <= SliceMask; ++bits)
  {
    for (unsigned int bit = 0; bit < BitsOfSlice; ++bit)
    {
      if (((bits >> bit) & 1u) != 0)
      {
        slices[bits].mirrored |= BlockType{ 1 } << (BitsOfSlice - 1 - bit);
        slices[bits].number += 1;
        slices[bits].x += static_cast<std::int32_t>(bit % 3) - 1;
        slices[bits].y += static_cast<std::int32_t>(bit / 3) - 1;
      }
    }
  }
  return slices;
}

constexpr std::array<Slice, SliceMask + 1> Slices = MakeSlices();

const Slice &
SliceOf(const BlockType block, const unsigned int z)
{
  return Slices[(block >> (z * BitsOfSlice)) & SliceMask];
}

/** The voxels at the opposite offsets: the bits in reverse order. */
BlockType
Mirror(const BlockType block)
{
  return SliceOf(block, 2).mirrored | (SliceOf(block, 1).mirrored << BitsOfSlice) |
         (SliceOf(block, 0).mirrored << (2 * BitsOfSlice));
}

/** Sums over the boundary points of one side of a wall. */
struct Side
{
  MedialVoxelIndex sum{ { 0, 0, 0 } }; // of the positions, seen from a
  int              number{ 0 };
  int              excess{ 0 };              // of background over object voxels around the points
  std::int64_t     inwards[3] = { 0, 0, 0 }; // sum of the offsets of the object voxels
};

/** Offsets that lead out of a wall by more than a quarter of a voxel.
 *
 * \param inwards  normal of the wall in voxels, of any length, towards its inside */
BlockType
OffsetsOutOf(const PositionType & inwards)
{
  const double slack = 0.25 * std::sqrt(inwards[0] * inwards[0] + inwards[1] * inwards[1] + inwards[2] * inwards[2]);
  BlockType    out = 0;
  // Opposite offsets lead as far the other way.
  for (int bit = CenterOfBlock + 1; bit <= 2 * CenterOfBlock; ++bit)
  {
    const double along = inwards[0] * (bit % 3 - 1) + inwards[1] * (bit / 3 % 3 - 1) + inwards[2] * (bit / 9 - 1);
    out |= (along < -slack ? BlockType{ 1 } : 0) << bit;
    out |= (along > slack ? BlockType{ 1 } : 0) << (2 * CenterOfBlock - bit);
  }
  return out;
}

/** Leaves out the voxels of another wall behind a narrow gap: those out of the wall with one at the opposite offset. */
BlockType
WithoutOtherWall(const BlockType block, const BlockType out)
{
  return block & ~(Mirror(block) & out);
}

/** Adds the object voxels around a point. */
void
AddBlock(const BlockType block, const int blockVoxels, Side & side)
{
  const Slice & lower = SliceOf(block, 0);
  const Slice & middle = SliceOf(block, 1);
  const Slice & upper = SliceOf(block, 2);
  side.excess += blockVoxels - 2 * static_cast<int>(lower.number + middle.number + upper.number);
  side.inwards[0] += lower.x + middle.x + upper.x;
  side.inwards[1] += lower.y + middle.y + upper.y;
  side.inwards[2] += static_cast<std::int64_t>(upper.number) - static_cast<std::int64_t>(lower.number);
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

  const BlockType out = OffsetsOutOf(across);
  const BlockType outOf[2] = { out, Mirror(out) };
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    if (sideOf[corner] < 2)
    {
      const BlockType block = this->GetObjectAround(object, wall.corners[corner]);
      AddBlock(WithoutOtherWall(block, outOf[sideOf[corner]]), m_BlockVoxels, sides[sideOf[corner]]);
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
