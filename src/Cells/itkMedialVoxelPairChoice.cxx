// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPairChoice.h"

#include "itkMedialVoxelProcessors.h"

#include <algorithm>

namespace itk
{

namespace
{

/** Cells that are tested together. */
constexpr std::int64_t GroupSize = 16;

/** Cells whose diagonals are compared together; a thin wall has few. */
constexpr std::int64_t ChoiceSize = 8;

/** Displacements from -Limit to Limit - 1 keep the squares of dot products below 2^24, exact in single precision. */
constexpr std::int32_t Limit = 16;

/** Number whose sign bit is set unless -1 <= a - b + corner <= 1, with corner = 1 or -1 the offset between two corners.
 * Unsigned, because undefined displacements wrap. */
template <int VCorner>
inline std::uint32_t
NontrivialSign(const std::int32_t a, const std::int32_t b)
{
  const std::uint32_t difference = static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b);
  return (difference + static_cast<std::uint32_t>(1 + VCorner)) |
         (static_cast<std::uint32_t>(1 - VCorner) - difference);
}

/** Sign bits of the cells of a group. */
MEDIALVOXEL_INLINE void
NontrivialOfGroup(const MedialVoxelCornerRows & corners,
                  const std::int64_t            begin,
                  const std::int64_t            numberOfCells,
                  std::uint32_t * const         nontrivial)
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
    const std::uint32_t alongX = NontrivialSign<-1>(x[0][i], x[3][j]) | NontrivialSign<1>(x[0][j], x[3][i]) |
                                 NontrivialSign<-1>(x[1][i], x[2][j]) | NontrivialSign<1>(x[1][j], x[2][i]);
    const std::uint32_t alongY = NontrivialSign<-1>(y[0][i], y[3][j]) | NontrivialSign<-1>(y[0][j], y[3][i]) |
                                 NontrivialSign<1>(y[1][i], y[2][j]) | NontrivialSign<1>(y[1][j], y[2][i]);
    const std::uint32_t alongZ = NontrivialSign<-1>(z[0][i], z[3][j]) | NontrivialSign<-1>(z[0][j], z[3][i]) |
                                 NontrivialSign<-1>(z[1][i], z[2][j]) | NontrivialSign<-1>(z[1][j], z[2][i]);
    nontrivial[i] = alongX | alongY | alongZ;
  }
}

/** Sign bits of a group side by side, the first one lowest. */
MEDIALVOXEL_INLINE std::uint64_t
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

/** For the diagonals of the cells of a group: the squared cosine with the sign of the cosine, as a fraction. */
struct Fractions
{
  float numerator[4][ChoiceSize];
  float denominator[4][ChoiceSize];

  /** Not below 2 * Limit when a displacement is too long. */
  std::uint32_t range[ChoiceSize];
};

/** The fractions of a diagonal from the corner VCorner, which has the lower number. */
template <unsigned int VCorner>
MEDIALVOXEL_INLINE void
AddFractions(const MedialVoxelCornerRows & corners,
             const std::int64_t            begin,
             const std::int64_t            numberOfCells,
             Fractions &                   fractions)
{
  constexpr unsigned int     row = VCorner >> 1;
  constexpr float            stepX = (VCorner & 1u) != 0 ? 1.0F : -1.0F;
  constexpr float            stepY = (VCorner & 2u) != 0 ? 1.0F : -1.0F;
  const std::int64_t         first = begin + static_cast<std::int64_t>(VCorner & 1u);
  const std::int64_t         second = begin + static_cast<std::int64_t>(~VCorner & 1u);
  const std::int32_t * const x[2] = { corners.rows[0][row] + first, corners.rows[0][3 - row] + second };
  const std::int32_t * const y[2] = { corners.rows[1][row] + first, corners.rows[1][3 - row] + second };
  const std::int32_t * const z[2] = { corners.rows[2][row] + first, corners.rows[2][3 - row] + second };
  const auto shifted = [](const std::int32_t steps) { return static_cast<std::uint32_t>(steps) + Limit; };
  for (std::int64_t i = 0; i < numberOfCells; ++i)
  {
    // Twice the vectors from the center to the boundary points.
    const float ax = stepX + 2.0F * static_cast<float>(x[0][i]);
    const float ay = stepY + 2.0F * static_cast<float>(y[0][i]);
    const float az = -1.0F + 2.0F * static_cast<float>(z[0][i]);
    const float cx = -stepX + 2.0F * static_cast<float>(x[1][i]);
    const float cy = -stepY + 2.0F * static_cast<float>(y[1][i]);
    const float cz = 1.0F + 2.0F * static_cast<float>(z[1][i]);
    const float dot = ax * cx + ay * cy + az * cz;
    fractions.numerator[VCorner][i] = dot * (dot < 0.0F ? -dot : dot);
    fractions.denominator[VCorner][i] = (ax * ax + ay * ay + az * az) * (cx * cx + cy * cy + cz * cz);
    fractions.range[i] |=
      shifted(x[0][i]) | shifted(y[0][i]) | shifted(z[0][i]) | shifted(x[1][i]) | shifted(y[1][i]) | shifted(z[1][i]);
  }
}

/** The first of the smallest fractions of each cell of a group. */
MEDIALVOXEL_INLINE void
WidestOfGroup(const MedialVoxelCornerRows & corners,
              const std::int64_t            begin,
              const std::int64_t            numberOfCells,
              std::int8_t * const           widest)
{
  Fractions fractions;
  std::fill(fractions.range, fractions.range + ChoiceSize, 0u);
  AddFractions<0>(corners, begin, numberOfCells, fractions);
  AddFractions<1>(corners, begin, numberOfCells, fractions);
  AddFractions<2>(corners, begin, numberOfCells, fractions);
  AddFractions<3>(corners, begin, numberOfCells, fractions);
  const auto & numerator = fractions.numerator;
  const auto & denominator = fractions.denominator;
  double       numbers[ChoiceSize];
  for (std::int64_t i = 0; i < numberOfCells; ++i)
  {
    // Fractions of small numbers that are equal in double precision are equal. Pairs first, in one type for long
    // vectors, and without jumps, because the winner cannot be predicted.
    const double n[4] = { numerator[0][i], numerator[1][i], numerator[2][i], numerator[3][i] };
    const double d[4] = { denominator[0][i], denominator[1][i], denominator[2][i], denominator[3][i] };
    const double lowerN = n[1] * d[0] < n[0] * d[1] ? n[1] : n[0];
    const double lowerD = n[1] * d[0] < n[0] * d[1] ? d[1] : d[0];
    const double lower = n[1] * d[0] < n[0] * d[1] ? 1.0 : 0.0;
    const double upperN = n[3] * d[2] < n[2] * d[3] ? n[3] : n[2];
    const double upperD = n[3] * d[2] < n[2] * d[3] ? d[3] : d[2];
    const double upper = n[3] * d[2] < n[2] * d[3] ? 3.0 : 2.0;
    numbers[i] = upperN * lowerD < lowerN * upperD ? upper : lower;
  }
  for (std::int64_t i = 0; i < numberOfCells; ++i)
  {
    widest[i] = static_cast<std::int8_t>(fractions.range[i] < 2 * Limit ? static_cast<std::int32_t>(numbers[i]) : -1);
  }
}

MEDIALVOXEL_INLINE std::uint64_t
FindNontrivial(const MedialVoxelCornerRows & corners, const std::uint64_t cells, const std::int64_t numberOfCells)
{
  std::uint64_t result = 0;
  for (std::int64_t begin = 0; begin < numberOfCells; begin += GroupSize)
  {
    if (((cells >> begin) & ((std::uint64_t{ 1 } << GroupSize) - 1)) == 0)
    {
      continue;
    }
    std::uint32_t nontrivial[GroupSize] = {};
    if (numberOfCells - begin >= GroupSize)
    {
      // A constant number of cells makes a loop without remainder.
      NontrivialOfGroup(corners, begin, GroupSize, nontrivial);
    }
    else
    {
      NontrivialOfGroup(corners, begin, numberOfCells - begin, nontrivial);
    }
    result |= GatherSigns(nontrivial) << begin;
  }
  return result & cells;
}

MEDIALVOXEL_INLINE void
FindWidest(const MedialVoxelCornerRows & corners,
           const std::uint64_t           cells,
           const std::int64_t            numberOfCells,
           std::int8_t * const           widest)
{
  for (std::int64_t begin = 0; begin < numberOfCells; begin += ChoiceSize)
  {
    if (((cells >> begin) & ((std::uint64_t{ 1 } << ChoiceSize) - 1)) == 0)
    {
      continue;
    }
    if (numberOfCells - begin >= ChoiceSize)
    {
      WidestOfGroup(corners, begin, ChoiceSize, widest + begin);
    }
    else
    {
      WidestOfGroup(corners, begin, numberOfCells - begin, widest + begin);
    }
  }
}

} // namespace

std::uint64_t
MedialVoxelNontrivialCells(const MedialVoxelCornerRows & corners,
                           const std::uint64_t           cells,
                           const std::int64_t            numberOfCells)
{
  return MedialVoxelKernel<FindNontrivial>::Run(corners, cells, numberOfCells);
}

void
MedialVoxelWidestDiagonals(const MedialVoxelCornerRows & corners,
                           const std::uint64_t           cells,
                           const std::int64_t            numberOfCells,
                           std::int8_t * const           widest)
{
  MedialVoxelKernel<FindWidest>::Run(corners, cells, numberOfCells, widest);
}

} // end namespace itk
