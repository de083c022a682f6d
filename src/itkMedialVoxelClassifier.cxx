// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClassifier.h"

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

std::size_t
OffsetIn(const MedialVoxelBox & tile, const MedialVoxelIndex & index)
{
  return static_cast<std::size_t>(((index[2] - tile.lower[2]) * tile.Extent(1) + (index[1] - tile.lower[1])) *
                                    tile.Extent(0) +
                                  (index[0] - tile.lower[0]));
}

/** Thresholds in edges from which on single searches are long; below, each cell is decided on its own. */
constexpr double LongEpsilon = 8.0;

bool
DecidesTogether(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  return parameters.mode == MedialVoxelThicknessMode::Automatic ||
         parameters.epsilon >= LongEpsilon * grid.GetShortestEdge();
}

} // namespace

MedialVoxelClassifier::MedialVoxelClassifier(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Pairs(grid, parameters.epsilon)
  , m_Decision(grid, parameters)
{
  if (DecidesTogether(grid, parameters))
  {
    m_Joint.emplace(grid, parameters);
  }
}

MedialVoxelBox
MedialVoxelClassifier::GetVoxelBox(const MedialVoxelBox & tile) const
{
  const bool isAutomatic = m_Parameters.mode == MedialVoxelThicknessMode::Automatic;
  return this->GetCornerBox(isAutomatic ? tile.Expanded(m_Joint->GetThreshold().GetMargin()) : tile);
}

MedialVoxelBox
MedialVoxelClassifier::GetCornerBox(const MedialVoxelBox & tile) const
{
  MedialVoxelBox         box = tile;
  const MedialVoxelIndex margin = m_Grid.GetUnitMargin();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.upper[axis] += margin[axis];
  }
  return box.Intersection(m_Grid.GetVoxelBox());
}

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
  if (!m_Joint)
  {
    return this->ClassifyFixed(window, tile, features, progress, workspace, labels, counts);
  }
  const MedialVoxelBox missing = m_Joint->Classify(window, tile, features, progress, workspace.joint, labels, counts);
  if (workspace.keepsRows && missing.IsEmpty())
  {
    // Observers go on with decisions around the same tile.
    m_Decision.Begin(*window.sites, tile, workspace.geodesic);
    this->KeepRows(window, tile, features, labels, workspace.rows);
  }
  return missing;
}

MedialVoxelBox
MedialVoxelClassifier::ClassifyFixed(const MedialVoxelWindow &   window,
                                     const MedialVoxelBox &      tile,
                                     const MedialVoxelFeatures & features,
                                     const MedialVoxelProgress & progress,
                                     Workspace &                 workspace,
                                     std::vector<std::uint8_t> & labels,
                                     MedialVoxelCounts &         counts) const
{
  m_Decision.Begin(*window.sites, tile, workspace.geodesic);
  MedialVoxelBox missing;
  m_Pairs.Visit(*window.object, features, tile, [&](const MedialVoxelCells & cells) {
    std::uint8_t * const labelsOfCells = labels.data() + OffsetIn(tile, cells.first);
    return this->ClassifyCells(window, cells, features, progress, workspace, labelsOfCells, counts, missing);
  });
  return missing;
}

/** False when aborted. */
bool
MedialVoxelClassifier::ClassifyCells(const MedialVoxelWindow &   window,
                                     const MedialVoxelCells &    cells,
                                     const MedialVoxelFeatures & features,
                                     const MedialVoxelProgress & progress,
                                     Workspace &                 workspace,
                                     std::uint8_t * const        labels,
                                     MedialVoxelCounts &         counts,
                                     MedialVoxelBox &            missing) const
{
  const WordType spread = m_Pairs.Spread(cells);
  counts.candidateCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(cells.candidates));
  counts.trivialCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(cells.candidates & ~spread));
  for (WordType rest = cells.candidates; rest != 0; rest &= rest - 1)
  {
    labels[MedialVoxelLowestBit(rest)] = MedialVoxelLabel::NonMedial;
  }
  WordType byBound = 0;
  WordType byGeodesic = 0;
  for (WordType rest = spread; rest != 0; rest &= rest - 1)
  {
    const int           x = MedialVoxelLowestBit(rest);
    MedialVoxelDiagonal widest;
    if (!m_Pairs.Choose(features, cells, x, widest))
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
    counts.AddDecision(label);
    byBound |= WordType{ label == MedialVoxelLabel::MedialByBound } << x;
    byGeodesic |= WordType{ label == MedialVoxelLabel::MedialByGeodesic } << x;
    labels[x] = label;
  }
  if (workspace.keepsRows)
  {
    workspace.rows.push_back({ cells.first, cells.candidates, byBound, byGeodesic });
  }
  return true;
}

/** The rows that have candidates, from the labels. */
void
MedialVoxelClassifier::KeepRows(const MedialVoxelWindow &         window,
                                const MedialVoxelBox &            tile,
                                const MedialVoxelFeatures &       features,
                                const std::vector<std::uint8_t> & labels,
                                std::vector<MedialVoxelCellRow> & rows) const
{
  m_Pairs.Visit(*window.object, features, tile, [&](const MedialVoxelCells & cells) {
    MedialVoxelCellRow         row{ cells.first, cells.candidates };
    const std::uint8_t * const labelsOfCells = labels.data() + OffsetIn(tile, cells.first);
    for (WordType rest = cells.candidates; rest != 0; rest &= rest - 1)
    {
      const int x = MedialVoxelLowestBit(rest);
      row.byBound |= WordType{ labelsOfCells[x] == MedialVoxelLabel::MedialByBound } << x;
      row.byGeodesic |= WordType{ labelsOfCells[x] == MedialVoxelLabel::MedialByGeodesic } << x;
    }
    rows.push_back(row);
    return true;
  });
}

bool
MedialVoxelClassifier::GetWallPoints(const MedialVoxelFeatures & features,
                                     const MedialVoxelIndex &    cell,
                                     MedialVoxelWallPoints &     wall) const
{
  MedialVoxelDiagonal widest;
  if (!m_Pairs.Choose(features, m_Pairs.CellAt(features, cell), 0, widest))
  {
    return false;
  }
  const MedialVoxelDualCell & geometry = m_Pairs.GetCell();
  wall.numberOfCorners = geometry.GetNumberOfCorners();
  for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
  {
    const MedialVoxelDisplacement & c = geometry.GetCorner(corner);
    const std::size_t               at = features.OffsetOf(cell[0] + c[0], cell[1] + c[1], cell[2] + c[2]);
    wall.corners[corner] = {
      { cell[0] + c[0] + features.dx[at], cell[1] + c[1] + features.dy[at], cell[2] + c[2] + features.dz[at] }
    };
  }
  wall.a = wall.corners[widest.number];
  wall.b = wall.corners[geometry.GetOppositeCorner(widest.number)];
  return true;
}

std::uint64_t
MedialVoxelClassifier::GetWorkspaceBytes(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  return MedialVoxelBoundedGeodesic::GetWorkspaceBytes(grid, parameters.GetLargestEpsilon());
}

std::uint64_t
MedialVoxelClassifier::GetWorkspaceBytesPerVoxel(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  return DecidesTogether(grid, parameters) ? MedialVoxelJointClassifier::BytesPerVoxel : 0;
}

} // end namespace itk
