// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelJointClassifier.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace itk
{

namespace
{

/** Relative width of the band below a threshold in which sums in floating point are not trusted. */
constexpr double Band = 1e-9;

/** Thickness in voxels of the threshold of the second flood; more does not fit its words. */
constexpr double ThicknessOfFlood = 5.0;

/** Cells whose own ball would set less than this share of their threshold are probably in a branch of a wall. */
constexpr double LargestBranch = 0.85;

} // namespace

MedialVoxelJointClassifier::MedialVoxelJointClassifier(const MedialVoxelGrid &       grid,
                                                       const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Pairs(grid, parameters.epsilon)
  , m_Threshold(grid, parameters)
  , m_Flood(grid, parameters.epsilon)
  , m_LengthFlood(grid, MedialVoxelParameters::EpsilonFromThickness(ThicknessOfFlood * grid.GetShortestEdge()))
  , m_Separation(grid)
{}

MedialVoxelBox
MedialVoxelJointClassifier::Classify(const MedialVoxelWindow &   window,
                                     const MedialVoxelBox &      tile,
                                     const MedialVoxelFeatures & features,
                                     const MedialVoxelProgress & progress,
                                     Workspace &                 workspace,
                                     std::vector<std::uint8_t> & labels,
                                     MedialVoxelCounts &         counts) const
{
  if (!this->Collect(window, tile, features, progress, workspace, labels, counts))
  {
    return {};
  }
  auto & threshold = workspace.m_Threshold;
  threshold.cells.Rank();
  workspace.m_Ranks.Rank();
  m_Threshold.GetCover().Cover(threshold.balls, threshold.cells, threshold.cover, threshold.coveringRadii);
  this->LabelAtOnce(*window.sites, workspace, labels, counts);

  this->LeaveOutBranches(workspace, labels, counts);
  const MedialVoxelBox missing =
    m_Separation.FindSeparated(*window.sites, progress, workspace.m_Separation, workspace.m_Queries);
  if (missing.IsEmpty())
  {
    this->Search(*window.sites, progress, workspace, labels, counts);
  }
  return missing;
}

void
MedialVoxelJointClassifier::Decide(const Workspace &                  workspace,
                                   const MedialVoxelSeparationQuery & query,
                                   const std::uint8_t                 label,
                                   std::vector<std::uint8_t> &        labels,
                                   MedialVoxelCounts &                counts) const
{
  labels[workspace.m_Cells[query.cell].label] = label;
  counts.AddDecision(label);
}

/** Decide a query when a way along the pair of a neighbor is short. */
bool
MedialVoxelJointClassifier::FallsShort(Workspace &                        workspace,
                                       const MedialVoxelSeparationQuery & query,
                                       std::vector<std::uint8_t> &        labels,
                                       MedialVoxelCounts &                counts) const
{
  Cell & cell = workspace.m_Cells[query.cell];
  this->FollowNeighbors(workspace, cell);
  if (cell.longest >= query.epsilon * (1.0 - Band))
  {
    return false;
  }
  this->Decide(workspace, query, MedialVoxelLabel::NonMedial, labels, counts);
  return true;
}

/** From the edges of walls inwards, as each cell may follow the one before. */
void
MedialVoxelJointClassifier::SortInwards(const Workspace & workspace, const Queries first, const Queries last)
{
  const auto & cells = workspace.m_Cells;
  std::sort(first, last, [&](const MedialVoxelSeparationQuery & i, const MedialVoxelSeparationQuery & j) {
    return cells[i.cell].radius < cells[j.cell].radius;
  });
}

/** Decide the cells of branches that follow others; branches are in walls that are thicker than they are. */
void
MedialVoxelJointClassifier::LeaveOutBranches(Workspace &                 workspace,
                                             std::vector<std::uint8_t> & labels,
                                             MedialVoxelCounts &         counts) const
{
  auto &     queries = workspace.m_Queries;
  const auto isInSheet = [&](const MedialVoxelSeparationQuery & query) {
    return m_Threshold.EpsilonOf(workspace.m_Cells[query.cell].radius, 0.0) > LargestBranch * query.epsilon;
  };
  const auto branches = std::partition(queries.begin(), queries.end(), isInSheet);
  SortInwards(workspace, branches, queries.end());
  const auto fallsShort = [&](const MedialVoxelSeparationQuery & query) {
    return this->FallsShort(workspace, query, labels, counts);
  };
  queries.erase(std::remove_if(branches, queries.end(), fallsShort), queries.end());
}

/** Decide the queries whose points are separated, then the others one after the other. */
void
MedialVoxelJointClassifier::Search(const MedialVoxelBits &     sites,
                                   const MedialVoxelProgress & progress,
                                   Workspace &                 workspace,
                                   std::vector<std::uint8_t> & labels,
                                   MedialVoxelCounts &         counts) const
{
  auto &     queries = workspace.m_Queries;
  const auto joined =
    std::partition(queries.begin(), queries.end(), [](const MedialVoxelSeparationQuery & q) { return q.isSeparated; });
  std::for_each(queries.begin(), joined, [&](const MedialVoxelSeparationQuery & query) {
    this->Decide(workspace, query, MedialVoxelLabel::MedialByGeodesic, labels, counts);
  });
  SortInwards(workspace, joined, queries.end());
  for (auto query = joined; query != queries.end() && !progress.IsAborted(); ++query)
  {
    if (!this->FallsShort(workspace, *query, labels, counts))
    {
      Cell & cell = workspace.m_Cells[query->cell];
      cell.longest = std::min(cell.longest, m_Separation.BoundLength(sites, *query, workspace.m_Separation));
      const bool isShort = cell.longest < query->epsilon;
      this->Decide(
        workspace, *query, isShort ? MedialVoxelLabel::NonMedial : MedialVoxelLabel::MedialByGeodesic, labels, counts);
    }
  }
}

/** Label what needs no search, and make queries of the rest. */
void
MedialVoxelJointClassifier::LabelAtOnce(const MedialVoxelBits &     sites,
                                        Workspace &                 workspace,
                                        std::vector<std::uint8_t> & labels,
                                        MedialVoxelCounts &         counts) const
{
  workspace.m_Queries.clear();
  std::size_t waiting = 0;
  for (std::size_t i = 0; i < workspace.m_Cells.size(); ++i)
  {
    Cell & cell = workspace.m_Cells[i];
    if (cell.longest <= m_Parameters.epsilon)
    {
      continue;
    }
    const MedialVoxelPair & pair = workspace.m_Pairs[waiting];
    const double            epsilon = m_Threshold.EpsilonOf(cell.radius, workspace.m_Threshold.coveringRadii[waiting]);
    ++waiting;
    if (m_Pairs.GetCell().IsTrivial(pair.difference, epsilon))
    {
      ++counts.trivialCells;
    }
    else if (this->BoundOf(pair) >= epsilon)
    {
      labels[cell.label] = MedialVoxelLabel::MedialByBound;
      ++counts.boundCells;
    }
    else if ((cell.isAtFloor && epsilon == m_Parameters.epsilon) ||
             m_Pairs.GetCell().FreeSpaceLength(pair.difference) >= epsilon)
    {
      labels[cell.label] = MedialVoxelLabel::MedialByGeodesic;
      ++counts.geodesicMedialCells;
    }
    else if (const auto label = this->LabelByLength(sites, pair, epsilon, cell))
    {
      labels[cell.label] = *label;
      counts.AddDecision(*label);
    }
    else
    {
      workspace.m_Queries.push_back({ cell.a, cell.b, epsilon, i });
    }
  }
}

/** The label of a cell when a flood finds the geodesic distance, or that it is longer than the threshold. */
std::optional<std::uint8_t>
MedialVoxelJointClassifier::LabelByLength(const MedialVoxelBits & sites,
                                          const MedialVoxelPair & pair,
                                          const double            epsilon,
                                          Cell &                  cell) const
{
  const auto length = m_LengthFlood.FindLength(sites, pair.a, pair.difference);
  if (!length)
  {
    return std::nullopt;
  }
  if (*length < epsilon * (1.0 - Band))
  {
    cell.longest = *length;
    return MedialVoxelLabel::NonMedial;
  }
  const double known = std::min(*length, m_LengthFlood.GetThreshold());
  return known > epsilon * (1.0 + Band) ? std::optional<std::uint8_t>(MedialVoxelLabel::MedialByGeodesic)
                                        : std::nullopt;
}

/** Length of the edge between two boundary points, 0 when they are the same; infinite when there is none. */
double
MedialVoxelJointClassifier::EdgeBetween(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const
{
  unsigned int mask = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t steps = std::abs(a[axis] - b[axis]);
    if (steps > 1)
    {
      return std::numeric_limits<double>::infinity();
    }
    mask |= static_cast<unsigned int>(steps) << axis;
  }
  return m_Grid.GetEdgeLength(mask);
}

/** Bound the geodesic distance of a cell by ways over the pairs of its neighbors. */
void
MedialVoxelJointClassifier::FollowNeighbors(const Workspace & workspace, Cell & cell) const
{
  const MedialVoxelBits & bits = workspace.m_Ranks.GetBits();
  const std::int64_t      x = cell.center[0];
  for (std::int64_t z = cell.center[2] - 1; z <= cell.center[2] + 1; ++z)
  {
    for (std::int64_t y = cell.center[1] - 1; y <= cell.center[1] + 1; ++y)
    {
      if (!bits.HasRow(y, z))
      {
        continue;
      }
      for (auto rest = bits.Extract(x - 1, y, z) & 7u; rest != 0; rest &= rest - 1)
      {
        const std::int64_t neighborX = x - 1 + MedialVoxelLowestBit(rest);
        const auto         bit = MedialVoxelBits::WordType{ 1 } << (neighborX & 63);
        const Cell &       neighbor =
          workspace.m_Cells[workspace.m_Ranks.RankOf((neighborX >> 6) - bits.GetFirstWord(), y, z, bit)];
        if (neighbor.longest < cell.longest)
        {
          const double straight = this->EdgeBetween(cell.a, neighbor.a) + this->EdgeBetween(cell.b, neighbor.b);
          const double crossed = this->EdgeBetween(cell.a, neighbor.b) + this->EdgeBetween(cell.b, neighbor.a);
          cell.longest = std::min(cell.longest, neighbor.longest + std::min(straight, crossed));
        }
      }
    }
  }
}

/** Find the cells of the tile that are not trivial, those that fall short of the smallest threshold as far as a flood
 * can tell, and the balls in and around the tile. False when aborted. */
bool
MedialVoxelJointClassifier::Collect(const MedialVoxelWindow &   window,
                                    const MedialVoxelBox &      tile,
                                    const MedialVoxelFeatures & features,
                                    const MedialVoxelProgress & progress,
                                    Workspace &                 workspace,
                                    std::vector<std::uint8_t> & labels,
                                    MedialVoxelCounts &         counts) const
{
  auto & threshold = workspace.m_Threshold;
  threshold.balls.clear();
  MedialVoxelBits & waiting = threshold.cells.Reshape(tile);
  MedialVoxelBits & all = workspace.m_Ranks.Reshape(tile);
  workspace.m_Cells.clear();
  workspace.m_Pairs.clear();
  const bool usesFlood = m_Parameters.bound != MedialVoxelPseudoGeodesicBound::Paper;
  return m_Pairs.Visit(*window.object, features, m_Threshold.GetCellBox(tile), [&](const MedialVoxelCells & cells) {
    const MedialVoxelBits::WordType spread = m_Pairs.Spread(cells);
    const bool                      isRowOfTile = cells.first[1] >= tile.lower[1] && cells.first[1] < tile.upper[1] &&
                             cells.first[2] >= tile.lower[2] && cells.first[2] < tile.upper[2];
    const MedialVoxelBits::WordType inTile =
      isRowOfTile ? cells.candidates &
                      MedialVoxelBits::RangeMask(0, tile.lower[0] - cells.first[0], tile.upper[0] - cells.first[0])
                  : 0;
    const std::size_t firstLabel = static_cast<std::size_t>(
      ((cells.first[2] - tile.lower[2]) * tile.Extent(1) + (cells.first[1] - tile.lower[1])) * tile.Extent(0) +
      (cells.first[0] - tile.lower[0]));
    counts.candidateCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(inTile));
    counts.trivialCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(inTile & ~spread));
    for (auto rest = inTile; rest != 0; rest &= rest - 1)
    {
      labels[firstLabel + static_cast<std::size_t>(MedialVoxelLowestBit(rest))] = MedialVoxelLabel::NonMedial;
    }
    for (auto rest = spread; rest != 0; rest &= rest - 1)
    {
      const int           x = MedialVoxelLowestBit(rest);
      const bool          isInTile = ((inTile >> x) & 1u) != 0;
      MedialVoxelDiagonal widest;
      if (!m_Pairs.Choose(features, cells, x, widest))
      {
        counts.trivialCells += isInTile ? 1 : 0;
        continue;
      }
      const MedialVoxelIndex center{ { cells.first[0] + x, cells.first[1], cells.first[2] } };
      const double           radius = m_Threshold.RadiusOf(widest);
      if (m_Threshold.CanRaise(radius))
      {
        threshold.balls.push_back({ center, radius });
      }
      if (!isInTile)
      {
        continue;
      }
      const auto              result = usesFlood ? m_Flood.Decide(*window.sites, widest.pair.a, widest.pair.difference)
                                                 : MedialVoxelBitFlood::Result::Undecided;
      const MedialVoxelPair & pair = widest.pair;
      const bool              isShort = result == MedialVoxelBitFlood::Result::FallsShort;
      all.Set(center);
      workspace.m_Cells.push_back(
        { center,
          pair.a,
          { { pair.a[0] - pair.difference[0], pair.a[1] - pair.difference[1], pair.a[2] - pair.difference[2] } },
          firstLabel + static_cast<std::size_t>(x),
          radius,
          isShort ? m_Parameters.epsilon : std::numeric_limits<double>::infinity(),
          !isShort && result != MedialVoxelBitFlood::Result::Undecided });
      if (isShort)
      {
        ++counts.geodesicNonMedialCells;
        continue;
      }
      waiting.Set(center);
      workspace.m_Pairs.push_back(pair);
    }
    return !progress.IsAborted();
  });
}

double
MedialVoxelJointClassifier::BoundOf(const MedialVoxelPair & pair) const
{
  switch (m_Parameters.bound)
  {
    case MedialVoxelPseudoGeodesicBound::FreeSpace:
      return m_Pairs.GetCell().FreeSpaceLength(pair.difference);
    case MedialVoxelPseudoGeodesicBound::Paper:
      return m_Pairs.GetCell().PseudoGeodesicDistance(pair.displacement, pair.oppositeDisplacement);
    case MedialVoxelPseudoGeodesicBound::Off:
      break;
  }
  return 0.0;
}

} // end namespace itk
