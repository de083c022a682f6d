// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFeatureTransformPrivate.h"

#include "itkMedialVoxelFirstSites.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cmath>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

/** Columns whose keys are turned into rows at once. */
constexpr std::int64_t ColumnsAtOnce = 8;

constexpr std::int64_t BlockSize = MedialVoxelRowPass::BlockSize;

/** Position of a site that does not exist, further away than any that counts; below or above the voxels. */
constexpr std::int16_t Nowhere = 16384;

/** Slices whose positions differ so little that they fit 16 bits with the sites around them. */
constexpr std::int64_t MostSlices = 4096;

/** Least voxels around a tile that are searched. */
constexpr std::int64_t LeastReach = 12;

/** Further voxels that are searched beyond the reach of the slice before. */
constexpr std::int64_t ReachMargin = 6;

std::int64_t
BlocksOf(const std::int64_t voxels)
{
  return (voxels + BlockSize - 1) / BlockSize;
}

} // namespace

/** Searches the remaining voxels of a tile slice by slice: along z, then along y, then along x. */
class MedialVoxelFeatureTransform::SliceSearch
{
public:
  SliceSearch(const MedialVoxelRegion region, Tile & tile, Workspace::Slices & memory)
    : m_Region(region)
    , m_Tile(tile)
    , m_Memory(memory)
  {}

  /** Make ready for the slices from \a z on and sites within \a reach voxels. */
  void
  Prepare(std::int64_t z, std::int64_t reach);

  /** True when slice \a z, the next one, is ready. */
  bool
  IsReady(const std::int64_t z) const
  {
    return z < m_EndSlice;
  }

  /** Search the remaining voxels of a slice; the squared length of the longest displacement, infinite when a voxel has
   * no site. May be called again for a slice after Prepare(). */
  double
  SearchSlice(std::int64_t z);

  /** Leave slice \a z. */
  void
  Advance(std::int64_t z);

private:
  template <typename TVisitor>
  void
  VisitSites(std::int64_t z, TVisitor && visit) const;

  void
  FindNearestSlices(std::int64_t first, std::int64_t end, std::vector<std::int16_t> & slices);

  void
  FindWanted(std::int64_t z);

  bool
  FillColumn(std::int64_t x, std::int64_t z) const;

  void
  SearchAlongY(std::int64_t z);

  double
  SearchAlongX(std::int64_t z);

  WordType
  RemainingBits(std::int64_t x, std::int64_t y, std::int64_t z) const;

  double
  StoreBlock(WordType bits, const double * keys, std::int64_t x, std::int64_t y, std::int64_t z) const;

  MedialVoxelRegion   m_Region;
  Tile &              m_Tile;
  Workspace::Slices & m_Memory;

  /** Rows and columns whose sites count, and the first ready slice and the one after the last. */
  MedialVoxelBox m_Area;
  std::int64_t   m_FirstSlice{ 0 };
  std::int64_t   m_EndSlice{ 0 };

  /** Remaining voxels of the slice. */
  MedialVoxelBox m_Remaining;
};

template <typename TVisitor>
void
MedialVoxelFeatureTransform::SliceSearch::VisitSites(const std::int64_t z, TVisitor && visit) const
{
  const MedialVoxelBits & sites = *m_Tile.window.sites;
  const std::int64_t      firstWord = m_Area.lower[0] >> 6;
  const std::int64_t      lastWord = (m_Area.upper[0] - 1) >> 6;
  const std::int64_t      rows = m_Area.Extent(1);
  MedialVoxelCheckAbort();
  for (std::int64_t y = m_Area.lower[1]; y < m_Area.upper[1]; ++y)
  {
    const WordType * const row = sites.GetRow(y, z) - sites.GetFirstWord();
    for (std::int64_t word = firstWord; word <= lastWord; ++word)
    {
      if (row[word] == 0)
      {
        continue;
      }
      for (WordType bits = row[word] & MedialVoxelBits::RangeMask(word, m_Area.lower[0], m_Area.upper[0]); bits != 0;
           bits &= bits - 1)
      {
        const std::int64_t x = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(bits);
        visit(static_cast<std::size_t>((x - m_Area.lower[0]) * rows + y - m_Area.lower[1]));
      }
    }
  }
}

/** For each column the first slice that has a site in it, from \a first on and before \a end, upwards or downwards;
 * other columns stay as they are. */
void
MedialVoxelFeatureTransform::SliceSearch::FindNearestSlices(const std::int64_t          first,
                                                            const std::int64_t          end,
                                                            std::vector<std::int16_t> & slices)
{
  const std::int64_t rows = m_Area.Extent(1);
  MedialVoxelVisitFirstSites(
    *m_Tile.window.sites, m_Area, first, end, m_Memory.open, [&](std::int64_t x, std::int64_t row, std::int64_t z) {
      slices[static_cast<std::size_t>((x - m_Area.lower[0]) * rows + row)] =
        static_cast<std::int16_t>(z - m_FirstSlice);
    });
}

void
MedialVoxelFeatureTransform::SliceSearch::Prepare(const std::int64_t z, const std::int64_t reach)
{
  m_Area = m_Tile.remainingBox.Expanded({ { reach, reach, 0 } }).Intersection(m_Tile.known);
  const auto   columns = static_cast<std::size_t>(m_Area.Extent(0) * m_Area.Extent(1));
  const auto & known = m_Tile.known;
  MedialVoxelReserve(m_Memory.previous, static_cast<std::int64_t>(columns));
  MedialVoxelReserve(m_Memory.next, static_cast<std::int64_t>(columns));
  std::fill_n(m_Memory.previous.begin(), columns, static_cast<std::int16_t>(-Nowhere));
  std::fill_n(m_Memory.next.begin(), columns, Nowhere);
  m_Memory.passed.clear();
  m_FirstSlice = z;

  // As many slices as the memory of their sites allows; a single one always fits.
  m_EndSlice = z;
  std::uint64_t      sites = 0;
  const std::int64_t mostEnd = std::min(m_Tile.remainingBox.upper[2], z + MostSlices);
  for (; m_EndSlice < mostEnd; ++m_EndSlice)
  {
    MedialVoxelBox slice = m_Area;
    slice.lower[2] = m_EndSlice;
    slice.upper[2] = m_EndSlice + 1;
    sites += m_Tile.window.sites->Count(slice);
    if (sites > columns)
    {
      break;
    }
  }
  m_Memory.passed.reserve(columns);

  this->FindNearestSlices(z - 1, std::max(z - reach, known.lower[2]) - 1, m_Memory.previous);
  this->FindNearestSlices(m_EndSlice, std::min(m_EndSlice + reach, known.upper[2]), m_Memory.next);
  for (std::int64_t slice = m_EndSlice - 1; slice >= z; --slice)
  {
    const auto position = static_cast<std::int16_t>(slice - z);
    this->VisitSites(slice, [&](const std::size_t column) {
      m_Memory.passed.push_back(m_Memory.next[column]);
      m_Memory.next[column] = position;
    });
  }
}

void
MedialVoxelFeatureTransform::SliceSearch::Advance(const std::int64_t z)
{
  // The sites of this slice have been remembered last, in the order of the visit.
  std::size_t sites = 0;
  const auto  position = static_cast<std::int16_t>(z - m_FirstSlice);
  this->VisitSites(z, [&](const std::size_t column) {
    m_Memory.previous[column] = position;
    ++sites;
  });
  std::size_t at = m_Memory.passed.size() - sites;
  this->VisitSites(z, [&](const std::size_t column) { m_Memory.next[column] = m_Memory.passed[at++]; });
  m_Memory.passed.resize(m_Memory.passed.size() - sites);
}

double
MedialVoxelFeatureTransform::SliceSearch::SearchSlice(const std::int64_t z)
{
  m_Remaining = m_Tile.RemainingBoxOf(z, m_Tile.remainingBox);
  if (m_Remaining.IsEmpty())
  {
    return 0.0;
  }
  this->FindWanted(z);
  this->SearchAlongY(z);
  return this->SearchAlongX(z);
}

/** For each block of rows the columns that have a voxel of the region in it.
 *
 * Along x, a voxel reaches a site before the region ends. */
void
MedialVoxelFeatureTransform::SliceSearch::FindWanted(const std::int64_t z)
{
  const MedialVoxelBits & object = *m_Tile.window.object;
  const std::int64_t      firstWord = m_Area.lower[0] >> 6;
  const std::int64_t      words = ((m_Area.upper[0] - 1) >> 6) - firstWord + 1;
  const WordType          flip = (m_Region == MedialVoxelRegion::Outside) ? ~WordType{ 0 } : WordType{ 0 };
  const WordType          all = (m_Region == MedialVoxelRegion::Both) ? ~WordType{ 0 } : WordType{ 0 };
  m_Memory.wanted.assign(static_cast<std::size_t>(BlocksOf(m_Remaining.Extent(1)) * words), 0);
  for (std::int64_t y = m_Remaining.lower[1]; y < m_Remaining.upper[1]; ++y)
  {
    const WordType * const row = object.GetRow(y, z) - object.GetFirstWord() + firstWord;
    WordType * const       wanted = m_Memory.wanted.data() + (y - m_Remaining.lower[1]) / BlockSize * words;
    for (std::int64_t word = 0; word < words; ++word)
    {
      wanted[word] |= (row[word] ^ flip) | all;
    }
  }
}

/** Keys of the sites of the columns along z, for a row of them along y; false when none has a site. */
bool
MedialVoxelFeatureTransform::SliceSearch::FillColumn(const std::int64_t x, const std::int64_t z) const
{
  const std::int64_t         rows = m_Area.Extent(1);
  const std::int16_t * const previous = m_Memory.previous.data() + (x - m_Area.lower[0]) * rows;
  const std::int16_t * const next = m_Memory.next.data() + (x - m_Area.lower[0]) * rows;
  const auto                 position = static_cast<std::int32_t>(z - m_FirstSlice);
  double * const             keys = m_Memory.column.data();
  constexpr auto             longest = static_cast<double>(MedialVoxelSiteKey::LongestReach);
  std::int32_t               nearest = Nowhere;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    const std::int32_t below = position - previous[row];
    const std::int32_t above = next[row] - position;
    const std::int32_t distance = std::min(below, above);
    const double       dz = below <= above ? -below : above;
    const double       key = MedialVoxelSiteKey::AlongZ(dz);
    keys[row] = dz * dz <= longest * longest ? key : MedialVoxelSiteKey::NoSite;
    nearest = std::min(nearest, distance);
  }
  return nearest <= MedialVoxelSiteKey::LongestReach;
}

void
MedialVoxelFeatureTransform::SliceSearch::SearchAlongY(const std::int64_t z)
{
  const std::int64_t rows = m_Remaining.Extent(1);
  const std::int64_t blocks = BlocksOf(rows);
  const std::int64_t pitch = m_Area.Extent(0) + ColumnsAtOnce;
  const std::int64_t firstRow = m_Remaining.lower[1] - m_Area.lower[1];
  const std::int64_t firstWord = m_Area.lower[0] >> 6;
  const std::int64_t words = ((m_Area.upper[0] - 1) >> 6) - firstWord + 1;
  MedialVoxelReserve(m_Memory.column, m_Area.Extent(1) + BlockSize);
  MedialVoxelReserve(m_Memory.found, ColumnsAtOnce * blocks * BlockSize);
  MedialVoxelReserve(m_Memory.plane, rows * pitch);
  MedialVoxelReserve(m_Memory.needed, std::max(blocks, BlocksOf(m_Area.Extent(0))));
  m_Memory.passY.SetLongestRow(m_Area.Extent(1));
  for (std::int64_t group = m_Area.lower[0]; group < m_Area.upper[0]; group += ColumnsAtOnce)
  {
    MedialVoxelCheckAbort();
    const std::int64_t columns = std::min(ColumnsAtOnce, m_Area.upper[0] - group);
    for (std::int64_t column = 0; column < columns; ++column)
    {
      const std::int64_t x = group + column;
      double * const     found = m_Memory.found.data() + column * blocks * BlockSize;
      const bool         hasSite = this->FillColumn(x, z);
      std::copy_n(m_Memory.column.data() + firstRow, rows, found);
      if (!hasSite)
      {
        continue;
      }
      for (std::int64_t block = 0; block < blocks; ++block)
      {
        const WordType word = m_Memory.wanted[static_cast<std::size_t>(block * words + (x >> 6) - firstWord)];
        m_Memory.needed[static_cast<std::size_t>(block)] = static_cast<std::uint8_t>((word >> (x & 63)) & 1u);
      }
      m_Memory.passY.Search(m_Memory.column.data(), m_Area.Extent(1), firstRow, blocks, m_Memory.needed.data(), found);
    }
    for (std::int64_t row = 0; row < rows; ++row)
    {
      double * const       target = m_Memory.plane.data() + row * pitch + group - m_Area.lower[0];
      const double * const found = m_Memory.found.data() + row;
      for (std::int64_t column = 0; column < ColumnsAtOnce; ++column)
      {
        target[column] = found[column * blocks * BlockSize];
      }
    }
  }
}

double
MedialVoxelFeatureTransform::SliceSearch::SearchAlongX(const std::int64_t z)
{
  const std::int64_t blocks = BlocksOf(m_Remaining.Extent(0));
  const std::int64_t pitch = m_Area.Extent(0) + ColumnsAtOnce;
  MedialVoxelReserve(m_Memory.found, blocks * BlockSize);
  m_Memory.passX.SetLongestRow(m_Area.Extent(0));
  MedialVoxelAbortChecker checker;
  double                  largest = 0.0;
  for (std::int64_t y = m_Remaining.lower[1]; y < m_Remaining.upper[1]; ++y)
  {
    checker.Count(static_cast<std::uint32_t>(m_Area.Extent(0)));
    bool any = false;
    for (std::int64_t block = 0; block < blocks; ++block)
    {
      const bool isNeeded = this->RemainingBits(m_Remaining.lower[0] + block * BlockSize, y, z) != 0;
      m_Memory.needed[static_cast<std::size_t>(block)] = isNeeded ? 1 : 0;
      any = any || isNeeded;
    }
    if (!any)
    {
      continue;
    }
    m_Memory.passX.Search(m_Memory.plane.data() + (y - m_Remaining.lower[1]) * pitch,
                          m_Area.Extent(0),
                          m_Remaining.lower[0] - m_Area.lower[0],
                          blocks,
                          m_Memory.needed.data(),
                          m_Memory.found.data());
    for (std::int64_t block = 0; block < blocks; ++block)
    {
      if (m_Memory.needed[static_cast<std::size_t>(block)])
      {
        const std::int64_t x = m_Remaining.lower[0] + block * BlockSize;
        const WordType     bits = this->RemainingBits(x, y, z);
        largest = std::max(largest, this->StoreBlock(bits, m_Memory.found.data() + block * BlockSize, x, y, z));
      }
    }
  }
  return largest;
}

/** The remaining voxels of the block that begins at \a x. */
WordType
MedialVoxelFeatureTransform::SliceSearch::RemainingBits(const std::int64_t x,
                                                        const std::int64_t y,
                                                        const std::int64_t z) const
{
  constexpr WordType mask = (WordType{ 1 } << BlockSize) - 1;
  const std::int64_t word = x >> 6;
  const auto         shift = static_cast<unsigned int>(x & 63);
  WordType           bits = m_Tile.Remaining(word, y, z) >> shift;
  if (shift > MedialVoxelBits::BitsPerWord - BlockSize && word + 1 < m_Tile.firstWord + m_Tile.words)
  {
    bits |= m_Tile.Remaining(word + 1, y, z) << (MedialVoxelBits::BitsPerWord - shift);
  }
  return bits & mask;
}

/** Squared length of the longest displacement stored, infinite when a voxel has none. */
double
MedialVoxelFeatureTransform::SliceSearch::StoreBlock(WordType             bits,
                                                     const double * const keys,
                                                     const std::int64_t   x,
                                                     const std::int64_t   y,
                                                     const std::int64_t   z) const
{
  const std::size_t offset = m_Tile.features.OffsetOf(x, y, z);
  std::int64_t      largest = 0;
  bool              hasNone = false;
  for (; bits != 0; bits &= bits - 1)
  {
    const int    lane = MedialVoxelLowestBit(bits);
    const double key = keys[lane];
    if (!(key < MedialVoxelSiteKey::NoSite))
    {
      m_Tile.StoreNone(offset + static_cast<std::size_t>(lane));
      hasNone = true;
      continue;
    }
    const MedialVoxelSiteKey site = MedialVoxelSiteKey::Decode(key);
    m_Tile.Store(offset + static_cast<std::size_t>(lane), site.dx, site.dy, site.dz);
    largest = std::max(largest, site.squaredLength);
  }
  return hasNone ? std::numeric_limits<double>::infinity() : static_cast<double>(largest);
}

bool
MedialVoxelFeatureTransform::SearchSlices(Tile & tile, Workspace::Slices & memory) const
{
  const MedialVoxelBox & range = tile.remainingBox;
  std::int64_t           whole = 0; // reach that sees all that is known
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    whole = std::max({ whole, range.upper[axis] - tile.known.lower[axis], tile.known.upper[axis] - range.lower[axis] });
  }
  const double maximumLength = std::ceil(std::min(this->MaximumMetricLength(), static_cast<double>(whole)));
  const auto   wanted = static_cast<std::int64_t>(maximumLength);
  const auto   limit = std::min(wanted, MedialVoxelSiteKey::LongestReach);
  const auto   squareOf = [](const std::int64_t length) { return static_cast<double>(length * length); };

  SliceSearch  search(m_Region, tile, memory);
  std::int64_t reach = std::min(std::max(memory.reach, LeastReach), limit);
  for (std::int64_t z = range.lower[2]; z < range.upper[2] && !tile.IsAborted(); ++z)
  {
    if (!search.IsReady(z))
    {
      search.Prepare(z, reach);
    }
    double squared = search.SearchSlice(z);
    while (squared > squareOf(reach) && reach < limit)
    {
      const double needed = std::min(std::ceil(std::sqrt(squared)), 2.0 * static_cast<double>(limit));
      reach = std::isfinite(squared) ? static_cast<std::int64_t>(needed) + ReachMargin : 2 * reach;
      reach = std::min(reach, limit);
      search.Prepare(z, reach);
      squared = search.SearchSlice(z);
    }
    if (squared > squareOf(limit) && limit < wanted)
    {
      return false;
    }
    if (!this->Accept(tile, squared, z))
    {
      break;
    }
    search.Advance(z);
  }
  memory.reach = static_cast<std::int64_t>(std::ceil(std::sqrt(tile.largestSquaredLength)));
  return true;
}

std::uint64_t
MedialVoxelFeatureTransform::GetBytes(const MedialVoxelIndex & tileSize, const MedialVoxelIndex & searchedSize)
{
  const std::int64_t area = searchedSize[0] * searchedSize[1];
  const std::int64_t blocks = std::max(BlocksOf(tileSize[0]), ColumnsAtOnce * BlocksOf(tileSize[1]));
  const std::int64_t keys =
    searchedSize[1] + BlockSize + blocks * BlockSize + tileSize[1] * (searchedSize[0] + ColumnsAtOnce);
  return static_cast<std::uint64_t>(3 * area) * sizeof(std::int16_t) +
         static_cast<std::uint64_t>((searchedSize[0] / MedialVoxelBits::BitsPerWord + 2) * searchedSize[1]) *
           sizeof(WordType) +
         static_cast<std::uint64_t>(keys) * sizeof(double) + MedialVoxelRowPass::GetBytes(searchedSize[0]) +
         MedialVoxelRowPass::GetBytes(searchedSize[1]);
}

} // end namespace itk
