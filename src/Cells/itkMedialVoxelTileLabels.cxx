// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileLabels.h"

#include <algorithm>

namespace itk
{

MedialVoxelTileLabels::MedialVoxelTileLabels(const MedialVoxelBox &            tile,
                                             std::vector<std::uint8_t> &       labels,
                                             MedialVoxelCounts &               counts,
                                             std::vector<MedialVoxelCellRow> * rows)
  : m_Tile(tile)
  , m_Labels(labels)
  , m_Counts(counts)
  , m_Rows(rows)
{
  m_Labels.assign(static_cast<std::size_t>(tile.NumberOfVoxels()), MedialVoxelLabel::NoObject);
  if (m_Rows != nullptr)
  {
    m_Rows->clear();
  }
}

void
MedialVoxelTileLabels::AddCandidates(const MedialVoxelIndex & first,
                                     const WordType           candidates,
                                     const WordType           nontrivial)
{
  m_Counts.candidateCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(candidates));
  m_Counts.trivialCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(candidates & ~nontrivial));
  // The first cells of a row may be beside the tile.
  const std::size_t offset = m_Tile.OffsetOf(first);
  for (WordType rest = candidates; rest != 0; rest &= rest - 1)
  {
    m_Labels[offset + static_cast<std::size_t>(MedialVoxelLowestBit(rest))] = MedialVoxelLabel::NonMedial;
  }
  if (m_Rows != nullptr)
  {
    // Users of rows keep sums by cells of the tile, from the first one on.
    const std::int64_t before = std::max<std::int64_t>(m_Tile.lower[0] - first[0], 0);
    m_Rows->push_back({ { { first[0] + before, first[1], first[2] } }, candidates >> before });
  }
}

void
MedialVoxelTileLabels::KeepDiagonals(const MedialVoxelIndex & first, const MedialVoxelDiagonalNumbers & diagonals)
{
  if (m_Rows != nullptr)
  {
    MedialVoxelCellRow & row = m_Rows->back();
    const std::int64_t   before = row.first[0] - first[0];
    row.diagonals = { diagonals.lower >> before, diagonals.upper >> before };
  }
}

void
MedialVoxelTileLabels::FinishRows()
{
  if (m_Rows == nullptr)
  {
    return;
  }
  for (MedialVoxelCellRow & row : *m_Rows)
  {
    const std::size_t offset = m_Tile.OffsetOf(row.first);
    for (WordType rest = row.candidates; rest != 0; rest &= rest - 1)
    {
      const int          x = MedialVoxelLowestBit(rest);
      const std::uint8_t label = m_Labels[offset + static_cast<std::size_t>(x)];
      row.byBound |= WordType{ label == MedialVoxelLabel::MedialByBound } << x;
      row.byGeodesic |= WordType{ label == MedialVoxelLabel::MedialByGeodesic } << x;
    }
  }
}

} // end namespace itk
