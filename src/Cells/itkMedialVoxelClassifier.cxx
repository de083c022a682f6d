// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClassifier.h"

#include "itkMedialVoxelProgress.h"

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

/** Thresholds in edges from which on single searches are long; below, each cell is decided on its own. */
constexpr double LongEpsilon = 8.0;

} // namespace

bool
MedialVoxelClassifier::DecidesTogether(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  return parameters.mode == MedialVoxelThicknessMode::Automatic ||
         parameters.epsilon >= LongEpsilon * grid.GetShortestEdge();
}

MedialVoxelClassifier::MedialVoxelClassifier(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Pairs(grid, parameters.epsilon)
  , m_Reaching(grid)
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
  return this->GetCornerBox(this->IsAutomatic() ? tile.Expanded(m_Joint->GetThreshold().GetMargin()) : tile);
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
MedialVoxelClassifier::GetCells(const MedialVoxelBox & tile, const bool looksAround) const
{
  return (looksAround ? tile.Expanded(m_Grid.GetUnitMargin()) : tile).Intersection(m_Grid.GetCellBox());
}

MedialVoxelWindow
MedialVoxelClassifier::FindAsked(const MedialVoxelWindow & window,
                                 const MedialVoxelBox &    tile,
                                 const bool                looksAround,
                                 Workspace &               workspace) const
{
  MedialVoxelWindow result = window;
  if (this->IsAutomatic())
  {
    workspace.cells = this->GetCells(tile, looksAround);
    m_Reaching.Find(*window.object, workspace.cells, this->GetVoxelBox(tile), workspace.reaching);
    result.asked = &workspace.reaching.asked;
  }
  return result;
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
  if (window.asked == nullptr)
  {
    workspace.cells = this->GetCells(tile, this->IsAutomatic());
  }
  const MedialVoxelTileInput input{ window, workspace.cells, GetReachingVoxels(window, workspace), features, progress };
  MedialVoxelTileLabels      tileLabels(tile, labels, counts, workspace.keepsRows ? &workspace.rows : nullptr);
  if (!m_Joint || workspace.keepsRows)
  {
    // Observers get the rows and continue searches around the same tile.
    m_Decision.Begin(*window.sites, tile, workspace.geodesic);
  }
  const MedialVoxelBox missing = m_Joint ? m_Joint->Classify(input, workspace.joint, tileLabels)
                                         : this->ClassifyEach(input, workspace.geodesic, tileLabels);
  tileLabels.FinishRows();
  return missing;
}

MedialVoxelBox
MedialVoxelClassifier::ClassifyEach(const MedialVoxelTileInput &         input,
                                    MedialVoxelPairDecision::Workspace & workspace,
                                    MedialVoxelTileLabels &              labels) const
{
  MedialVoxelBox          missing;
  MedialVoxelAbortChecker checker;
  m_Pairs.Visit(input.corners, input.features, labels.GetTile(), [&](MedialVoxelCells & cells) {
    checker.Count(static_cast<std::uint32_t>(cells.number));
    return this->ClassifyCells(input, cells, workspace, labels, missing);
  });
  return missing;
}

/** False when aborted. */
bool
MedialVoxelClassifier::ClassifyCells(const MedialVoxelTileInput &         input,
                                     MedialVoxelCells &                   cells,
                                     MedialVoxelPairDecision::Workspace & workspace,
                                     MedialVoxelTileLabels &              labels,
                                     MedialVoxelBox &                     missing) const
{
  const WordType nontrivial = m_Pairs.FindNontrivial(cells);
  labels.AddCandidates(cells.first, cells.candidates, nontrivial);
  const std::size_t          offset = labels.OffsetOf(cells.first);
  MedialVoxelDiagonalNumbers diagonals;
  for (WordType rest = nontrivial; rest != 0; rest &= rest - 1)
  {
    const int           x = MedialVoxelLowestBit(rest);
    MedialVoxelDiagonal widest;
    if (!m_Pairs.Choose(input.features, cells, x, widest))
    {
      labels.CountTrivialCell();
      continue;
    }
    // A single search can be long where epsilon is large.
    if (input.progress.IsAborted())
    {
      return false;
    }
    diagonals.Set(x, widest.number);
    labels.Decide(offset + static_cast<std::size_t>(x),
                  m_Decision.Decide(*input.window.sites, widest.pair, workspace, missing));
  }
  labels.KeepDiagonals(cells.first, diagonals);
  return true;
}

bool
MedialVoxelClassifier::GetWallPoints(const MedialVoxelFeatures & features,
                                     const MedialVoxelIndex &    cell,
                                     MedialVoxelWallPoints &     wall) const
{
  const MedialVoxelCells cells = m_Pairs.CellAt(features, cell);
  MedialVoxelDiagonal    widest;
  const bool             hasPair = m_Pairs.Choose(features, cells, 0, widest);
  if (hasPair)
  {
    this->GetWallPoints(features, cells, 0, widest.number, wall);
  }
  return hasPair;
}

void
MedialVoxelClassifier::GetWallPoints(const MedialVoxelFeatures & features,
                                     const MedialVoxelCells &    cells,
                                     const int                   x,
                                     const unsigned int          diagonal,
                                     MedialVoxelWallPoints &     wall) const
{
  const MedialVoxelDualCell & geometry = m_Pairs.GetCell();
  wall.numberOfCorners = geometry.GetNumberOfCorners();
  m_Pairs.GetPoints(features, cells, x, wall.corners);
  wall.cell = { { cells.first[0] + x, cells.first[1], cells.first[2] } };
  wall.a = wall.corners[diagonal];
  wall.b = wall.corners[geometry.GetOppositeCorner(diagonal)];
}

std::uint64_t
MedialVoxelClassifier::GetBytes(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  return MedialVoxelBoundedGeodesic::GetBytes(grid, parameters.GetLargestEpsilon());
}

std::uint64_t
MedialVoxelClassifier::GetBytesPerVoxel(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  const bool isAutomatic = parameters.mode == MedialVoxelThicknessMode::Automatic;
  return (DecidesTogether(grid, parameters) ? MedialVoxelJointClassifier::BytesPerVoxel : 0) +
         (isAutomatic ? MedialVoxelReachingVoxels::BytesPerVoxel : 0);
}

} // end namespace itk
