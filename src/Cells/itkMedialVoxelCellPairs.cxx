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
  cells = this->CellAt(features, { { first, y, z } });
  cells.number = std::min(firstOfWord + MedialVoxelBits::BitsPerWord, box.upper[0]) - first;
  cells.candidates = candidates >> (first - firstOfWord);
  return true;
}

MedialVoxelCells
MedialVoxelCellPairs::CellAt(const MedialVoxelFeatures & features, const MedialVoxelIndex & cell) const
{
  MedialVoxelCells cells;
  cells.first = cell;
  cells.number = 1;
  cells.candidates = 1;
  cells.offset = features.OffsetOf(cell[0], cell[1], cell[2]);
  if (m_HasCornerRows)
  {
    cells.corners = CornerRows(features, cells.offset);
  }
  return cells;
}

WordType
MedialVoxelCellPairs::Spread(const MedialVoxelCells & cells) const
{
  return m_HasCornerRows && m_Epsilon > m_Grid.GetLongestEdge()
           ? MedialVoxelSpreadCells(cells.corners, cells.candidates, cells.number)
           : cells.candidates;
}

/** The pair of definition 6; false when it is trivial or no diagonal has two boundary points. */
bool
MedialVoxelCellPairs::Choose(const MedialVoxelFeatures & features,
                             const MedialVoxelCells &    cells,
                             const int                   x,
                             MedialVoxelDiagonal &       widest) const
{
  const auto nx = static_cast<std::size_t>(features.box.Extent(0));
  const auto ny = static_cast<std::size_t>(features.box.Extent(1));
  const auto offset = cells.offset + static_cast<std::size_t>(x);
  const auto displacementOf = [&](const unsigned int corner) -> MedialVoxelDisplacement {
    if (m_HasCornerRows)
    {
      const auto &         rows = cells.corners.rows;
      const unsigned int   row = corner >> 1;
      const std::ptrdiff_t at = x + static_cast<std::ptrdiff_t>(corner & 1u);
      return { { rows[0][row][at], rows[1][row][at], rows[2][row][at] } };
    }
    const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
    const std::size_t at = offset + (static_cast<std::size_t>(c[2]) * ny + static_cast<std::size_t>(c[1])) * nx +
                           static_cast<std::size_t>(c[0]);
    return { { features.dx[at], features.dy[at], features.dz[at] } };
  };
  MedialVoxelPair & pair = widest.pair;
  const auto        setDiagonal = [&](const unsigned int diagonal) {
    widest.number = diagonal;
    pair.displacement = displacementOf(diagonal);
    pair.oppositeDisplacement = displacementOf(m_Cell.GetOppositeCorner(diagonal));
  };

  int number = m_HasCornerRows && m_Grid.HasEqualSpacing() ? MedialVoxelWidestDiagonal(cells.corners, x) : -1;
  if (number < 0)
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (unsigned int diagonal = 0; diagonal < m_Cell.GetNumberOfDiagonals(); ++diagonal)
    {
      setDiagonal(diagonal);
      if (pair.displacement[0] == MedialVoxelNoDisplacement ||
          pair.oppositeDisplacement[0] == MedialVoxelNoDisplacement)
      {
        continue;
      }
      const double key = m_Cell.CosineKey(diagonal, pair.displacement, pair.oppositeDisplacement);
      if (key < smallest)
      {
        smallest = key;
        number = static_cast<int>(diagonal);
      }
    }
    if (number < 0)
    {
      return false;
    }
  }
  setDiagonal(static_cast<unsigned int>(number));
  pair.difference = m_Cell.BoundaryDifference(widest.number, pair.displacement, pair.oppositeDisplacement);
  if (m_Cell.IsTrivial(pair.difference, m_Epsilon))
  {
    return false;
  }
  const MedialVoxelDisplacement & corner = m_Cell.GetCorner(widest.number);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    pair.a[axis] = cells.first[axis] + (axis == 0 ? x : 0) + corner[axis] + pair.displacement[axis];
  }
  return true;
}

} // end namespace itk
