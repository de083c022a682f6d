// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPairChoice.h"

#include "itkMedialVoxelProcessors.h"

namespace itk
{

namespace
{

/** Cells that are tested together. */
constexpr std::int64_t GroupSize = 16;

/** Displacements from -Limit to Limit - 1 keep the squares of dot products below 2^24, exact in single precision. */
constexpr std::int32_t Limit = 16;

/** Number whose sign bit is set unless -1 <= a - b + corner <= 1, with corner = 1 or -1 the way between two corners.
 * Unsigned, as undefined displacements wrap. */
template <int VCorner>
inline std::uint32_t
Spread(const std::int32_t a, const std::int32_t b)
{
  const std::uint32_t difference = static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b);
  return (difference + static_cast<std::uint32_t>(1 + VCorner)) |
         (static_cast<std::uint32_t>(1 - VCorner) - difference);
}

/** Sign bits of the cells of a group. */
MEDIALVOXEL_PART_OF_THEM inline void
SpreadOfGroup(const MedialVoxelCornerRows & corners,
              const std::int64_t            begin,
              const std::int64_t            numberOfCells,
              std::uint32_t * const         spread)
{
  const std::int32_t * x[4];
  const std::int32_t * y[4];
  const std::int32_t * z[4];
  for (unsigned int row = 0; row < 4; ++row)
  {
    x[row] = corners.rows[0][row] + begin;
    y[row] = corners.rows[1][row] + begin;
    z[row] = corners.rows[2][row] + begin;
  }
  for (std::int64_t i = 0; i < numberOfCells; ++i)
  {
    const std::int64_t  j = i + 1;
    const std::uint32_t alongX = Spread<-1>(x[0][i], x[3][j]) | Spread<1>(x[0][j], x[3][i]) |
                                 Spread<-1>(x[1][i], x[2][j]) | Spread<1>(x[1][j], x[2][i]);
    const std::uint32_t alongY = Spread<-1>(y[0][i], y[3][j]) | Spread<-1>(y[0][j], y[3][i]) |
                                 Spread<1>(y[1][i], y[2][j]) | Spread<1>(y[1][j], y[2][i]);
    const std::uint32_t alongZ = Spread<-1>(z[0][i], z[3][j]) | Spread<-1>(z[0][j], z[3][i]) |
                                 Spread<-1>(z[1][i], z[2][j]) | Spread<-1>(z[1][j], z[2][i]);
    spread[i] = alongX | alongY | alongZ;
  }
}

/** Sign bits of a group side by side, the first one lowest. */
MEDIALVOXEL_PART_OF_THEM inline std::uint64_t
GatherSigns(const std::uint32_t (&numbers)[GroupSize])
{
  static_assert(GroupSize == 16, "two words of bytes");
  std::uint8_t signs[GroupSize];
  for (std::int64_t i = 0; i < GroupSize; ++i)
  {
    signs[i] = static_cast<std::uint8_t>(numbers[i] >> 31);
  }
  // The product moves the lowest bits of eight bytes to the highest byte.
  const auto bitsOf = [](const std::uint8_t * const bytes) {
    std::uint64_t word = 0;
    for (unsigned int i = 0; i < 8; ++i)
    {
      word |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
    }
    return (word * 0x0102040810204080u) >> 56;
  };
  return bitsOf(signs) | (bitsOf(signs + 8) << 8);
}

} // namespace

MEDIALVOXEL_FOR_PROCESSORS std::uint64_t
                           MedialVoxelSpreadCells(const MedialVoxelCornerRows & corners,
                                                  const std::uint64_t           cells,
                                                  const std::int64_t            numberOfCells)
{
  std::uint64_t result = 0;
  for (std::int64_t begin = 0; begin < numberOfCells; begin += GroupSize)
  {
    if (((cells >> begin) & ((std::uint64_t{ 1 } << GroupSize) - 1)) == 0)
    {
      continue;
    }
    std::uint32_t spread[GroupSize] = {};
    if (numberOfCells - begin >= GroupSize)
    {
      // A number of cells that is known beforehand makes a loop without remainder.
      SpreadOfGroup(corners, begin, GroupSize, spread);
    }
    else
    {
      SpreadOfGroup(corners, begin, numberOfCells - begin, spread);
    }
    result |= GatherSigns(spread) << begin;
  }
  return result & cells;
}

int
MedialVoxelWidestDiagonal(const MedialVoxelCornerRows & corners, const std::ptrdiff_t x)
{
  // Twice the way from the center to the boundary points of the corners k, and of their opposites.
  float         a[3][4];
  float         c[3][4];
  std::uint32_t range = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto & rows = corners.rows[axis];
    std::int32_t displacement[8];
    for (unsigned int row = 0; row < 4; ++row)
    {
      displacement[2 * row] = rows[row][x];
      displacement[2 * row + 1] = rows[row][x + 1];
    }
    for (unsigned int k = 0; k < 4; ++k)
    {
      const std::int32_t corner = static_cast<std::int32_t>((k >> axis) & 1u);
      const std::int32_t first = displacement[k];
      const std::int32_t second = displacement[7 - k];
      range |= static_cast<std::uint32_t>(first) + Limit;
      range |= static_cast<std::uint32_t>(second) + Limit;
      a[axis][k] = static_cast<float>(2 * corner - 1) + 2.0F * static_cast<float>(first);
      c[axis][k] = static_cast<float>(1 - 2 * corner) + 2.0F * static_cast<float>(second);
    }
  }
  if (range >= 2 * Limit)
  {
    return -1;
  }
  float numerator[4];
  float denominator[4];
  for (unsigned int k = 0; k < 4; ++k)
  {
    const float dot = a[0][k] * c[0][k] + a[1][k] * c[1][k] + a[2][k] * c[2][k];
    numerator[k] = dot * (dot < 0.0F ? -dot : dot);
    denominator[k] = (a[0][k] * a[0][k] + a[1][k] * a[1][k] + a[2][k] * a[2][k]) *
                     (c[0][k] * c[0][k] + c[1][k] * c[1][k] + c[2][k] * c[2][k]);
  }
  // Fractions of such small numbers are equal in double precision only when they are equal. Pairs first, without jumps:
  // which one wins cannot be foreseen.
  const auto isWider = [&](const unsigned int k, const unsigned int than) {
    return static_cast<double>(numerator[k]) * static_cast<double>(denominator[than]) <
           static_cast<double>(numerator[than]) * static_cast<double>(denominator[k]);
  };
  const unsigned int lower = static_cast<unsigned int>(isWider(1, 0));
  const unsigned int upper = 2 + static_cast<unsigned int>(isWider(3, 2));
  return static_cast<int>(isWider(upper, lower) ? upper : lower);
}

} // end namespace itk
