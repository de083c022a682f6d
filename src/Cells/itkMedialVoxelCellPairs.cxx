// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelCellPairs.h"

#include <algorithm>
#include <limits>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

/** Bits of the cells x of a word that have an object corner, for one row of cells. */
WordType
CandidateBits(const MedialVoxelBits &  object,
              const std::int64_t       word,
              const std::int64_t       y,
              const std::int64_t       z,
              const MedialVoxelIndex & margin)
{
  const std::int64_t wordInRow = word - object.GetFirstWord();
  WordType           bits = 0;
  WordType           nextBits = 0;
  for (std::int64_t dz = 0; dz <= margin[2]; ++dz)
  {
    for (std::int64_t dy = 0; dy <= margin[1]; ++dy)
    {
      const WordType * const row = object.GetRow(y + dy, z + dz);
      bits |= row[wordInRow];
      nextBits |= row[wordInRow + 1];
    }
  }
  return margin[0] == 0 ? bits : bits | (bits >> 1) | (nextBits << (MedialVoxelBits::BitsPerWord - 1));
}

/** Displacements at the corners of a cell of a solid volume. */
MedialVoxelCornerRows
CornerRows(const MedialVoxelFeatures & features, const std::size_t offset)
{
  const auto            nx = static_cast<std::size_t>(features.box.Extent(0));
  const auto            slice = nx * static_cast<std::size_t>(features.box.Extent(1));
  MedialVoxelCornerRows corners;
  const std::int32_t *  components[] = { features.dx.data(), features.dy.data(), features.dz.data() };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int32_t * const first = components[axis] + offset;
    corners.rows[axis] = { { first, first + nx, first + slice, first + slice + nx } };
  }
  return corners;
}

} // namespace

MedialVoxelCellPairs::MedialVoxelCellPairs(const MedialVoxelGrid & grid, const double epsilon)
  : m_Grid(grid)
  , m_Cell(grid)
  , m_Epsilon(epsilon)
  , m_HasCornerRows(m_Cell.GetNumberOfCorners() == 8)
{}

/** The cells of a word; false when none is a candidate. */
bool
MedialVoxelCellPairs::Find(const MedialVoxelBits &     object,
                           const MedialVoxelFeatures & features,
                           const MedialVoxelBox &      box,
                           const std::int64_t          word,
                           const std::int64_t          y,
                           const std::int64_t          z,
                           MedialVoxelCells &          cells) const
{
  const WordType candidates = CandidateBits(object, word, y, z, m_Grid.GetUnitMargin()) &
                              MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
  if (candidates == 0)
  {
    return false;
  }
  const std::int64_t firstOfWord = word * MedialVoxelBits::BitsPerWord;
  const std::int64_t first = std::max(firstOfWord, box.lower[0]);
  cells = this->GroupAt(features, { { first, y, z } });
  cells.number = std::min(firstOfWord + MedialVoxelBits::BitsPerWord, box.upper[0]) - first;
  cells.candidates = candidates >> (first - firstOfWord);
  return true;
}

/** Cells from \a first on, of which nothing else is known. */
MedialVoxelCells
MedialVoxelCellPairs::GroupAt(const MedialVoxelFeatures & features, const MedialVoxelIndex & first) const
{
  MedialVoxelCells cells;
  cells.first = first;
  cells.offset = features.OffsetOf(first[0], first[1], first[2]);
  if (m_HasCornerRows)
  {
    cells.corners = CornerRows(features, cells.offset);
  }
  return cells;
}

MedialVoxelCells
MedialVoxelCellPairs::CellsFrom(const MedialVoxelFeatures & features,
                                const MedialVoxelIndex &    first,
                                const WordType              asked) const
{
  MedialVoxelCells cells = this->GroupAt(features, first);
  cells.candidates = asked;
#if defined(__GNUC__)
  constexpr WordType sameLine = 0xFFFF;
  for (WordType rest = m_HasCornerRows ? asked : 0; rest != 0;)
  {
    const int x = MedialVoxelLowestBit(rest);
    rest &= ~(sameLine << x);
    for (const auto & rows : cells.corners.rows)
    {
      for (const std::int32_t * const row : rows)
      {
        __builtin_prefetch(row + x);
      }
    }
  }
#endif
  return cells;
}

MedialVoxelCells
MedialVoxelCellPairs::CellAt(const MedialVoxelFeatures & features, const MedialVoxelIndex & cell) const
{
  MedialVoxelCells cells = this->GroupAt(features, cell);
  cells.number = 1;
  cells.candidates = 1;
  this->FindWidest(1, cells);
  return cells;
}

void
MedialVoxelCellPairs::GetPoints(const MedialVoxelFeatures &       features,
                                const MedialVoxelCells &          cells,
                                const int                         x,
                                std::array<MedialVoxelIndex, 8> & points) const
{
  if (m_HasCornerRows)
  {
    const auto & rows = cells.corners.rows;
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      const unsigned int row = corner >> 1;
      const std::int64_t at = x + static_cast<std::int64_t>(corner & 1u);
      points[corner] = { { cells.first[0] + at + rows[0][row][at],
                           cells.first[1] + static_cast<std::int64_t>(row & 1u) + rows[1][row][at],
                           cells.first[2] + static_cast<std::int64_t>(row >> 1) + rows[2][row][at] } };
    }
    return;
  }
  const std::size_t offset = cells.offset + static_cast<std::size_t>(x);
  for (unsigned int corner = 0; corner < m_Cell.GetNumberOfCorners(); ++corner)
  {
    const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
    const std::size_t               at = this->OffsetOf(features, offset, corner);
    points[corner] = { { cells.first[0] + x + c[0] + features.dx[at],
                         cells.first[1] + c[1] + features.dy[at],
                         cells.first[2] + c[2] + features.dz[at] } };
  }
}

void
MedialVoxelCellPairs::FindWidest(const WordType asked, MedialVoxelCells & cells) const
{
  if (m_HasCornerRows && m_Grid.HasEqualSpacing())
  {
    MedialVoxelWidestDiagonals(cells.corners, asked, cells.number, cells.widest.data());
  }
  else
  {
    cells.widest.fill(-1);
  }
}

WordType
MedialVoxelCellPairs::FindNontrivial(MedialVoxelCells & cells) const
{
  const WordType nontrivial = m_HasCornerRows && m_Epsilon > m_Grid.GetLongestEdge()
                                ? MedialVoxelNontrivialCells(cells.corners, cells.candidates, cells.number)
                                : cells.candidates;
  this->FindWidest(nontrivial, cells);
  return nontrivial;
}

/** Offset of the features at a corner of the cell whose lower corner has \a offset. */
std::size_t
MedialVoxelCellPairs::OffsetOf(const MedialVoxelFeatures & features,
                               const std::size_t           offset,
                               const unsigned int          corner) const
{
  const auto                      nx = static_cast<std::size_t>(features.box.Extent(0));
  const auto                      ny = static_cast<std::size_t>(features.box.Extent(1));
  const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
  return offset + static_cast<std::size_t>(c[0]) +
         (static_cast<std::size_t>(c[2]) * ny + static_cast<std::size_t>(c[1])) * nx;
}

/** The number of the diagonal of a cell with the smallest key, for displacements of any length; negative when no
 * diagonal has two boundary points. */
int
MedialVoxelCellPairs::SmallestKey(const MedialVoxelFeatures & features, const std::size_t offset) const
{
  const auto displacementOf = [&](const unsigned int corner) -> MedialVoxelDisplacement {
    const std::size_t at = this->OffsetOf(features, offset, corner);
    return { { features.dx[at], features.dy[at], features.dz[at] } };
  };
  double smallest = std::numeric_limits<double>::infinity();
  int    number = -1;
  for (unsigned int diagonal = 0; diagonal < m_Cell.GetNumberOfDiagonals(); ++diagonal)
  {
    const MedialVoxelDisplacement first = displacementOf(diagonal);
    const MedialVoxelDisplacement second = displacementOf(m_Cell.GetOppositeCorner(diagonal));
    if (first[0] == MedialVoxelNoDisplacement || second[0] == MedialVoxelNoDisplacement)
    {
      continue;
    }
    const double key = m_Cell.CosineKey(diagonal, first, second);
    if (key < smallest)
    {
      smallest = key;
      number = static_cast<int>(diagonal);
    }
  }
  return number;
}

/** The pair of definition 6; false when it is trivial or no diagonal has two boundary points. */
bool
MedialVoxelCellPairs::Choose(const MedialVoxelFeatures & features,
                             const MedialVoxelCells &    cells,
                             const int                   x,
                             MedialVoxelDiagonal &       widest) const
{
  const std::size_t offset = cells.offset + static_cast<std::size_t>(x);
  int               number = cells.widest[static_cast<std::size_t>(x)];
  if (number < 0)
  {
    number = this->SmallestKey(features, offset);
    if (number < 0)
    {
      return false;
    }
  }
  widest.number = static_cast<unsigned int>(number);
  const unsigned int oppositeNumber = m_Cell.GetOppositeCorner(widest.number);
  const std::size_t  first = this->OffsetOf(features, offset, widest.number);
  const std::size_t  second = this->OffsetOf(features, offset, oppositeNumber);
  // One by one: arrays would be written to memory in parts and read at once, which stalls.
  const std::int64_t              ax = features.dx[first];
  const std::int64_t              ay = features.dy[first];
  const std::int64_t              az = features.dz[first];
  const std::int64_t              bx = features.dx[second];
  const std::int64_t              by = features.dy[second];
  const std::int64_t              bz = features.dz[second];
  const MedialVoxelDisplacement & corner = m_Cell.GetCorner(widest.number);
  const MedialVoxelDisplacement & opposite = m_Cell.GetCorner(oppositeNumber);

  MedialVoxelPair & pair = widest.pair;
  pair.difference = {
    { corner[0] - opposite[0] + (ax - bx), corner[1] - opposite[1] + (ay - by), corner[2] - opposite[2] + (az - bz) }
  };
  if (m_Cell.IsTrivial(pair.difference, m_Epsilon))
  {
    return false;
  }
  pair.a = {
    { cells.first[0] + x + corner[0] + ax, cells.first[1] + corner[1] + ay, cells.first[2] + corner[2] + az }
  };
  pair.displacement = { { ax, ay, az } };
  pair.oppositeDisplacement = { { bx, by, bz } };
  return true;
}

} // end namespace itk
