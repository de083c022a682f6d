// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBlockSums_h
#define itkMedialVoxelBlockSums_h

// The 27 voxels around a point as bits, and the sums of their offsets.

#include <array>
#include <cstdint>

namespace itk
{

namespace MedialVoxelBlockSums
{

using BlockType = std::uint32_t; // the 3^3 voxels around a point, see GetObjectAround()

constexpr int CenterOfBlock = 13;

constexpr unsigned int BitsOfSlice = 9;
constexpr BlockType    SliceMask = (BlockType{ 1 } << BitsOfSlice) - 1;

/** Sums of object voxels and of their offsets along the axes, side by side in one number, so that they are added at
 * once. */
using PackedSums = std::int64_t;

/** Enough for the blocks around eight points. */
constexpr unsigned int BitsOfSum = 16;

constexpr PackedSums
PackSums(const std::int64_t number, const std::int64_t x, const std::int64_t y, const std::int64_t z)
{
  constexpr std::int64_t factor = std::int64_t{ 1 } << BitsOfSum;
  return ((number * factor + z) * factor + y) * factor + x;
}

/** The sum in the lowest place of \a sums, which loses it. */
inline std::int64_t
TakeLowest(PackedSums & sums)
{
  const std::int64_t lowest = static_cast<std::int16_t>(sums & 0xFFFF);
  sums = (sums - lowest) >> BitsOfSum;
  return lowest;
}

/** The contribution of a slice of nine voxels of a block. Tables are faster than counting bits. */
struct Slices
{
  std::array<std::array<PackedSums, SliceMask + 1>, 3> sums{};     // of each slice of a block
  std::array<std::uint16_t, SliceMask + 1>             mirrored{}; // the bits in reverse order
};

constexpr Slices
MakeSlices()
{
  Slices slices{};
  for (BlockType bits = 0; bits <= SliceMask; ++bits)
  {
    for (unsigned int bit = 0; bit < BitsOfSlice; ++bit)
    {
      if (((bits >> bit) & 1u) != 0)
      {
        slices.mirrored[bits] = static_cast<std::uint16_t>(slices.mirrored[bits] | 1u << (BitsOfSlice - 1 - bit));
        for (unsigned int z = 0; z < 3; ++z)
        {
          slices.sums[z][bits] += PackSums(1,
                                           static_cast<std::int64_t>(bit % 3) - 1,
                                           static_cast<std::int64_t>(bit / 3) - 1,
                                           static_cast<std::int64_t>(z) - 1);
        }
      }
    }
  }
  return slices;
}

inline constexpr Slices SliceTable = MakeSlices();

inline BlockType
SliceOf(const BlockType block, const unsigned int z)
{
  return (block >> (z * BitsOfSlice)) & SliceMask;
}

/** The voxels at the opposite offsets: the bits in reverse order. */
inline BlockType
Mirror(const BlockType block)
{
  const auto & mirrored = SliceTable.mirrored;
  return mirrored[SliceOf(block, 2)] | (BlockType{ mirrored[SliceOf(block, 1)] } << BitsOfSlice) |
         (BlockType{ mirrored[SliceOf(block, 0)] } << (2 * BitsOfSlice));
}

inline PackedSums
SumsOf(const BlockType block)
{
  const auto & sums = SliceTable.sums;
  return sums[0][SliceOf(block, 0)] + sums[1][SliceOf(block, 1)] + sums[2][SliceOf(block, 2)];
}

} // namespace MedialVoxelBlockSums

} // end namespace itk

#endif
