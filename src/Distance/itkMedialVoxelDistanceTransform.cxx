// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelDistanceTransform.h"

#include "itkMedialVoxelFirstSites.h"
#include "itkMedialVoxelLanes.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelReserve.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

constexpr std::int64_t Columns = MedialVoxelColumnPass::Columns;

/** Slices to a site that does not exist, more than any image has. */
constexpr std::int16_t Nowhere = MedialVoxelSquaredLengths::LargestSize;

/** Further voxels that are searched beyond the reach of the tiles before. */
constexpr std::int64_t ReachMargin = 24;

/** Least voxels that a window grows by when it holds no site. */
constexpr std::int64_t LeastGrowth = 32;

std::int64_t
RootOf(const std::int64_t square)
{
  return static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
}

std::int64_t
RoundUp(const std::int64_t number)
{
  return (number + Columns - 1) / Columns * Columns;
}

/** Voxels from a tile to the nearest voxel outside \a known that the image has. */
std::int64_t
StepsToUnknown(const MedialVoxelGrid & grid, const MedialVoxelBox & known, const MedialVoxelBox & tile)
{
  std::int64_t steps = std::numeric_limits<std::int32_t>::max();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (known.lower[axis] > 0)
    {
      steps = std::min(steps, tile.lower[axis] - known.lower[axis] + 1);
    }
    if (known.upper[axis] < grid.GetSize()[axis])
    {
      steps = std::min(steps, known.upper[axis] - tile.upper[axis] + 1);
    }
  }
  return steps;
}

/** Columns that are counted at once. */
using Counts = MedialVoxelLanesOf<std::int16_t, Columns>;

/** Slices since the last site, for the columns of a slice; \a before is the result of the slice before. */
MEDIALVOXEL_INLINE void
CountSlices(const WordType * const     sites,
            const int                  shift,
            const std::int64_t         rows,
            const std::int16_t * const before,
            std::int16_t * const       slices)
{
  std::uint16_t bits[Columns];
  for (std::int64_t column = 0; column < Columns; ++column)
  {
    bits[column] = static_cast<std::uint16_t>(1u << column);
  }
  const Counts most = Counts{} + Nowhere;
  const Counts own = MedialVoxelLoad<Counts>(bits);
  for (std::int64_t row = 0; row < rows; ++row)
  {
    const auto word = static_cast<std::int16_t>(sites[row] >> shift);
    Counts     further = MedialVoxelLoad<Counts>(before + row * Columns) + 1;
    further = MedialVoxelSelect(further < most, further, most);
    further = MedialVoxelSelect((own & word) != 0, Counts{}, further);
    std::memcpy(slices + row * Columns, &further, sizeof(further));
  }
}

/** Squared distances along z; the smallest one. */
MEDIALVOXEL_INLINE std::int32_t
                   MakeCosts(const std::int16_t * const below,
                             const std::int16_t * const above,
                             const std::int64_t         number,
                             std::int32_t * const       costs)
{
  std::int32_t smallest = MedialVoxelSquaredLengths::None;
  for (std::int64_t i = 0; i < number; ++i)
  {
    const std::int32_t slices = std::min(below[i], above[i]);
    const std::int32_t cost = slices < Nowhere ? slices * slices : MedialVoxelSquaredLengths::None;
    smallest = std::min(smallest, cost);
    costs[i] = cost;
  }
  return smallest;
}

MEDIALVOXEL_INLINE std::int32_t
                   FindLargest(const std::int32_t * const values, const std::int64_t number)
{
  std::int32_t largest = 0;
  for (std::int64_t i = 0; i < number; ++i)
  {
    largest = std::max(largest, values[i]);
  }
  return largest;
}

} // namespace

/** Searches all voxels of some slices for the sites within a reach. */
class MedialVoxelDistanceTransform::Search
{
public:
  Search(const MedialVoxelBits &     sites,
         const MedialVoxelBox &      tile,
         const std::int64_t          reach,
         Workspace &                 memory,
         MedialVoxelSquaredLengths & lengths);

  /** The largest squared distance. */
  std::int32_t
  Run();

private:
  void
  CountBeside();

  void
  CopyWords(std::int64_t word);

  void
  SearchColumns(std::int64_t x);

  std::int32_t
  SearchRows(std::int64_t y, std::int64_t z);

  const MedialVoxelBits &     m_Sites;
  MedialVoxelBox              m_Tile;
  std::int64_t                m_Reach;
  Workspace &                 m_Memory;
  MedialVoxelSquaredLengths & m_Lengths;

  /** Rows and columns whose sites count, in the slices of the tile. */
  MedialVoxelBox m_Area;

  /** First of the columns that are searched, so many at once, and their number. */
  std::int64_t m_Left;
  std::int64_t m_Width;

  MedialVoxelAbortChecker m_Checker;
};

MedialVoxelDistanceTransform::Search::Search(const MedialVoxelBits &     sites,
                                             const MedialVoxelBox &      tile,
                                             const std::int64_t          reach,
                                             Workspace &                 memory,
                                             MedialVoxelSquaredLengths & lengths)
  : m_Sites(sites)
  , m_Tile(tile)
  , m_Reach(reach)
  , m_Memory(memory)
  , m_Lengths(lengths)
  , m_Area(tile.Expanded({ { reach, reach, 0 } }).Intersection(sites.GetBox()))
  , m_Left(m_Area.lower[0] / Columns * Columns)
  , m_Width(RoundUp(m_Area.upper[0] - m_Left))
{
  m_Lengths.box = m_Tile;
  m_Lengths.box.lower[0] = m_Left;
  m_Lengths.box.upper[0] = m_Left + m_Width;
  const std::int64_t longest = std::max(m_Area.Extent(0), m_Area.Extent(1));
  const std::int64_t most = std::max(m_Tile.Extent(0), m_Tile.Extent(1));
  MedialVoxelReserve(m_Lengths.values, m_Lengths.box.NumberOfVoxels());
  MedialVoxelReserve(m_Memory.m_Below, m_Area.Extent(1) * m_Width);
  MedialVoxelReserve(m_Memory.m_Above, m_Area.Extent(1) * m_Width);
  MedialVoxelReserve(m_Memory.m_Slices, (m_Tile.Extent(2) + 2) * m_Area.Extent(1) * Columns);
  MedialVoxelReserve(m_Memory.m_Costs, longest * Columns);
  MedialVoxelReserve(m_Memory.m_Found, MedialVoxelColumnPass::GetResultRows(most) * Columns);
  MedialVoxelReserve(m_Memory.m_Words, m_Tile.Extent(2) * m_Area.Extent(1));
}

std::int32_t
MedialVoxelDistanceTransform::Search::Run()
{
  this->CountBeside();
  for (std::int64_t x = m_Left; x < m_Left + m_Width; x += Columns)
  {
    if (x == m_Left || x % MedialVoxelBits::BitsPerWord == 0)
    {
      this->CopyWords(x / MedialVoxelBits::BitsPerWord);
    }
    this->SearchColumns(x);
  }
  std::int32_t largest = 0;
  for (std::int64_t z = m_Tile.lower[2]; z < m_Tile.upper[2]; ++z)
  {
    for (std::int64_t y = m_Tile.lower[1]; y < m_Tile.upper[1]; y += Columns)
    {
      largest = std::max(largest, this->SearchRows(y, z));
    }
  }
  return largest;
}

/** Slices from the sites below and above the tile to the slices next to it. */
void
MedialVoxelDistanceTransform::Search::CountBeside()
{
  const MedialVoxelBox & known = m_Sites.GetBox();
  const std::int64_t     below = m_Tile.lower[2] - 1;
  const std::int64_t     above = m_Tile.upper[2];
  const auto             number = m_Area.Extent(1) * m_Width;
  const auto count = [&](std::vector<std::int16_t> & slices, const std::int64_t first, const std::int64_t end) {
    std::fill_n(slices.begin(), number, Nowhere);
    MedialVoxelVisitFirstSites(
      m_Sites, m_Area, first, end, m_Memory.m_Open, [&](std::int64_t x, std::int64_t row, std::int64_t z) {
        slices[static_cast<std::size_t>(row * m_Width + x - m_Left)] = static_cast<std::int16_t>(std::abs(z - first));
      });
  };
  count(m_Memory.m_Below, below, std::max(below - m_Reach, known.lower[2] - 1));
  count(m_Memory.m_Above, above, std::min(above + m_Reach, known.upper[2]));
}

/** Copy a word of all rows and slices: they lie far from each other and are read several times. */
void
MedialVoxelDistanceTransform::Search::CopyWords(const std::int64_t word)
{
  WordType * target = m_Memory.m_Words.data();
  for (std::int64_t z = m_Tile.lower[2]; z < m_Tile.upper[2]; ++z)
  {
    for (std::int64_t y = m_Area.lower[1]; y < m_Area.upper[1]; ++y)
    {
      *target++ = m_Sites.GetRow(y, z)[word - m_Sites.GetFirstWord()];
    }
  }
}

/** Squared distances along z and y of some columns of all slices. */
void
MedialVoxelDistanceTransform::Search::SearchColumns(const std::int64_t x)
{
  MedialVoxelCheckAbort();
  const std::int64_t   rows = m_Area.Extent(1);
  const std::int64_t   slices = m_Tile.Extent(2);
  const std::int64_t   number = rows * Columns;
  std::int16_t * const below = m_Memory.m_Slices.data(); // of the slice before the tile, and of all of its slices
  std::int16_t * const above = below + (slices + 1) * number;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    const std::int64_t at = row * m_Width + x - m_Left;
    std::memcpy(below + row * Columns, m_Memory.m_Below.data() + at, Columns * sizeof(std::int16_t));
    std::memcpy(above + row * Columns, m_Memory.m_Above.data() + at, Columns * sizeof(std::int16_t));
  }
  const auto step = [&](const std::int64_t slice, const std::int16_t * const before, std::int16_t * const next) {
    const auto shift = static_cast<int>(x % MedialVoxelBits::BitsPerWord);
    MedialVoxelKernel<CountSlices>::Run(m_Memory.m_Words.data() + slice * rows, shift, rows, before, next);
  };
  for (std::int64_t slice = 0; slice < slices; ++slice)
  {
    step(slice, below + slice * number, below + (slice + 1) * number);
  }
  const std::int64_t first = m_Tile.lower[1] - m_Area.lower[1];
  for (std::int64_t slice = slices - 1; slice >= 0; --slice)
  {
    step(slice, above, above);
    const std::int32_t smallest =
      MedialVoxelKernel<MakeCosts>::Run(below + (slice + 1) * number, above, number, m_Memory.m_Costs.data());
    const std::int32_t * found = m_Memory.m_Costs.data() + first * Columns;
    if (smallest < MedialVoxelSquaredLengths::None)
    {
      m_Memory.m_Pass.Search(m_Memory.m_Costs.data(), rows, first, m_Tile.Extent(1), m_Memory.m_Found.data());
      found = m_Memory.m_Found.data();
    }
    std::int32_t * const to =
      m_Lengths.values.data() + m_Lengths.box.OffsetOf({ { x, m_Tile.lower[1], m_Tile.lower[2] + slice } });
    for (std::int64_t row = 0; row < m_Tile.Extent(1); ++row)
    {
      std::memcpy(to + row * m_Width, found + row * Columns, Columns * sizeof(std::int32_t));
    }
  }
}

/** Squared distances of some rows; the largest one. */
std::int32_t
MedialVoxelDistanceTransform::Search::SearchRows(const std::int64_t y, const std::int64_t z)
{
  const std::int64_t length = m_Area.Extent(0);
  const std::int64_t number = m_Tile.Extent(0);
  const std::int64_t first = m_Tile.lower[0] - m_Area.lower[0];
  const std::int64_t rows = std::min(Columns, m_Tile.upper[1] - y);
  std::int32_t *     lines[Columns];
  for (std::int64_t row = 0; row < Columns; ++row)
  {
    // The last row replaces missing rows; this changes no largest value.
    const std::int64_t own = std::min(row, rows - 1);
    lines[row] = m_Lengths.values.data() + m_Lengths.box.OffsetOf({ { m_Area.lower[0], y + own, z } });
  }
  m_Checker.Count(static_cast<std::uint32_t>(length));
  std::int32_t * const costs = m_Memory.m_Costs.data();
  for (std::int64_t x = 0; x < length; ++x)
  {
    for (std::int64_t row = 0; row < Columns; ++row)
    {
      costs[x * Columns + row] = lines[row][x];
    }
  }
  std::int32_t * const found = m_Memory.m_Found.data();
  m_Memory.m_Pass.Search(costs, length, first, number, found);
  for (std::int64_t x = 0; x < number; ++x)
  {
    for (std::int64_t row = 0; row < rows; ++row)
    {
      lines[row][first + x] = found[x * Columns + row];
    }
  }
  return MedialVoxelKernel<FindLargest>::Run(found, number * Columns);
}

MedialVoxelDistanceTransform::MedialVoxelDistanceTransform(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{}

bool
MedialVoxelDistanceTransform::CanTransform(const MedialVoxelGrid & grid)
{
  const MedialVoxelIndex & size = grid.GetSize();
  return grid.HasEqualSpacing() &&
         *std::max_element(size.begin(), size.end()) <= MedialVoxelSquaredLengths::LargestSize;
}

MedialVoxelBox
MedialVoxelDistanceTransform::Compute(const MedialVoxelBits &     sites,
                                      const MedialVoxelBox &      tile,
                                      Workspace &                 workspace,
                                      MedialVoxelSquaredLengths & lengths) const
{
  const MedialVoxelBox & known = sites.GetBox();
  if (!known.Contains(tile))
  {
    return known.Union(tile);
  }
  lengths.spacing = m_Grid.GetMetricUnit();
  std::int64_t whole = 0; // reach that sees all that is known
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    whole = std::max({ whole, tile.upper[axis] - known.lower[axis], known.upper[axis] - tile.lower[axis] });
  }
  const std::int64_t before = workspace.m_Reach;
  if (tile.Extent(2) > 1 && (before == 0 || before >= StepsToUnknown(m_Grid, known, tile)))
  {
    // One slice shows whether the window is large enough, most probably.
    MedialVoxelBox slice = tile;
    slice.upper[2] = slice.lower[2] + 1;
    const std::int32_t   largest = Search(sites, slice, whole, workspace, lengths).Run();
    const MedialVoxelBox missing = this->FindMissing(sites, tile, largest, tile.Extent(2));
    if (!missing.IsEmpty())
    {
      return missing;
    }
    workspace.m_Reach = std::max(before, RootOf(largest));
  }
  std::int64_t reach = std::min(whole, workspace.m_Reach + ReachMargin);
  std::int64_t root = 0;
  std::int32_t largest = 0;
  for (bool isDone = false; !isDone;)
  {
    largest = Search(sites, tile, reach, workspace, lengths).Run();
    root = RootOf(largest);
    isDone = root <= reach || reach == whole;
    reach = std::min(whole, root + 1);
  }
  // Tiles beside and above have similar distances.
  workspace.m_Reach = std::max(root, before - before / 8);
  workspace.m_Largest = largest;
  return this->FindMissing(sites, tile, largest, 0);
}

/** The sites to know when the largest squared distance is not final, with some \a more voxels around. */
MedialVoxelBox
MedialVoxelDistanceTransform::FindMissing(const MedialVoxelBits & sites,
                                          const MedialVoxelBox &  tile,
                                          const std::int32_t      largest,
                                          const std::int64_t      more) const
{
  const MedialVoxelBox & known = sites.GetBox();
  const MedialVoxelBox   image = m_Grid.GetVoxelBox();
  const std::int64_t     steps = StepsToUnknown(m_Grid, known, tile);
  const std::int64_t     root = RootOf(largest);
  if (root < steps)
  {
    return {};
  }
  const bool         hasSite = largest < MedialVoxelSquaredLengths::None;
  const std::int64_t margin = hasSite ? root + more : std::max(2 * steps, LeastGrowth);
  return tile.Expanded({ { margin, margin, margin } }).Intersection(image).Union(known);
}

std::uint64_t
MedialVoxelDistanceTransform::GetBytes(const MedialVoxelIndex & tileSize, const MedialVoxelIndex & searchedSize)
{
  const std::int64_t rows = searchedSize[1];
  const std::int64_t width = RoundUp(searchedSize[0]) + Columns;
  const std::int64_t words = searchedSize[0] / MedialVoxelBits::BitsPerWord + 2;
  const std::int64_t longest = std::max(searchedSize[0], rows);
  const std::int64_t found = MedialVoxelColumnPass::GetResultRows(std::max(tileSize[0], tileSize[1]));
  const std::int64_t shorts = 2 * rows * width + (tileSize[2] + 2) * rows * Columns;
  const std::int64_t longs = (longest + found) * Columns + width * tileSize[1] * tileSize[2];
  return static_cast<std::uint64_t>(shorts) * sizeof(std::int16_t) +
         static_cast<std::uint64_t>(longs) * sizeof(std::int32_t) +
         static_cast<std::uint64_t>((words + tileSize[2]) * rows) * sizeof(WordType) +
         MedialVoxelColumnPass::GetBytes(found);
}

} // end namespace itk
