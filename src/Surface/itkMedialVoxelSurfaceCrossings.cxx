// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceCrossings.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cstdlib>

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

MedialVoxelDisplacement
DisplacementAt(const MedialVoxelFeatures & features, const std::size_t at)
{
  return { { features.dx[at], features.dy[at], features.dz[at] } };
}

bool
IsAdjacent(const MedialVoxelDisplacement & difference)
{
  return std::abs(difference[0]) <= 1 && std::abs(difference[1]) <= 1 && std::abs(difference[2]) <= 1;
}

/** Calls visit(cell, number) for the cells of a box that an edge is one of, with its number there. */
template <typename TVisitor>
void
ForEachCellAround(const MedialVoxelIndex & voxel,
                  const unsigned int       axis,
                  const MedialVoxelBox &   box,
                  TVisitor &&              visit)
{
  for (unsigned int number = 4 * axis; number < 4 * axis + 4; ++number)
  {
    const MedialVoxelIndex offset = Topology::OffsetOf(number);
    const MedialVoxelIndex cell{ { voxel[0] - offset[0], voxel[1] - offset[1], voxel[2] - offset[2] } };
    if (box.Contains(cell))
    {
      visit(cell, number);
    }
  }
}

} // namespace

MedialVoxelSurfaceCrossings::MedialVoxelSurfaceCrossings(const MedialVoxelGrid &       grid,
                                                         const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(WithProvedBound(parameters))
  , m_DecidesTogether(MedialVoxelClassifier::DecidesTogether(grid, parameters))
  , m_Cell(grid)
  , m_Decision(grid, m_Parameters)
  , m_Threshold(grid, m_Parameters)
  , m_Flood(grid, m_Parameters.epsilon)
  , m_Separation(grid)
{}

MedialVoxelBox
MedialVoxelSurfaceCrossings::Find(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  workspace.m_Cells = tile.box.Intersection(m_Grid.GetCellBox());
  workspace.m_Masks.assign(static_cast<std::size_t>(workspace.m_Cells.NumberOfVoxels()), 0);
  workspace.m_Edges.clear();
  workspace.m_Queries.clear();
  const MedialVoxelBox voxels = tile.classifier.GetCornerBox(tile.box);
  MedialVoxelBox       missing;
  for (std::int64_t z = voxels.lower[2]; z < voxels.upper[2]; ++z)
  {
    for (std::int64_t y = voxels.lower[1]; y < voxels.upper[1] && !tile.progress.IsAborted(); ++y)
    {
      MedialVoxelPoll();
      this->FindInRow(tile, { 0, y, z }, workspace, missing);
      if (y + 1 < voxels.upper[1])
      {
        this->FindInRow(tile, { 1, y, z }, workspace, missing);
      }
      if (z + 1 < voxels.upper[2])
      {
        this->FindInRow(tile, { 2, y, z }, workspace, missing);
      }
    }
  }
  return m_DecidesTogether ? this->DecideTogether(tile, workspace) : missing;
}

void
MedialVoxelSurfaceCrossings::FindInRow(const MedialVoxelClassifiedTile & tile,
                                       const Row &                       row,
                                       Workspace &                       workspace,
                                       MedialVoxelBox &                  missing) const
{
  const MedialVoxelFeatures & features = tile.features;
  const MedialVoxelBits &     object = *tile.window.object;
  const MedialVoxelBox        voxels = tile.classifier.GetCornerBox(tile.box);
  const MedialVoxelIndex      step{ { row.axis == 0 ? 1 : 0, row.axis == 1 ? 1 : 0, row.axis == 2 ? 1 : 0 } };
  const WordType * const      words = object.GetRow(row.y, row.z) - object.GetFirstWord();
  const WordType * const      otherWords = object.GetRow(row.y + step[1], row.z + step[2]) - object.GetFirstWord();
  const std::size_t           first = features.OffsetOf(voxels.lower[0], row.y, row.z);
  const std::size_t  toOther = features.OffsetOf(voxels.lower[0] + step[0], row.y + step[1], row.z + step[2]) - first;
  const std::int64_t end = voxels.upper[0] - step[0];
  const bool         edgesAreTrivial = m_Grid.GetLongestEdge() < m_Parameters.epsilon;

  for (std::int64_t word = voxels.lower[0] >> 6; word <= (voxels.upper[0] - 1) >> 6; ++word)
  {
    const WordType others =
      row.axis == 0 ? (words[word] >> 1) | (words[word + 1] << (MedialVoxelBits::BitsPerWord - 1)) : otherWords[word];
    for (WordType rest = (words[word] | others) & MedialVoxelBits::RangeMask(word, voxels.lower[0], end); rest != 0;
         rest &= rest - 1)
    {
      const std::int64_t x = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(rest);
      const std::size_t  at = first + static_cast<std::size_t>(x - voxels.lower[0]);
      MedialVoxelPair    pair;
      pair.displacement = DisplacementAt(features, at);
      pair.oppositeDisplacement = DisplacementAt(features, at + toOther);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        pair.difference[axis] = pair.displacement[axis] - pair.oppositeDisplacement[axis] - step[axis];
      }
      if ((edgesAreTrivial && IsAdjacent(pair.difference)) || !features.HasSite(at) || !features.HasSite(at + toOther))
      {
        continue;
      }
      pair.a = { { x + pair.displacement[0], row.y + pair.displacement[1], row.z + pair.displacement[2] } };
      const Workspace::Edge edge{ { { x, row.y, row.z } }, row.axis, false };
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

/** Make a query of an edge that the smallest threshold does not decide. */
void
MedialVoxelSurfaceCrossings::AddEdge(const MedialVoxelClassifiedTile & tile,
                                     Workspace::Edge                   edge,
                                     const MedialVoxelPair &           pair,
                                     Workspace &                       workspace) const
{
  using Result = MedialVoxelBitFlood::Result;
  if (m_Cell.IsTrivial(pair.difference, m_Parameters.epsilon))
  {
    return;
  }
  const Result atFloor = m_Flood.Decide(*tile.window.sites, pair.a, pair.difference);
  if (atFloor != Result::FallsShort)
  {
    edge.isAtFloor = atFloor != Result::Undecided;
    workspace.m_Queries.push_back({ pair.a, pair.GetB(), m_Parameters.epsilon, workspace.m_Edges.size() });
    workspace.m_Edges.push_back(edge);
  }
}

/** Decide the edges of all queries. */
MedialVoxelBox
MedialVoxelSurfaceCrossings::DecideTogether(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  auto & queries = workspace.m_Queries;
  this->FindThresholds(tile, workspace);
  MedialVoxelPollCounter poll;
  const auto             isDecided = [&](MedialVoxelSeparationQuery & query) {
    poll.Count();
    return this->DecideAtOnce(tile, query, workspace);
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

/** Find the thresholds of the cells around the edges of queries. */
void
MedialVoxelSurfaceCrossings::FindThresholds(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  if (!this->IsAutomatic() || workspace.m_Edges.empty())
  {
    return;
  }
  const MedialVoxelBox cellBox = m_Grid.GetCellBox();
  auto &               cells = workspace.m_Threshold.cells;
  cells.Reshape(workspace.m_Cells.Expanded({ { 1, 1, 1 } }).Intersection(cellBox));
  for (const Workspace::Edge & edge : workspace.m_Edges)
  {
    ForEachCellAround(
      edge.voxel, edge.axis, cellBox, [&](const MedialVoxelIndex & cell, unsigned int) { cells.Set(cell); });
  }
  cells.Rank();
  m_Threshold.Compute(
    tile.classifier.GetReachingVoxels(tile.window, tile.classification), tile.features, workspace.m_Threshold);
}

/** Decide a query by its threshold, which it gets, by bounds, and by what is known of its cells; false if they do not
 * suffice. */
bool
MedialVoxelSurfaceCrossings::DecideAtOnce(const MedialVoxelClassifiedTile & tile,
                                          MedialVoxelSeparationQuery &      query,
                                          Workspace &                       workspace) const
{
  const Workspace::Edge & edge = workspace.m_Edges[query.cell];
  ForEachCellAround(edge.voxel, edge.axis, m_Grid.GetCellBox(), [&](const MedialVoxelIndex & cell, unsigned int) {
    query.epsilon = std::max(query.epsilon, this->EpsilonOf(cell, workspace));
  });
  MedialVoxelDisplacement difference;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    difference[axis] = query.a[axis] - query.b[axis];
  }
  if (m_Cell.IsTrivial(difference, query.epsilon))
  {
    return true;
  }
  if ((edge.isAtFloor && query.epsilon == m_Parameters.epsilon) || m_Cell.FreeSpaceLength(difference) >= query.epsilon)
  {
    Mark(edge, workspace);
    return true;
  }
  ForEachCellAround(edge.voxel, edge.axis, m_Grid.GetCellBox(), [&](const MedialVoxelIndex & cell, unsigned int) {
    tile.classifier.NarrowByCell(tile.classification, cell, query.a, query.b, query.bounds);
  });
  if (query.bounds.Reach(query.epsilon))
  {
    Mark(edge, workspace);
    return true;
  }
  return query.bounds.FallShortOf(query.epsilon);
}

MedialVoxelSurfaceTopology::Split
MedialVoxelSurfaceCrossings::FindSplit(const MedialVoxelClassifiedTile & tile,
                                       const MedialVoxelIndex &          cell,
                                       const unsigned int                direction,
                                       Workspace &                       workspace,
                                       MedialVoxelBox &                  missing) const
{
  const unsigned int normal = direction / 2;
  MedialVoxelIndex   first = cell;
  first[normal] += direction % 2;
  MedialVoxelIndex behind = cell;
  behind[normal] += direction % 2 == 0 ? -1 : 1;
  const double epsilon = std::max(this->EpsilonOf(cell, workspace), this->EpsilonOf(behind, workspace));
  // The pairs across from each other: that of the first voxel, and the other one.
  bool   isApart[2];
  double squared[2];
  for (unsigned int uneven = 0; uneven < 2; ++uneven)
  {
    MedialVoxelIndex from = first;
    from[(normal + 1) % 3] += uneven;
    MedialVoxelIndex to = first;
    to[(normal + 1) % 3] += 1 - uneven;
    to[(normal + 2) % 3] += 1;
    MedialVoxelPair pair;
    pair.displacement = DisplacementAt(tile.features, tile.features.OffsetOf(from[0], from[1], from[2]));
    pair.oppositeDisplacement = DisplacementAt(tile.features, tile.features.OffsetOf(to[0], to[1], to[2]));
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      pair.a[axis] = from[axis] + pair.displacement[axis];
      pair.difference[axis] = pair.a[axis] - to[axis] - pair.oppositeDisplacement[axis];
    }
    isApart[uneven] = this->AreApart(tile, pair, epsilon, workspace, missing);
    squared[uneven] = m_Grid.SquaredMetricLength(pair.difference[0], pair.difference[1], pair.difference[2]);
  }
  if (isApart[0] && isApart[1])
  {
    return Topology::Unsplit;
  }
  const bool evenAreOfOneSide = isApart[1] || (!isApart[0] && squared[0] <= squared[1]);
  return evenAreOfOneSide ? Topology::AroundUneven : Topology::AroundEven;
}

/** Whether the points of a pair are at least a threshold apart along the boundary. */
bool
MedialVoxelSurfaceCrossings::AreApart(const MedialVoxelClassifiedTile & tile,
                                      const MedialVoxelPair &           pair,
                                      const double                      epsilon,
                                      Workspace &                       workspace,
                                      MedialVoxelBox &                  missing) const
{
  if (m_Cell.IsTrivial(pair.difference, epsilon))
  {
    return false;
  }
  const MedialVoxelBits & sites = *tile.window.sites;
  if (!m_DecidesTogether)
  {
    return m_Decision.Decide(sites, pair, tile.classification.geodesic, missing) != MedialVoxelLabel::NonMedial;
  }
  if (m_Cell.FreeSpaceLength(pair.difference) >= epsilon)
  {
    return true;
  }
  auto & queries = workspace.m_QueryOfSplit;
  queries.assign(1, { pair.a, pair.GetB(), epsilon, 0 });
  const MedialVoxelBox unknown =
    m_Separation.FindSeparated(sites, tile.progress, tile.classification.joint.GetSeparation(), queries);
  if (!unknown.IsEmpty())
  {
    missing = missing.Union(unknown);
    return false;
  }
  return queries[0].isSeparated || m_Separation.Reaches(sites, queries[0], tile.classification.joint.GetSeparation());
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

/** The threshold of a cell around an edge that was a query. */
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
