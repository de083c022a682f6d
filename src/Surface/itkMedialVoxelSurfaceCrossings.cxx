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

/** The cell behind the face of a cell in a direction. */
MedialVoxelIndex
Behind(MedialVoxelIndex cell, const unsigned int direction)
{
  cell[direction / 2] += direction % 2 == 0 ? -1 : 1;
  return cell;
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
  if (m_DecidesTogether)
  {
    missing = this->DecideTogether(tile, workspace);
  }
  // After an abort, too: splits are looked for at whatever edges were found.
  if (this->IsAutomatic() && missing.IsEmpty())
  {
    this->FindThresholdsOfSplits(tile, workspace);
  }
  return missing;
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
      const Workspace::Edge edge{ { { x, row.y, row.z } }, row.axis };
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

/** Decide an edge by what its cells tell, or by the smallest threshold; otherwise make a query of it. */
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
  auto & cells = workspace.m_CellsAround;
  cells.clear();
  ForEachCellAround(edge.voxel, edge.axis, m_Grid.GetCellBox(), [&](const MedialVoxelIndex & cell, unsigned int) {
    cells.push_back(cell);
  });
  MedialVoxelJointClassifier::CrossedPair crossed{ pair.a, pair.GetB(), m_Parameters.epsilon, m_Parameters.epsilon };
  tile.classifier.GetJoint().LookAt(tile.classification.joint, tile.features, cells, crossed);
  // Where floods decide, no length is near the smallest threshold; of shorter ones cells often know no more than that.
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
    { crossed.a, crossed.b, m_Parameters.epsilon, workspace.m_Edges.size(), false, crossed.bounds });
  workspace.m_Edges.push_back(edge);
}

/** Decide the edges of all queries. */
MedialVoxelBox
MedialVoxelSurfaceCrossings::DecideTogether(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  auto & queries = workspace.m_Queries;
  if (this->IsAutomatic() && !queries.empty())
  {
    this->FindThresholds(tile, workspace, [&](auto && add) {
      for (const Workspace::Edge & edge : workspace.m_Edges)
      {
        ForEachCellAround(
          edge.voxel, edge.axis, m_Grid.GetCellBox(), [&](const MedialVoxelIndex & cell, unsigned int) { add(cell); });
      }
    });
  }
  MedialVoxelPollCounter poll;
  const auto             isDecided = [&](MedialVoxelSeparationQuery & query) {
    poll.Count();
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

/** Find the thresholds of the cells that \a visit adds: visit(add) calls add(cell). */
template <typename TVisit>
void
MedialVoxelSurfaceCrossings::FindThresholds(const MedialVoxelClassifiedTile & tile,
                                            Workspace &                       workspace,
                                            TVisit &&                         visit) const
{
  auto & cells = workspace.m_Threshold.cells;
  cells.Reshape(workspace.m_Cells.Expanded(m_Grid.GetUnitMargin()).Intersection(m_Grid.GetCellBox()));
  visit([&](const MedialVoxelIndex & cell) { cells.Set(cell); });
  cells.Rank();
  m_Threshold.Compute(
    MedialVoxelJointClassifier::GetBalls(tile.classification.joint), tile.features, workspace.m_Threshold);
}

/** Find the thresholds on both sides of the faces whose edges are all crossed, for FindSplit(). */
void
MedialVoxelSurfaceCrossings::FindThresholdsOfSplits(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  auto & splits = workspace.m_SplitCells;
  splits.clear();
  const MedialVoxelBox & box = workspace.m_Cells;
  const EdgeMask *       mask = workspace.m_Masks.data();
  MedialVoxelPollCounter poll;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      poll.Count(static_cast<std::uint32_t>(box.Extent(0)) / 8);
      for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x, ++mask)
      {
        for (unsigned int direction = 0; *mask != 0 && direction < Topology::NumberOfDirections; ++direction)
        {
          if (Topology::IsAmbiguous(*mask, direction))
          {
            splits.push_back({ { x, y, z } });
            splits.push_back(Behind({ { x, y, z } }, direction));
          }
        }
      }
    }
  }
  if (splits.empty())
  {
    return;
  }
  this->FindThresholds(tile, workspace, [&](auto && add) {
    for (const MedialVoxelIndex & cell : splits)
    {
      if (m_Grid.GetCellBox().Contains(cell))
      {
        add(cell);
      }
    }
  });
}

/** Decide a query by its threshold, which it gets, and by bounds; false if they do not suffice. */
bool
MedialVoxelSurfaceCrossings::DecideAtOnce(MedialVoxelSeparationQuery & query, Workspace & workspace) const
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
  if (query.bounds.Reach(query.epsilon) || m_Cell.FreeSpaceLength(difference) >= query.epsilon)
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
  const double epsilon =
    std::max(this->EpsilonOf(cell, workspace), this->EpsilonOf(Behind(cell, direction), workspace));
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
