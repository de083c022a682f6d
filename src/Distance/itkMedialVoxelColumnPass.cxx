// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelColumnPass.h"

#include "itkMedialVoxelLanes.h"
#include "itkMedialVoxelReserve.h"
#include "itkMedialVoxelSquaredLengths.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace itk
{

namespace
{

/** Columns whose winners are searched together: neighbors mostly have the same ones. */
constexpr std::int64_t Lanes = 8;

/** Rows that look between the same two winners. */
constexpr std::int64_t BlockSize = 8;

/** Candidates of a row that are not worth a bound. */
constexpr std::int64_t FewRows = 16;

constexpr std::int64_t Columns = MedialVoxelColumnPass::Columns;

/** Values that are added and compared at once. */
using Vector = MedialVoxelLanesOf<std::int32_t, Lanes>;

/** Some columns, and the winners of every so many rows that are known. */
struct Pass
{
  const std::int32_t * costs;
  std::int64_t         length;
  std::int64_t         first;
  std::int64_t         number;
  std::int32_t *       lowest;
  std::int32_t *       highest;
  std::int32_t *       result;
};

/** The square of the step from a row to another one, for one row after the other, without products. */
struct Square
{
  Vector value; ///< step * step
  Vector twice; ///< 2 * step

  MEDIALVOXEL_INLINE explicit Square(const std::int64_t step)
    : value(Vector{} + static_cast<std::int32_t>(step * step))
    , twice(Vector{} + static_cast<std::int32_t>(2 * step))
  {}

  /** The other row is one further on, the step one less. */
  MEDIALVOXEL_INLINE void
  Advance()
  {
    value += 1 - twice;
    twice -= 2;
  }
};

/** For a row, the rows of the smallest sums among candidates, of all lanes. */
MEDIALVOXEL_INLINE void
FindWinners(const Pass &         pass,
            const std::int64_t   row,
            const std::int64_t   begin,
            const std::int64_t   last,
            std::int32_t * const winners)
{
  Square square(row - begin);
  Vector best = MedialVoxelLoad<Vector>(pass.costs + begin * Columns) + square.value;
  Vector winner = Vector{} + static_cast<std::int32_t>(begin);
  Vector candidate = winner;
  for (std::int64_t j = begin + 1; j <= last; ++j)
  {
    square.Advance();
    const Vector sum = MedialVoxelLoad<Vector>(pass.costs + j * Columns) + square.value;
    candidate += 1;
    winner = MedialVoxelSelect(sum < best, candidate, winner);
    best = MedialVoxelSelect(sum < best, sum, best);
  }
  std::memcpy(winners, &winner, sizeof(winner));
}

/** Find the winners of a row between the winners of rows before and after it. */
MEDIALVOXEL_INLINE void
SearchRow(const Pass & pass, const std::int64_t block, std::int64_t begin, std::int64_t last)
{
  const std::int64_t row = pass.first + std::min(block * BlockSize, pass.number - 1);
  if (last - begin > FewRows)
  {
    // No sum that is larger than the own cost wins. A float root that is rounded down is one too small at most.
    const std::int32_t * const own = pass.costs + row * Columns;
    const auto                 most = static_cast<float>(*std::max_element(own, own + Lanes));
    const auto                 reach = static_cast<std::int64_t>(std::sqrt(most)) + 1;
    begin = std::max(begin, row - reach);
    last = std::min(last, row + reach);
  }
  std::int32_t winners[Lanes];
  FindWinners(pass, row, begin, last, winners);
  pass.lowest[block] = *std::min_element(winners, winners + Lanes);
  pass.highest[block] = *std::max_element(winners, winners + Lanes);
}

/** Smallest sums of a block of rows among candidates. */
MEDIALVOXEL_INLINE void
FillBlock(const Pass & pass, const std::int64_t block, const std::int64_t begin, const std::int64_t last)
{
  const std::int64_t   first = pass.first + block * BlockSize;
  std::int32_t * const result = pass.result + block * BlockSize * Columns;
  // With i rows from the first one to another, (step + i)^2 is step^2 + 2 i step + i^2; i^2 can wait.
  Vector best[BlockSize];
  std::fill(best, best + BlockSize, Vector{} + MedialVoxelSquaredLengths::None);
  Square square(first - begin);
  for (std::int64_t j = begin; j <= last; ++j)
  {
    Vector sum = MedialVoxelLoad<Vector>(pass.costs + j * Columns) + square.value;
    for (std::int64_t row = 0; row < BlockSize; ++row)
    {
      best[row] = MedialVoxelSelect(sum < best[row], sum, best[row]);
      sum += square.twice;
    }
    square.Advance();
  }
  std::int32_t values[BlockSize * Lanes];
  std::memcpy(values, best, sizeof(values));
  for (std::int64_t row = 0; row < BlockSize; ++row)
  {
    for (std::int64_t lane = 0; lane < Lanes; ++lane)
    {
      result[row * Columns + lane] = values[row * Lanes + lane] + static_cast<std::int32_t>(row * row);
    }
  }
}

/** All rows of some columns: winners of the ends, then of the middle between two that are known, then the rest. */
MEDIALVOXEL_INLINE void
SearchLanes(const Pass & pass)
{
  const std::int64_t end = (pass.number + BlockSize - 1) / BlockSize;
  SearchRow(pass, 0, 0, pass.length - 1);
  SearchRow(pass, end, pass.lowest[0], pass.length - 1);
  std::int64_t stride = 1;
  while (2 * stride < end)
  {
    stride *= 2;
  }
  for (; stride > 0; stride /= 2)
  {
    for (std::int64_t block = stride; block < end; block += 2 * stride)
    {
      SearchRow(pass, block, pass.lowest[block - stride], pass.highest[std::min(block + stride, end)]);
    }
  }
  for (std::int64_t block = 0; block < end; ++block)
  {
    FillBlock(pass, block, pass.lowest[block], pass.highest[block + 1]);
  }
}

} // namespace

std::uint64_t
MedialVoxelColumnPass::GetBytes(const std::int64_t number)
{
  return 2 * sizeof(std::int32_t) * static_cast<std::uint64_t>(GetResultRows(number) / BlockSize + 1);
}

std::int64_t
MedialVoxelColumnPass::GetResultRows(const std::int64_t number)
{
  return (number + BlockSize - 1) / BlockSize * BlockSize;
}

void
MedialVoxelColumnPass::Search(const std::int32_t * const costs,
                              const std::int64_t         length,
                              const std::int64_t         first,
                              const std::int64_t         number,
                              std::int32_t * const       result)
{
  const std::int64_t ends = GetResultRows(number) / BlockSize + 1;
  MedialVoxelReserve(m_Lowest, ends);
  MedialVoxelReserve(m_Highest, ends);
  for (std::int64_t lane = 0; lane < Columns; lane += Lanes)
  {
    MedialVoxelKernel<SearchLanes>::Run(
      { costs + lane, length, first, number, m_Lowest.data(), m_Highest.data(), result + lane });
  }
}

} // end namespace itk
