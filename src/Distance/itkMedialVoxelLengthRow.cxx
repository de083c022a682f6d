// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLengthRow.h"

#include "itkMedialVoxelProcessors.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSquaredLengths.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace itk
{

namespace
{

/** Voxels of one vector, more or less. */
constexpr std::int64_t Columns = 32;

/** Squares below which floats hold all whole numbers. Their float root is the rounded root of doubles, which have more
 * than twice as many digits. */
constexpr std::int32_t EndOfFloats = 1 << 24;

/** Spacings whose squares, times any number of voxels, are ordinary floats. */
constexpr double SmallestSpacing = 1e-15;
constexpr double LargestSpacing = 1e13;

constexpr std::uint32_t SignBit = std::uint32_t{ 1 } << 31;

std::uint32_t
GetBits(const float value)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

/** Signed lengths of whole groups of columns, computed with numbers of a type. */
template <typename TReal, bool VIsSquared>
MEDIALVOXEL_INLINE void
WriteGroups(const std::int32_t * squares,
            const std::int64_t   groups,
            std::uint64_t        negatives,
            const TReal          squaredSpacing,
            float *              target)
{
  const std::uint32_t none = GetBits(std::numeric_limits<float>::quiet_NaN());
  for (std::int64_t group = 0; group < groups; ++group, squares += Columns, target += Columns, negatives >>= Columns)
  {
    // Roots first, then bits alone: no vector decides about a number that may be an error.
    float lengths[Columns];
    for (std::int64_t column = 0; column < Columns; ++column)
    {
      const TReal square = static_cast<TReal>(squares[column]) * squaredSpacing;
      lengths[column] = static_cast<float>(VIsSquared ? square : std::sqrt(square));
    }
    const auto    own = static_cast<std::uint32_t>(negatives);
    std::uint32_t bits[Columns];
    std::memcpy(bits, lengths, sizeof(bits));
    for (std::int64_t column = 0; column < Columns; ++column)
    {
      const std::int32_t  square = squares[column];
      const std::uint32_t sign = (own << (31 - column)) & SignBit;
      const std::uint32_t length = bits[column] ^ (square == 0 ? 0 : sign);
      bits[column] = square < MedialVoxelSquaredLengths::None ? length : none;
    }
    std::memcpy(target, bits, sizeof(bits));
  }
}

/** True when one of \a number squares is not exact in floats, but a length. */
MEDIALVOXEL_INLINE bool
HasLarge(const std::int32_t * const squares, const std::int64_t number)
{
  std::int32_t largest = 0;
  for (std::int64_t i = 0; i < number; ++i)
  {
    const std::int32_t square = squares[i];
    const std::int32_t length = square < MedialVoxelSquaredLengths::None ? square : 0;
    largest = std::max(largest, length);
  }
  return largest >= EndOfFloats;
}

bool
IsPowerOfTwo(const double value)
{
  int exponent = 0;
  return std::frexp(value, &exponent) == 0.5;
}

} // namespace

bool
MedialVoxelLengthRow::HasExactLengths(const double spacing)
{
  // Three squares of so many digits, times the digits of the largest image size, fit a double.
  constexpr double digits = 1 << 11;
  int              exponent = 0;
  const double     whole = std::frexp(spacing, &exponent) * digits;
  return whole == std::floor(whole) && spacing > SmallestSpacing && spacing < LargestSpacing;
}

void
MedialVoxelLengthRow::AppendDoubtful(const double                spacing,
                                     const std::int32_t          begin,
                                     const std::int32_t          end,
                                     std::vector<std::int32_t> & squares)
{
  // More than the rounding of both computations together, at most five and a half half units.
  constexpr double        error = 4.0 * std::numeric_limits<double>::epsilon();
  MedialVoxelAbortChecker checker;
  for (std::int32_t square = begin; square < end; ++square)
  {
    checker.Count();
    const double length = std::sqrt(static_cast<double>(square) * (spacing * spacing));
    if (static_cast<float>(length * (1.0 - error)) != static_cast<float>(length * (1.0 + error)))
    {
      squares.push_back(square);
    }
  }
}

MedialVoxelLengthRow::MedialVoxelLengthRow(const double spacing, const bool squared)
  : m_SquaredSpacing(spacing * spacing)
  , m_IsSquared(squared)
  , m_FitsFloats(IsPowerOfTwo(spacing) && spacing > SmallestSpacing && spacing < LargestSpacing)
{}

void
MedialVoxelLengthRow::Write(const std::int32_t * const squares,
                            const std::int64_t         number,
                            const std::uint64_t        negatives,
                            float * const              target) const
{
  const std::int64_t groups = number / Columns;
  const std::int64_t rest = number % Columns;
  if (rest > 0)
  {
    std::int32_t lastSquares[Columns] = {};
    float        last[Columns];
    std::copy_n(squares + groups * Columns, rest, lastSquares);
    this->Write(lastSquares, Columns, negatives >> (groups * Columns), last);
    std::copy_n(last, rest, target + groups * Columns);
  }
  if (m_IsSquared)
  {
    MedialVoxelKernel<WriteGroups<double, true>>::Run(squares, groups, negatives, m_SquaredSpacing, target);
  }
  else if (m_FitsFloats && !MedialVoxelKernel<HasLarge>::Run(squares, groups * Columns))
  {
    MedialVoxelKernel<WriteGroups<float, false>>::Run(
      squares, groups, negatives, static_cast<float>(m_SquaredSpacing), target);
  }
  else
  {
    MedialVoxelKernel<WriteGroups<double, false>>::Run(squares, groups, negatives, m_SquaredSpacing, target);
  }
}

} // end namespace itk
