// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNearestSite.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <utility>

// Costs and positions never overlap; compilers must know to vectorize short lines.
#if defined(_MSC_VER)
#  define MEDIALVOXEL_RESTRICT __restrict
#else
#  define MEDIALVOXEL_RESTRICT __restrict__
#endif

namespace itk
{

using WordType = MedialVoxelBits::WordType;

std::vector<MedialVoxelOffset>
MedialVoxelSortedOffsets(const MedialVoxelGrid & grid, const double radius)
{
  MedialVoxelIndex reach = grid.MarginForMetricLength(radius);
  for (auto & voxels : reach)
  {
    voxels = std::min(voxels, MedialVoxelLongestOffset);
  }
  std::vector<MedialVoxelOffset> offsets;
  for (std::int64_t dz = -reach[2]; dz <= reach[2]; ++dz)
  {
    for (std::int64_t dy = -reach[1]; dy <= reach[1]; ++dy)
    {
      for (std::int64_t dx = -reach[0]; dx <= reach[0]; ++dx)
      {
        const double squaredLength = grid.SquaredMetricLength(dx, dy, dz);
        if (squaredLength <= radius * radius)
        {
          offsets.push_back({ static_cast<std::int32_t>(dx),
                              static_cast<std::int32_t>(dy),
                              static_cast<std::int32_t>(dz),
                              squaredLength });
        }
      }
    }
  }
  // The loops run in the order of the rest of the key, so that a stable sort by length alone gives the whole key.
  std::stable_sort(offsets.begin(), offsets.end(), [](const MedialVoxelOffset & a, const MedialVoxelOffset & b) {
    return a.squaredLength < b.squaredLength;
  });
  return offsets;
}

MedialVoxelOffsetTable::MedialVoxelOffsetTable(std::vector<MedialVoxelOffset> sorted)
  : offsets(std::move(sorted))
{
  for (const MedialVoxelOffset & offset : offsets)
  {
    const MedialVoxelIndex steps{ { std::abs(offset.dx), std::abs(offset.dy), std::abs(offset.dz) } };
    std::transform(reach.begin(), reach.end(), steps.begin(), reach.begin(), [](const auto a, const auto b) {
      return std::max(a, b);
    });
  }
}

namespace
{

/** The 64 bits from a voxel on, for displacements of that voxel; all of them lead to words that can be read. */
class WordsAround
{
public:
  WordsAround(const MedialVoxelBits & bits, const std::int64_t x, const std::int64_t y, const std::int64_t z)
    : m_Row(bits.GetRow(y, z))
    , m_First(x - bits.GetFirstWord() * MedialVoxelBits::BitsPerWord)
    , m_RowPitch(bits.GetRowPitch())
    , m_SlicePitch(bits.GetRowPitch() * bits.GetBox().Extent(1))
  {}

  static bool
  AreReadable(const MedialVoxelBits &  bits,
              const std::int64_t       x,
              const std::int64_t       y,
              const std::int64_t       z,
              const MedialVoxelIndex & reach)
  {
    // A word before the row and one after it can be read, and two are read at once.
    const std::int64_t first = ((x - reach[0]) >> 6) - bits.GetFirstWord();
    const std::int64_t last = ((x + reach[0]) >> 6) - bits.GetFirstWord();
    return first >= -1 && last < bits.GetWordsPerRow() && bits.HasRow(y - reach[1], z - reach[2]) &&
           bits.HasRow(y + reach[1], z + reach[2]);
  }

  WordType
  operator()(const MedialVoxelOffset & offset) const
  {
    constexpr unsigned int last = MedialVoxelBits::BitsPerWord - 1;
    const std::int64_t     bit = m_First + offset.dx;
    const WordType * const words = m_Row + offset.dz * m_SlicePitch + offset.dy * m_RowPitch + (bit >> 6);
    const auto             shift = static_cast<unsigned int>(bit) & last;
    return (words[0] >> shift) | ((words[1] << 1) << (last - shift));
  }

private:
  const WordType * m_Row;
  std::int64_t     m_First;
  std::int64_t     m_RowPitch;
  std::int64_t     m_SlicePitch;
};

/** Take the first displacement of each lane that leads to a bit; \a bitsAt(offset) has the bits of all lanes. */
template <typename TBitsAt>
MedialVoxelTableResult
TakeFirstHits(const std::vector<MedialVoxelOffset> & offsets,
              const WordType                         query,
              const MedialVoxelDisplacementRow &     row,
              TBitsAt &&                             bitsAt)
{
  MedialVoxelTableResult result{ query, 0.0 };
  for (const MedialVoxelOffset & offset : offsets)
  {
    WordType hits = result.remaining & bitsAt(offset);
    if (hits == 0)
    {
      continue;
    }
    result.remaining &= ~hits;
    result.largestSquaredLength = offset.squaredLength;
    for (; hits != 0; hits &= hits - 1)
    {
      const std::int64_t lane = row.firstLane + MedialVoxelLowestBit(hits);
      row.dx[lane] = offset.dx;
      row.dy[lane] = offset.dy;
      row.dz[lane] = offset.dz;
    }
    if (result.remaining == 0)
    {
      break;
    }
  }
  return result;
}

} // namespace

MedialVoxelTableResult
MedialVoxelSearchOffsets(const MedialVoxelOffsetTable &     table,
                         const MedialVoxelBits &            sites,
                         const std::int64_t                 x,
                         const std::int64_t                 y,
                         const std::int64_t                 z,
                         const WordType                     query,
                         const MedialVoxelDisplacementRow & row)
{
  if (query == 0)
  {
    return { 0, 0.0 };
  }
  if (WordsAround::AreReadable(sites, x, y, z, table.reach))
  {
    return TakeFirstHits(table.offsets, query, row, WordsAround(sites, x, y, z));
  }
  return TakeFirstHits(table.offsets, query, row, [&](const MedialVoxelOffset & offset) {
    return sites.HasRow(y + offset.dy, z + offset.dz) ? sites.Extract(x + offset.dx, y + offset.dy, z + offset.dz) : 0;
  });
}

namespace
{

constexpr std::int64_t NoPosition = std::numeric_limits<std::int64_t>::min();

/** Largest x of a site in [lower, x), or NoPosition. */
std::int64_t
PreviousSite(const WordType * const row, const std::int64_t lower, const std::int64_t x)
{
  if (lower >= x)
  {
    return NoPosition;
  }
  const std::int64_t firstWord = lower >> 6;
  for (std::int64_t word = (x - 1) >> 6; word >= firstWord; --word)
  {
    const WordType bits = row[word] & MedialVoxelBits::RangeMask(word, lower, x);
    if (bits != 0)
    {
      return word * MedialVoxelBits::BitsPerWord + MedialVoxelHighestBit(bits);
    }
  }
  return NoPosition;
}

/** Smallest x of a site in [x, upper), or NoPosition. */
std::int64_t
NextSite(const WordType * const row, const std::int64_t x, const std::int64_t upper)
{
  if (x >= upper)
  {
    return NoPosition;
  }
  const std::int64_t lastWord = (upper - 1) >> 6;
  for (std::int64_t word = x >> 6; word <= lastWord; ++word)
  {
    const WordType bits = row[word] & MedialVoxelBits::RangeMask(word, x, upper);
    if (bits != 0)
    {
      return word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(bits);
    }
  }
  return NoPosition;
}

} // namespace

void
MedialVoxelNearestInRow(const MedialVoxelBits & sites,
                        const std::int64_t      x,
                        const std::int64_t      count,
                        const std::int64_t      y,
                        const std::int64_t      z,
                        const std::int64_t      reach,
                        std::int32_t *          displacement)
{
  const MedialVoxelBox & box = sites.GetBox();
  const WordType * const row = sites.GetRow(y, z) - sites.GetFirstWord();
  const std::int64_t     lower = std::max(x - reach, box.lower[0]);
  const std::int64_t     upper = std::min(x + count + reach, box.upper[0]);

  std::int64_t previous = PreviousSite(row, lower, x);
  std::int64_t next = NextSite(row, x, upper);
  for (std::int64_t lane = 0; lane < count; ++lane)
  {
    const std::int64_t position = x + lane;
    if (next == position)
    {
      previous = position;
      next = NextSite(row, position + 1, upper);
    }
    // Compared as previous first, so that the smaller x wins a tie.
    const bool hasPrevious = (previous != NoPosition);
    const bool hasNext = (next != NoPosition);
    if (hasPrevious && (!hasNext || position - previous <= next - position))
    {
      displacement[lane] = static_cast<std::int32_t>(previous - position);
    }
    else
    {
      displacement[lane] = hasNext ? static_cast<std::int32_t>(next - position) : MedialVoxelNoDisplacement;
    }
  }
}

namespace
{

/** Take the candidate line where it is cheaper, or as cheap when \a takeEqual. */
template <bool VTakeEqual>
void
TakeLine(const double * const MEDIALVOXEL_RESTRICT line,
         const double                              square,
         const std::int64_t                        candidate,
         const std::int64_t                        lanes,
         double * const MEDIALVOXEL_RESTRICT       cost,
         std::int64_t * const MEDIALVOXEL_RESTRICT position)
{
  for (std::int64_t lane = 0; lane < lanes; ++lane)
  {
    const double value = line[lane] + square;
    const bool   take = VTakeEqual ? (value <= cost[lane]) : (value < cost[lane]);
    cost[lane] = take ? value : cost[lane];
    position[lane] = take ? candidate : position[lane];
  }
}

} // namespace

void
MedialVoxelSearchOutward(const double * const        lines,
                         const std::int64_t          pitch,
                         const std::int64_t          numberOfLines,
                         const std::int64_t          lanes,
                         const std::int64_t          center,
                         const std::vector<double> & squares,
                         double * const              cost,
                         std::int64_t * const        position)
{
  constexpr std::int64_t stepsBetweenStopTests = 4;

  std::fill(position, position + lanes, center);
  std::copy(lines + center * pitch, lines + center * pitch + lanes, cost);

  const std::int64_t farthest = std::max(center, numberOfLines - 1 - center);
  const std::int64_t last = std::min<std::int64_t>(farthest, static_cast<std::int64_t>(squares.size()) - 1);
  for (std::int64_t step = 1; step <= last; ++step)
  {
    if (step % stepsBetweenStopTests == 1 &&
        squares[static_cast<std::size_t>(step)] > *std::max_element(cost, cost + lanes))
    {
      break;
    }
    const double square = squares[static_cast<std::size_t>(step)];
    if (center - step >= 0)
    {
      TakeLine<true>(lines + (center - step) * pitch, square, center - step, lanes, cost, position);
    }
    if (center + step < numberOfLines)
    {
      TakeLine<false>(lines + (center + step) * pitch, square, center + step, lanes, cost, position);
    }
  }
}

double
MedialVoxelSquaredDistanceToSites(const MedialVoxelGrid &  grid,
                                  const MedialVoxelBits &  sites,
                                  const MedialVoxelIndex & voxel,
                                  const double             limit)
{
  const MedialVoxelBox &  box = sites.GetBox();
  const auto &            spacing = grid.GetMetricSpacing();
  double                  best = limit * limit;
  bool                    found = false;
  MedialVoxelAbortChecker checker;

  const auto searchRow = [&](const std::int64_t y, const std::int64_t z) {
    const double planar = grid.SquaredMetricLength(0, y - voxel[1], z - voxel[2]);
    if (planar > best)
    {
      return;
    }
    const auto   reach = static_cast<std::int64_t>(std::min(std::sqrt(best - planar) / spacing[0], 1e15)) + 1;
    std::int32_t dx = 0;
    MedialVoxelNearestInRow(sites, voxel[0], 1, y, z, reach, &dx);
    if (dx == MedialVoxelNoDisplacement)
    {
      return;
    }
    const double squared = grid.SquaredMetricLength(dx, y - voxel[1], z - voxel[2]);
    if (squared <= best)
    {
      best = squared;
      found = true;
    }
  };

  // Square rings of rows around the own row; a ring is skipped as a whole once it is too far.
  const std::int64_t rings = std::max(
    { voxel[1] - box.lower[1], box.upper[1] - 1 - voxel[1], voxel[2] - box.lower[2], box.upper[2] - 1 - voxel[2] });
  for (std::int64_t ring = 0; ring <= rings; ++ring)
  {
    checker.Count(static_cast<std::uint32_t>(8 * ring));
    const double nearestOfRing = static_cast<double>(ring) * std::min(spacing[1], spacing[2]);
    if (nearestOfRing * nearestOfRing > best)
    {
      break;
    }
    for (std::int64_t z = std::max(voxel[2] - ring, box.lower[2]); z < std::min(voxel[2] + ring + 1, box.upper[2]); ++z)
    {
      const bool         isWholeLine = (z == voxel[2] - ring || z == voxel[2] + ring);
      const std::int64_t step = (isWholeLine || ring == 0) ? 1 : 2 * ring;
      for (std::int64_t y = voxel[1] - ring; y <= voxel[1] + ring; y += step)
      {
        if (y >= box.lower[1] && y < box.upper[1])
        {
          searchRow(y, z);
        }
      }
    }
  }
  return found ? best : std::numeric_limits<double>::infinity();
}

} // end namespace itk
