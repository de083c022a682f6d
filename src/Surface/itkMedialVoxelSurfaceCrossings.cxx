// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceCrossings.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"
#include "itkMedialVoxelNontrivialEdges.h"

#include <algorithm>
#include <limits>

namespace itk
{

using WordType = MedialVoxelBits::WordType;
using Topology = MedialVoxelSurfaceTopology;

namespace
{

MedialVoxelParameters
WithProvedBound(MedialVoxelParameters parameters)
{
  parameters.bound = MedialVoxelPseudoGeodesicBound::FreeSpace;
  return parameters;
}

/** Calls visit(cell, number) for the cells of a box that an edge is one of, with its number there. */
template <typename TVisitor>
void
ForEachCellAround(const MedialVoxelIndex & voxel,
                  const unsigned int       axis,
                  const MedialVoxelBox &   box,
                  TVisitor &&              visit)
{
  // Most edges have all of their cells in the box.
  bool hasAll = true;
  for (unsigned int i = 0; i < 3; ++i)
  {
    hasAll = hasAll && voxel[i] - (i == axis ? 0 : 1) >= box.lower[i] && voxel[i] < box.upper[i];
  }
  for (unsigned int number = 4 * axis; number < 4 * axis + 4; ++number)
  {
    const MedialVoxelIndex & offset = Topology::OffsetOf(number);
    const MedialVoxelIndex   cell{ { voxel[0] - offset[0], voxel[1] - offset[1], voxel[2] - offset[2] } };
    if (hasAll || box.Contains(cell))
    {
      visit(cell, number);
    }
  }
}

MedialVoxelDisplacement
DifferenceOf(const MedialVoxelSeparationQuery & query)
{
  return { { query.a[0] - query.b[0], query.a[1] - query.b[1], query.a[2] - query.b[2] } };
}

} // namespace

MedialVoxelSurfaceCrossings::MedialVoxelSurfaceCrossings(const MedialVoxelGrid &       grid,
                                                         const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(WithProvedBound(parameters))
  , m_CellBox(grid.GetCellBox())
  , m_DecidesTogether(MedialVoxelClassifier::DecidesTogether(grid, parameters))
  , m_Cell(grid)
  , m_Decision(grid, m_Parameters)
  , m_Threshold(grid, m_Parameters)
  , m_Flood(grid, m_Parameters.epsilon)
  , m_Separation(grid)
{}

/** Of the cells of a tile. They are clear when all that were set have been taken. */
void
MedialVoxelSurfaceCrossings::Workspace::ClearMasks()
{
  if (m_HasMasks)
  {
    std::fill(m_Masks.begin(), m_Masks.end(), EdgeMask{ 0 });
  }
  m_Masks.resize(std::max(m_Masks.size(), static_cast<std::size_t>(m_Cells.NumberOfVoxels())));
  m_HasMasks = true;
}

MedialVoxelBox
MedialVoxelSurfaceCrossings::Find(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  workspace.m_Cells = tile.box.Intersection(m_CellBox);
  workspace.ClearMasks();
  workspace.m_Edges.clear();
  workspace.m_Queries.clear();
  const MedialVoxelBox    voxels = tile.classifier.GetCornerBox(tile.box);
  MedialVoxelBox          missing;
  MedialVoxelAbortChecker checker;
  for (std::int64_t z = voxels.lower[2]; z < voxels.upper[2]; ++z)
  {
    for (std::int64_t y = voxels.lower[1]; y < voxels.upper[1] && !tile.progress.IsAborted(); ++y)
    {
      checker.Count(static_cast<std::uint32_t>(voxels.Extent(0)));
      this->FindInRow(tile, voxels, { 0, y, z }, workspace, missing);
      if (y + 1 < voxels.upper[1])
      {
        this->FindInRow(tile, voxels, { 1, y, z }, workspace, missing);
      }
      if (z + 1 < voxels.upper[2])
      {
        this->FindInRow(tile, voxels, { 2, y, z }, workspace, missing);
      }
    }
  }
  if (m_DecidesTogether)
  {
    missing = this->DecideTogether(tile, workspace);
  }
  // After an abort, too: splits are searched at all found edges.
  if (this->IsAutomatic() && missing.IsEmpty())
  {
    this->FindThresholdsOfSplits(tile, workspace);
  }
  return missing;
}

void
MedialVoxelSurfaceCrossings::FindInRow(const MedialVoxelClassifiedTile & tile,
                                       const MedialVoxelBox &            voxels,
                                       const Row &                       row,
                                       Workspace &                       workspace,
                                       MedialVoxelBox &                  missing) const
{
  const MedialVoxelBits & object = *tile.window.object;
  const WordType * const  words = object.GetRow(row.y, row.z) - object.GetFirstWord();
  const WordType * const  otherWords =
    object.GetRow(row.y + (row.axis == 1 ? 1 : 0), row.z + (row.axis == 2 ? 1 : 0)) - object.GetFirstWord();
  const std::int64_t end = voxels.upper[0] - (row.axis == 0 ? 1 : 0);
  for (std::int64_t word = voxels.lower[0] >> 6; word <= (voxels.upper[0] - 1) >> 6; ++word)
  {
    const WordType others =
      row.axis == 0 ? (words[word] >> 1) | (words[word + 1] << (MedialVoxelBits::BitsPerWord - 1)) : otherWords[word];
    const WordType edges = (words[word] | others) & MedialVoxelBits::RangeMask(word, voxels.lower[0], end);
    if (edges != 0)
    {
      const std::int64_t firstOfWord = word * MedialVoxelBits::BitsPerWord;
      const std::int64_t x = std::max(firstOfWord, voxels.lower[0]);
      const std::int64_t number = std::min(firstOfWord + MedialVoxelBits::BitsPerWord, end) - x;
      this->TakeEdges(
        tile, { { { x, row.y, row.z } }, row.axis }, edges >> (x - firstOfWord), number, workspace, missing);
    }
  }
}

/** Decide edges of a row, bit 0 of which is that of \a first. */
void
MedialVoxelSurfaceCrossings::TakeEdges(const MedialVoxelClassifiedTile & tile,
                                       const Workspace::Edge &           first,
                                       WordType                          edges,
                                       const std::int64_t                number,
                                       Workspace &                       workspace,
                                       MedialVoxelBox &                  missing) const
{
  const MedialVoxelFeatures & features = tile.features;
  const MedialVoxelIndex &    voxel = first.voxel;
  const unsigned int          axis = first.axis;
  const std::size_t           begin = features.OffsetOf(voxel[0], voxel[1], voxel[2]);
  const std::int64_t          toUpper =
    axis == 0 ? 1 : (axis == 1 ? features.box.Extent(0) : features.box.Extent(0) * features.box.Extent(1));
  const MedialVoxelDisplacementRows lower{ { &features.dx[begin], &features.dy[begin], &features.dz[begin] } };
  const MedialVoxelDisplacementRows upper{ { lower[0] + toUpper, lower[1] + toUpper, lower[2] + toUpper } };
  if (m_Grid.GetLongestEdge() < m_Parameters.epsilon)
  {
    edges = MedialVoxelNontrivialEdges(lower, upper, axis, edges, number);
  }
  for (WordType rest = edges; rest != 0; rest &= rest - 1)
  {
    const int x = MedialVoxelLowestBit(rest);
    if (lower[0][x] == MedialVoxelNoDisplacement || upper[0][x] == MedialVoxelNoDisplacement)
    {
      continue;
    }
    MedialVoxelPair pair;
    pair.displacement = { { lower[0][x], lower[1][x], lower[2][x] } };
    pair.oppositeDisplacement = { { upper[0][x], upper[1][x], upper[2][x] } };
    for (unsigned int component = 0; component < 3; ++component)
    {
      pair.difference[component] =
        pair.displacement[component] - pair.oppositeDisplacement[component] - (component == axis ? 1 : 0);
    }
    pair.a = { { voxel[0] + x + lower[0][x], voxel[1] + lower[1][x], voxel[2] + lower[2][x] } };
    const Workspace::Edge edge{ { { voxel[0] + x, voxel[1], voxel[2] } }, axis };
    if (m_DecidesTogether)
    {
      this->AddEdge(tile, edge, pair, workspace);
    }
    else
    {
      this->DecideFixed(tile, edge, pair, workspace, missing);
    }
  }
}

void
MedialVoxelSurfaceCrossings::DecideFixed(const MedialVoxelClassifiedTile & tile,
                                         const Workspace::Edge &           edge,
                                         const MedialVoxelPair &           pair,
                                         Workspace &                       workspace,
                                         MedialVoxelBox &                  missing) const
{
  if (!m_Cell.IsTrivial(pair.difference, m_Parameters.epsilon) &&
      m_Decision.Decide(*tile.window.sites, pair, tile.classification.geodesic, missing) != MedialVoxelLabel::NonMedial)
  {
    Mark(edge, workspace);
  }
}

/** Decide an edge by the bounds of its cells, or by the smallest threshold; otherwise make a query of it. */
void
MedialVoxelSurfaceCrossings::AddEdge(const MedialVoxelClassifiedTile & tile,
                                     const Workspace::Edge &           edge,
                                     const MedialVoxelPair &           pair,
                                     Workspace &                       workspace) const
{
  using Result = MedialVoxelBitFlood::Result;
  if (m_Cell.IsTrivial(pair.difference, m_Parameters.epsilon))
  {
    return;
  }
  MedialVoxelJointClassifier::CellsOfEdge around;
  ForEachCellAround(edge.voxel, edge.axis, m_CellBox, [&](const MedialVoxelIndex & cell, unsigned int) {
    around.cells[around.number++] = cell;
  });
  const MedialVoxelIndex                  b = pair.GetB();
  MedialVoxelJointClassifier::CrossedPair crossed{ pair.a, b, m_Parameters.epsilon, m_Parameters.epsilon };
  tile.classifier.GetJoint().LookAt(tile.classification.joint, tile.features, around, crossed);
  // Where floods decide, no length is near the smallest threshold; for shorter ones cells often know only that.
  if ((m_Flood.IsAvailable() && crossed.bounds.longest <= m_Parameters.epsilon) ||
      crossed.bounds.FallShortOf(crossed.leastEpsilon))
  {
    return;
  }
  if (crossed.bounds.Reach(crossed.mostEpsilon))
  {
    Mark(edge, workspace);
    return;
  }
  const Result atFloor = m_Flood.Decide(*tile.window.sites, pair.a, pair.difference);
  if (atFloor == Result::FallsShort || m_Cell.IsTrivial(pair.difference, crossed.leastEpsilon))
  {
    return;
  }
  if ((atFloor != Result::Undecided && crossed.mostEpsilon == m_Parameters.epsilon) ||
      m_Cell.FreeSpaceLength(pair.difference) >= crossed.mostEpsilon)
  {
    Mark(edge, workspace);
    return;
  }
  workspace.m_Queries.push_back(
    { crossed.a, crossed.b, crossed.mostEpsilon, workspace.m_Edges.size(), false, crossed.bounds });
  workspace.m_Edges.push_back(edge);
}

/** Decide edges when no path between their points is shorter than any threshold they can have. */
void
MedialVoxelSurfaceCrossings::SeparateByLimits(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  auto & queries = workspace.m_Queries;
  // Sites that are missing for these thresholds may not be needed for the true ones.
  m_Separation.FindSeparated(*tile.window.sites, tile.progress, tile.classification.joint.GetSeparation(), queries);
  MedialVoxelAbortChecker checker;
  const auto              isDecided = [&](MedialVoxelSeparationQuery & query) {
    checker.Count();
    if (query.isSeparated)
    {
      Mark(workspace.m_Edges[query.cell], workspace);
    }
    query.epsilon = m_Parameters.epsilon;
    return query.isSeparated;
  };
  queries.erase(std::remove_if(queries.begin(), queries.end(), isDecided), queries.end());
}

/** Decide the edges of all queries. */
MedialVoxelBox
MedialVoxelSurfaceCrossings::DecideTogether(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  auto & queries = workspace.m_Queries;
  if (this->IsAutomatic() && !queries.empty())
  {
    this->SeparateByLimits(tile, workspace);
    workspace.m_ThresholdCells.clear();
    for (const MedialVoxelSeparationQuery & query : queries)
    {
      const Workspace::Edge & edge = workspace.m_Edges[query.cell];
      ForEachCellAround(edge.voxel, edge.axis, m_CellBox, [&](const MedialVoxelIndex & cell, unsigned int) {
        workspace.m_ThresholdCells.push_back(cell);
      });
    }
    this->FindRadii(tile, workspace);
    this->RaiseByBounds(workspace);
    m_Threshold.RaiseRadii(tile.classification.joint.GetSurvey(), workspace.m_Threshold);
  }
  MedialVoxelAbortChecker checker;
  const auto              isDecided = [&](MedialVoxelSeparationQuery & query) {
    checker.Count();
    return this->DecideAtOnce(query, workspace);
  };
  queries.erase(std::remove_if(queries.begin(), queries.end(), isDecided), queries.end());
  const MedialVoxelBits & sites = *tile.window.sites;
  const MedialVoxelBox    missing =
    m_Separation.FindSeparated(sites, tile.progress, tile.classification.joint.GetSeparation(), queries);
  if (!missing.IsEmpty())
  {
    return missing;
  }
  for (auto query = queries.begin(); query != queries.end() && !tile.progress.IsAborted(); ++query)
  {
    if (query->isSeparated || m_Separation.Reaches(sites, *query, tile.classification.joint.GetSeparation()))
    {
      Mark(workspace.m_Edges[query->cell], workspace);
    }
  }
  return {};
}

/** Find the radii of the balls of the cells that a workspace lists. */
void
MedialVoxelSurfaceCrossings::FindRadii(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  auto & cells = workspace.m_Threshold.cells;
  cells.Reshape(workspace.m_Cells.Expanded(m_Grid.GetUnitMargin()).Intersection(m_CellBox));
  for (const MedialVoxelIndex & cell : workspace.m_ThresholdCells)
  {
    cells.Set(cell);
  }
  cells.Rank();
  m_Threshold.FindRadii(tile.features, workspace.m_Threshold);
}

/** Raise the radii of the cells as far as all queries around them reach the thresholds anyway, so that balls need
 * not. */
void
MedialVoxelSurfaceCrossings::RaiseByBounds(Workspace & workspace) const
{
  auto &                  threshold = workspace.m_Threshold;
  std::vector<double> &   reached = workspace.m_ReachedRadii;
  MedialVoxelAbortChecker checker;
  reached.assign(threshold.radii.size(), std::numeric_limits<double>::infinity());
  for (const MedialVoxelSeparationQuery & query : workspace.m_Queries)
  {
    checker.Count();
    const double            length = std::max(query.bounds.shortest, m_Cell.FreeSpaceLength(DifferenceOf(query)));
    const double            radius = m_Threshold.RadiusBelow(length * (1.0 - 3.0 * MedialVoxelResolutionBand));
    const Workspace::Edge & edge = workspace.m_Edges[query.cell];
    ForEachCellAround(edge.voxel, edge.axis, m_CellBox, [&](const MedialVoxelIndex & cell, unsigned int) {
      double & ofCell = reached[threshold.cells.RankOf(cell)];
      ofCell = std::min(ofCell, radius);
    });
  }
  std::transform(reached.begin(),
                 reached.end(),
                 threshold.radii.begin(),
                 threshold.radii.begin(),
                 [](const double a, const double b) { return std::max(a, b); });
}

/** Decide a query by its threshold, which it gets, and by bounds; false if they do not suffice. */
bool
MedialVoxelSurfaceCrossings::DecideAtOnce(MedialVoxelSeparationQuery & query, Workspace & workspace) const
{
  const Workspace::Edge & edge = workspace.m_Edges[query.cell];
  ForEachCellAround(edge.voxel, edge.axis, m_CellBox, [&](const MedialVoxelIndex & cell, unsigned int) {
    query.epsilon = std::max(query.epsilon, this->EpsilonOf(cell, workspace));
  });
  const MedialVoxelDisplacement difference = DifferenceOf(query);
  if (m_Cell.IsTrivial(difference, query.epsilon))
  {
    return true;
  }
  if (query.bounds.Reach(query.epsilon) || m_Cell.FreeSpaceLength(difference) >= query.epsilon)
  {
    Mark(edge, workspace);
    return true;
  }
  return query.bounds.FallShortOf(query.epsilon);
}

/** Set the bit of a crossed edge at the cells around it that the tile has. */
void
MedialVoxelSurfaceCrossings::Mark(const Workspace::Edge & edge, Workspace & workspace)
{
  ForEachCellAround(
    edge.voxel, edge.axis, workspace.m_Cells, [&](const MedialVoxelIndex & cell, const unsigned int number) {
      EdgeMask & mask = workspace.m_Masks[workspace.OffsetOf(cell)];
      mask = static_cast<EdgeMask>(mask | (1u << number));
    });
}

/** The threshold of a cell of the last FindThresholds(). */
double
MedialVoxelSurfaceCrossings::EpsilonOf(const MedialVoxelIndex & cell, const Workspace & workspace) const
{
  const auto & threshold = workspace.m_Threshold;
  return this->IsAutomatic() ? m_Threshold.EpsilonOf(threshold.radii[threshold.cells.RankOf(cell)])
                             : m_Parameters.epsilon;
}

std::uint64_t
MedialVoxelSurfaceCrossings::GetBytesPerVoxel(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  constexpr std::uint64_t bytesOfQuery = sizeof(Workspace::Edge) + sizeof(MedialVoxelSeparationQuery) + 128;
  constexpr std::uint64_t bytesOfThreshold = 3 * sizeof(double) + sizeof(MedialVoxelInscribedBall) / 8;
  const bool              isAutomatic = parameters.mode == MedialVoxelThicknessMode::Automatic;
  const bool              hasQueries = MedialVoxelClassifier::DecidesTogether(grid, parameters);
  return sizeof(EdgeMask) + (isAutomatic ? bytesOfThreshold : 0) + (hasQueries ? bytesOfQuery / 8 : 0);
}

} // end namespace itk
