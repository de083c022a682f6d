// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelThickness.h"

#include "itkMedialVoxelBlockSums.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using namespace MedialVoxelBlockSums;

using PositionType = std::array<double, 3>;

/** Sums over the boundary points of one side of a wall. */
struct Side
{
  Side() = default;

  Side(const std::int64_t numberOfPoints, PackedSums sums, const int blockVoxels)
  {
    for (std::int64_t & sum : inwards)
    {
      sum = TakeLowest(sums);
    }
    excess = numberOfPoints * blockVoxels - 2 * sums;
  }

  std::int64_t     excess{ 0 }; // of background over object voxels around the points
  MedialVoxelIndex inwards{};   // sum of the offsets of the object voxels
};

/** Pairs of opposite offsets: their bits are as far above and below the bit of the center. */
constexpr unsigned int NumberOfOffsetPairs = 13;

/** Products of \a inwards with the offsets that are higher than the center. */
std::array<double, NumberOfOffsetPairs>
ProjectOffsets(const PositionType & inwards)
{
  const auto & [x, y, z] = inwards;
  const double                            inSlice[9] = { -x - y, -y, x - y, -x, 0.0, x, y - x, y, x + y };
  std::array<double, NumberOfOffsetPairs> projections{ { x, inSlice[6], y, inSlice[8] } };
  for (unsigned int bit = 0; bit < BitsOfSlice; ++bit)
  {
    projections[4 + bit] = inSlice[bit] + z;
  }
  return projections;
}

/** Offsets that lead out of a wall by more than a quarter of a voxel.
 *
 * \param inwards  normal of the wall in voxels, of any length, towards its inside */
BlockType
OffsetsOutOf(const PositionType & inwards)
{
  const double slack = 0.25 * std::sqrt(inwards[0] * inwards[0] + inwards[1] * inwards[1] + inwards[2] * inwards[2]);
  const auto   projections = ProjectOffsets(inwards);
  BlockType    upper = 0;
  BlockType    lower = 0;
  // Opposite offsets have the opposite sign.
  for (unsigned int i = 0; i < NumberOfOffsetPairs; ++i)
  {
    upper |= (projections[i] < -slack ? BlockType{ 1 } : 0) << i;
    lower |= (projections[i] > slack ? BlockType{ 1 } : 0) << (NumberOfOffsetPairs - 1 - i);
  }
  return upper << (CenterOfBlock + 1) | lower;
}

/** Growth of the distance of a plane from the center of a block of 3 voxels, for each third of the block that it cuts
 * off, near the center: the inverse of the area of a unit cube's section.
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
AreUnpaired(const Side (&sides)[2], const MedialVoxelGrid::SpacingType & spacing)
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

/** The lowest three bits that \a extract(row) has of each row of a block. */
template <typename TExtract>
BlockType
GatherRows(const MedialVoxelBits::WordType * const first,
           const std::int64_t                      slicePitch,
           const std::int64_t                      rowPitch,
           TExtract &&                             extract)
{
  BlockType bits = 0;
  for (unsigned int dz = 0; dz < 3; ++dz)
  {
    for (unsigned int dy = 0; dy < 3; ++dy)
    {
      bits |= static_cast<BlockType>(extract(first + dz * slicePitch + dy * rowPitch) & 7) << (9 * dz + 3 * dy);
    }
  }
  return bits;
}

/** Whether the surfaces at both points of a pair lean by more than 21.8 degrees (a tangent of 0.4) to the same side.
 *
 * \param sums  of the blocks, see SumsOf() */
bool
LeanTheSameWay(PackedSums sumsOfA, PackedSums sumsOfB)
{
  std::int64_t along = 0;
  std::int64_t across = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t a = TakeLowest(sumsOfA);
    const std::int64_t b = TakeLowest(sumsOfB);
    along += (a + b) * (a + b);
    across += (a - b) * (a - b);
  }
  return 25 * along > 4 * across;
}

} // namespace

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

struct MedialVoxelThickness::SidePair
{
  Side                  sides[2];
  std::array<double, 2> numbers;      // of points
  PositionType          displacement; // from the mean of one side to that of the other
  PositionType          across;       // in voxels, times the distance
  double                distance;
  double                step; // of Direction
};

/** The block around a point, from \a memory when it is there. */
auto
MedialVoxelThickness::RecallBlock(const MedialVoxelBits & object, const MedialVoxelIndex & point, Memory & memory) const
  -> const Block &
{
  constexpr std::uint64_t goldenRatio = 0x9E3779B97F4A7C15u;
  const std::size_t       number = object.GetBox().OffsetOf(point) + 1;
  Memory::Place &         place = memory.m_Places[(number * goldenRatio) >> (64 - Memory::BitsOfPlace)];
  if (place.number != number)
  {
    place.number = number;
    place.block = this->GetBlock(object, point);
  }
  return place.block;
}

auto
MedialVoxelThickness::GetBlock(const MedialVoxelBits & object, const MedialVoxelIndex & point) const -> Block
{
  Block block;
  block.voxels = this->GetObjectAround(object, point);
  block.opposite = block.voxels & Mirror(block.voxels);
  block.sums = SumsOf(block.voxels);
  return block;
}

void
MedialVoxelThickness::FindOffsetsOut(Direction & direction)
{
  direction.out[0] = OffsetsOutOf(direction.across);
  direction.out[1] = Mirror(direction.out[0]);
  direction.knowsOut = true;
}

/** In thin walls the blocks of points beside a rim reach over it: both surfaces seem to lean to the same side there.
 * The points of these pairs belong to no side, unless all pairs are like that. */
template <typename TBlockAt>
auto
MedialVoxelThickness::FindSidesWithoutEdges(const MedialVoxelWallPoints & wall, TBlockAt && blockAt)
  -> MedialVoxelWallPoints::SidesType
{
  const MedialVoxelWallPoints::SidesType sideOf = wall.GetSides();
  if (!wall.IsThin())
  {
    return sideOf;
  }
  const unsigned int               bit = wall.GetBitOfPairs(sideOf);
  MedialVoxelWallPoints::SidesType kept = sideOf;
  bool                             isAnyKept = false;
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    const unsigned int partner = corner ^ bit;
    if (corner < partner && sideOf[corner] + sideOf[partner] == 1)
    {
      // A copy, because the next one may take its place.
      const Block   block = blockAt(wall.corners[corner]);
      const Block & other = blockAt(wall.corners[partner]);
      if (block.opposite == 0 && other.opposite == 0 && LeanTheSameWay(block.sums, other.sums))
      {
        kept[corner] = kept[partner] = 2;
      }
      isAnyKept = isAnyKept || kept[corner] != 2;
    }
  }
  return isAnyKept ? kept : sideOf;
}

template <typename TBlockAt>
auto
MedialVoxelThickness::FindSides(const MedialVoxelWallPoints &            wall,
                                const MedialVoxelWallPoints::SidesType & sideOf,
                                Direction &                              direction,
                                TBlockAt &&                              blockAt) const -> SidePair
{
  MedialVoxelIndex positions[2] = {}; // sums of them, seen from a
  std::int64_t     numbersOfPoints[2] = {};
  PackedSums       sums[2] = {};
  unsigned int     doubtful = 0; // corners that may see another wall
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    const std::int64_t side = sideOf[corner];
    if (side == 2)
    {
      continue;
    }
    const MedialVoxelIndex & point = wall.corners[corner];
    const Block &            block = blockAt(point);
    doubtful |= (block.opposite != 0 ? 1u : 0u) << corner;
    // Without jumps: which side it is cannot be foreseen.
    const std::int64_t masks[2] = { side - 1, -side };
    for (unsigned int i = 0; i < 2; ++i)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        positions[i][axis] += (point[axis] - wall.a[axis]) & masks[i];
      }
      numbersOfPoints[i] -= masks[i];
      sums[i] += block.sums & masks[i];
    }
  }

  SidePair pair;
  pair.numbers = { { static_cast<double>(numbersOfPoints[0]), static_cast<double>(numbersOfPoints[1]) } };
  const auto & spacing = m_Grid.GetSpacing();
  double       squaredDistance = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double displacement = (static_cast<double>(positions[1][axis]) / pair.numbers[1] -
                                 static_cast<double>(positions[0][axis]) / pair.numbers[0]) *
                                spacing[axis];
    pair.displacement[axis] = displacement;
    pair.across[axis] = displacement * spacing[axis];
    squaredDistance += displacement * displacement;
  }
  pair.distance = std::sqrt(squaredDistance);

  // Walls side by side often have the same.
  if (pair.across != direction.across)
  {
    direction.across = pair.across;
    direction.step = GetStep(pair.across);
    direction.knowsOut = false;
  }
  pair.step = direction.step;
  for (; doubtful != 0; doubtful &= doubtful - 1)
  {
    const auto corner = static_cast<unsigned int>(MedialVoxelLowestBit(doubtful));
    const auto side = sideOf[corner];
    if (!direction.knowsOut)
    {
      FindOffsetsOut(direction);
    }
    // Voxels of another wall behind a narrow gap: out of the wall, with one at the opposite offset.
    const Block &   block = blockAt(wall.corners[corner]);
    const BlockType ofOtherWall = block.opposite & direction.out[side];
    const BlockType voxels = block.voxels & ~ofOtherWall;
    sums[side] += SumsOf(voxels) - block.sums;
  }
  for (unsigned int side = 0; side < 2; ++side)
  {
    pair.sides[side] = { numbersOfPoints[side], sums[side], m_BlockVoxels };
  }
  return pair;
}

float
MedialVoxelThickness::ThicknessOf(const SidePair & pair) const
{
  // The block is three voxels long; a share of one half puts the plane through its center.
  const double excess = static_cast<double>(pair.sides[0].excess) / pair.numbers[0] +
                        static_cast<double>(pair.sides[1].excess) / pair.numbers[1];
  const double toFaces = 1.5 * excess / m_BlockVoxels * (pair.step / pair.distance);
  return static_cast<float>(std::max(m_Smallest, pair.distance - toFaces));
}

/** Points on the end of a wall mark it as unpaired and do not count for its thickness. */
template <typename TBlockAt>
MedialVoxelWall
MedialVoxelThickness::MeasureWall(const MedialVoxelWallPoints & wall, Direction & direction, TBlockAt && blockAt) const
{
  const auto      sideOf = FindSidesWithoutEdges(wall, blockAt);
  const auto      nearerSideOf = wall.GetNearerSides();
  const SidePair  pair = this->FindSides(wall, sideOf, direction, blockAt);
  MedialVoxelWall measured;
  double          longest = 0.0;
  double          extent = 0.0; // of a cell across the wall, times the distance
  const auto &    across = pair.across;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double displacement = pair.displacement[axis];
    extent += std::abs(across[axis]);
    measured.axis = static_cast<std::uint8_t>(std::abs(displacement) > longest ? axis : measured.axis);
    longest = std::max(longest, std::abs(displacement));
  }
  const auto & spacing = m_Grid.GetSpacing();
  measured.thickness = this->ThicknessOf(pair);
  measured.area = static_cast<float>(m_CellVolume * pair.distance / extent);
  measured.isUnpaired = sideOf == nearerSideOf
                          ? AreUnpaired(pair.sides, spacing)
                          : AreUnpaired(this->FindSides(wall, nearerSideOf, direction, blockAt).sides, spacing);
  return measured;
}

MedialVoxelWall
MedialVoxelThickness::Measure(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall) const
{
  Direction direction;
  return this->MeasureWall(
    wall, direction, [&](const MedialVoxelIndex & point) { return this->GetBlock(object, point); });
}

MedialVoxelWall
MedialVoxelThickness::Measure(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall, Memory & memory) const
{
  return this->MeasureWall(wall, memory.m_Direction, [&](const MedialVoxelIndex & point) -> const Block & {
    return this->RecallBlock(object, point, memory);
  });
}

float
MedialVoxelThickness::MeasureThickness(const MedialVoxelBits &       object,
                                       const MedialVoxelWallPoints & wall,
                                       Memory &                      memory) const
{
  const auto blockAt = [&](const MedialVoxelIndex & point) -> const Block & {
    return this->RecallBlock(object, point, memory);
  };
  return this->ThicknessOf(this->FindSides(wall, wall.GetNearerSides(), memory.m_Direction, blockAt));
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
  // Rarely do the voxels lie in two words of their rows.
  return shift + 3 <= MedialVoxelBits::BitsPerWord
           ? GatherRows(
               first, slicePitch, object.GetRowPitch(), [=](const WordType * const row) { return *row >> shift; })
           : GatherRows(first, slicePitch, object.GetRowPitch(), [=](const WordType * const row) {
               return (row[0] >> shift) | ((row[1] << 1) << (MedialVoxelBits::BitsPerWord - 1 - shift));
             });
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
