// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClassifier.h"

#include "itkMedialVoxelPairChoice.h"

#include <algorithm>
#include <array>
#include <limits>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

/** The diagonal of a cell whose boundary points are seen under the widest angle. */
struct MedialVoxelClassifier::Diagonal
{
  unsigned int    number;
  MedialVoxelPair pair;
};

/** Up to 64 cells of a row. */
struct MedialVoxelClassifier::Cells
{
  MedialVoxelIndex      first;
  std::int64_t          number;
  WordType              candidates;
  std::size_t           offset;  // of the features of the first cell
  MedialVoxelCornerRows corners; // of solid volumes
  std::uint8_t *        labels;
};

MedialVoxelClassifier::MedialVoxelClassifier(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Cell(grid)
  , m_Decision(grid, parameters)
  , m_HasCornerRows(m_Cell.GetNumberOfCorners() == 8)
{}

MedialVoxelBox
MedialVoxelClassifier::GetVoxelBox(const MedialVoxelBox & tile) const
{
  MedialVoxelBox         box = tile;
  const MedialVoxelIndex margin = m_Grid.GetUnitMargin();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.upper[axis] += margin[axis];
  }
  return box.Intersection(m_Grid.GetVoxelBox());
}

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

MedialVoxelBox
MedialVoxelClassifier::Classify(const MedialVoxelWindow &   window,
                                const MedialVoxelBox &      tile,
                                const MedialVoxelFeatures & features,
                                const MedialVoxelProgress & progress,
                                Workspace &                 workspace,
                                std::vector<std::uint8_t> & labels,
                                MedialVoxelCounts &         counts) const
{
  labels.assign(static_cast<std::size_t>(tile.NumberOfVoxels()), MedialVoxelLabel::NoObject);
  workspace.rows.clear();
  const MedialVoxelBox cells = tile.Intersection(m_Grid.GetCellBox());
  m_Decision.Begin(*window.sites, tile, workspace.geodesic);
  MedialVoxelBox missing;
  for (std::int64_t z = cells.lower[2]; z < cells.upper[2]; ++z)
  {
    for (std::int64_t y = cells.lower[1]; y < cells.upper[1]; ++y)
    {
      std::uint8_t * const row =
        labels.data() + ((z - tile.lower[2]) * tile.Extent(1) + (y - tile.lower[1])) * tile.Extent(0);
      for (std::int64_t word = cells.lower[0] >> 6; word <= (cells.upper[0] - 1) >> 6; ++word)
      {
        const std::int64_t firstOfWord = word * MedialVoxelBits::BitsPerWord;
        const std::int64_t first = std::max(firstOfWord, cells.lower[0]);
        const WordType     candidates = CandidateBits(*window.object, word, y, z, m_Grid.GetUnitMargin()) &
                                    MedialVoxelBits::RangeMask(word, cells.lower[0], cells.upper[0]);
        if (candidates == 0)
        {
          continue;
        }
        Cells group;
        group.first = { { first, y, z } };
        group.number = std::min(firstOfWord + MedialVoxelBits::BitsPerWord, cells.upper[0]) - first;
        group.candidates = candidates >> (first - firstOfWord);
        group.offset = features.OffsetOf(first, y, z);
        if (m_HasCornerRows)
        {
          group.corners = CornerRows(features, group.offset);
        }
        group.labels = row + (first - tile.lower[0]);
        if (!this->ClassifyCells(window, group, features, progress, workspace, counts, missing))
        {
          return missing;
        }
      }
    }
  }
  return missing;
}

/** False when aborted. */
bool
MedialVoxelClassifier::ClassifyCells(const MedialVoxelWindow &   window,
                                     const Cells &               cells,
                                     const MedialVoxelFeatures & features,
                                     const MedialVoxelProgress & progress,
                                     Workspace &                 workspace,
                                     MedialVoxelCounts &         counts,
                                     MedialVoxelBox &            missing) const
{
  const WordType spread = this->SpreadCells(cells);
  counts.candidateCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(cells.candidates));
  counts.trivialCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(cells.candidates & ~spread));
  for (WordType rest = cells.candidates; rest != 0; rest &= rest - 1)
  {
    cells.labels[MedialVoxelLowestBit(rest)] = MedialVoxelLabel::NonMedial;
  }
  WordType byBound = 0;
  WordType byGeodesic = 0;
  for (WordType rest = spread; rest != 0; rest &= rest - 1)
  {
    const int x = MedialVoxelLowestBit(rest);
    Diagonal  widest;
    if (!this->ChoosePair(features, cells, x, widest))
    {
      ++counts.trivialCells;
      continue;
    }
    // A single search can be long where epsilon is large.
    if (progress.IsAborted())
    {
      return false;
    }
    const std::uint8_t label = m_Decision.Decide(*window.sites, widest.pair, workspace.geodesic, missing);
    counts.boundCells += (label == MedialVoxelLabel::MedialByBound) ? 1 : 0;
    counts.geodesicMedialCells += (label == MedialVoxelLabel::MedialByGeodesic) ? 1 : 0;
    counts.geodesicNonMedialCells += (label == MedialVoxelLabel::NonMedial) ? 1 : 0;
    byBound |= WordType{ label == MedialVoxelLabel::MedialByBound } << x;
    byGeodesic |= WordType{ label == MedialVoxelLabel::MedialByGeodesic } << x;
    cells.labels[x] = label;
  }
  if (workspace.keepsRows)
  {
    workspace.rows.push_back({ cells.first, cells.candidates, byBound, byGeodesic });
  }
  return true;
}

bool
MedialVoxelClassifier::GetWallPoints(const MedialVoxelFeatures & features,
                                     const MedialVoxelIndex &    cell,
                                     MedialVoxelWallPoints &     wall) const
{
  Cells cells;
  cells.first = cell;
  cells.offset = features.OffsetOf(cell[0], cell[1], cell[2]);
  if (m_HasCornerRows)
  {
    cells.corners = CornerRows(features, cells.offset);
  }
  Diagonal widest;
  if (!this->ChoosePair(features, cells, 0, widest))
  {
    return false;
  }
  wall.numberOfCorners = m_Cell.GetNumberOfCorners();
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
    const std::size_t               at = features.OffsetOf(cell[0] + c[0], cell[1] + c[1], cell[2] + c[2]);
    wall.corners[corner] = {
      { cell[0] + c[0] + features.dx[at], cell[1] + c[1] + features.dy[at], cell[2] + c[2] + features.dz[at] }
    };
  }
  wall.a = wall.corners[widest.number];
  wall.b = wall.corners[m_Cell.GetOppositeCorner(widest.number)];
  return true;
}

/** The cells that may have a diagonal that is not trivial. */
WordType
MedialVoxelClassifier::SpreadCells(const Cells & cells) const
{
  return m_HasCornerRows && m_Parameters.epsilon > m_Grid.GetLongestEdge()
           ? MedialVoxelSpreadCells(cells.corners, cells.candidates, cells.number)
           : cells.candidates;
}

/** The pair of definition 6; false when it is trivial or no diagonal has two boundary points. */
bool
MedialVoxelClassifier::ChoosePair(const MedialVoxelFeatures & features,
                                  const Cells &               cells,
                                  const int                   x,
                                  Diagonal &                  widest) const
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
  if (m_Cell.IsTrivial(pair.difference, m_Parameters.epsilon))
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
