// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelJointClassifier.h"

#include "itkMedialVoxelFloodPrivate.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

namespace itk
{

namespace
{

/** Thickness in voxels of the threshold of the second flood; more does not fit its words. */
constexpr double ThicknessOfFlood = 5.0;

/** Steps along each axis between the points of most cells beside a sheet. */
constexpr std::int64_t ShortSteps = 2;

/** Cells whose own ball would set less than this share of their threshold are probably in a branch of a wall. */
constexpr double LargestBranch = 0.85;

/** The candidates that are in a tile. */
MedialVoxelBits::WordType
CellsWithin(const MedialVoxelBox & tile, const MedialVoxelCells & cells)
{
  if (cells.first[1] < tile.lower[1] || cells.first[1] >= tile.upper[1] || cells.first[2] < tile.lower[2] ||
      cells.first[2] >= tile.upper[2])
  {
    return 0;
  }
  return cells.candidates &
         MedialVoxelBits::RangeMask(0, tile.lower[0] - cells.first[0], tile.upper[0] - cells.first[0]);
}

} // namespace

MedialVoxelJointClassifier::MedialVoxelJointClassifier(const MedialVoxelGrid &       grid,
                                                       const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Pairs(grid, parameters.epsilon)
  , m_Threshold(grid, parameters)
  , m_Flood(grid, parameters.epsilon)
  , m_LengthFlood(grid, MedialVoxelParameters::EpsilonFromThickness(ThicknessOfFlood * grid.GetShortestEdge()))
  , m_Blocks(grid)
  , m_Separation(grid)
{}

MedialVoxelBox
MedialVoxelJointClassifier::Classify(const MedialVoxelTileInput & input,
                                     Workspace &                  workspace,
                                     MedialVoxelTileLabels &      labels) const
{
  const MedialVoxelBits & sites = *input.window.sites;
  workspace.m_Separation.Forget();
  if (!this->Collect(input, workspace, labels))
  {
    return {};
  }
  m_Threshold.SurveyBalls(input.cells, workspace.m_Threshold);
  this->SeparateByBlocks(input, workspace, labels);
  this->BoundCells(input, workspace, labels);
  m_Threshold.RaiseRadii(workspace.m_Threshold);
  this->LabelAtOnce(sites, workspace, labels);
  this->LabelBranches(sites, workspace, labels);
  const MedialVoxelBox missing =
    m_Separation.FindSeparated(sites, input.progress, workspace.m_Separation, workspace.m_Queries);
  if (missing.IsEmpty())
  {
    this->Search(input, workspace, labels);
  }
  return missing;
}

/** Decide a query when the pairs of neighbors suffice. */
bool
MedialVoxelJointClassifier::DecideByNeighbors(const MedialVoxelBits & sites,
                                              const NeighborReach     reach,
                                              const Query &           query,
                                              Workspace &             workspace,
                                              MedialVoxelTileLabels & labels) const
{
  Cell & cell = workspace.m_Cells[query.cell];
  this->FollowNeighbors(workspace, sites, reach, query.epsilon, cell);
  const bool reaches = cell.bounds.Reach(query.epsilon);
  if (!reaches && !cell.bounds.FallShortOf(query.epsilon))
  {
    return false;
  }
  labels.Decide(cell.label, reaches ? MedialVoxelLabel::MedialByGeodesic : MedialVoxelLabel::NonMedial);
  return true;
}

/** From the edges of walls inwards, because each cell may follow the one before. */
void
MedialVoxelJointClassifier::SortInwards(const Workspace &   workspace,
                                        const QueryIterator first,
                                        const QueryIterator last)
{
  const auto & cells = workspace.m_Cells;
  std::sort(first, last, [&](const Query & i, const Query & j) { return cells[i.cell].radius < cells[j.cell].radius; });
}

/** Decide the cells of branches that follow others; branches lie in walls that are thicker than the branch. */
void
MedialVoxelJointClassifier::LabelBranches(const MedialVoxelBits & sites,
                                          Workspace &             workspace,
                                          MedialVoxelTileLabels & labels) const
{
  auto &     queries = workspace.m_Queries;
  const auto isInSheet = [&](const Query & query) {
    return m_Threshold.EpsilonOf(workspace.m_Cells[query.cell].radius) > LargestBranch * query.epsilon;
  };
  const auto branches = std::partition(queries.begin(), queries.end(), isInSheet);
  SortInwards(workspace, branches, queries.end());
  MedialVoxelAbortChecker checker;
  const auto              isDecided = [&](const Query & query) {
    checker.Count();
    return this->DecideByNeighbors(sites, NeighborReach::OneEdge, query, workspace, labels);
  };
  queries.erase(std::remove_if(branches, queries.end(), isDecided), queries.end());
}

/** Decide the queries whose points are separated, then the others one after the other. */
void
MedialVoxelJointClassifier::Search(const MedialVoxelTileInput & input,
                                   Workspace &                  workspace,
                                   MedialVoxelTileLabels &      labels) const
{
  const MedialVoxelBits & sites = *input.window.sites;
  auto &                  queries = workspace.m_Queries;
  const auto              joined =
    std::partition(queries.begin(), queries.end(), [](const Query & query) { return query.isSeparated; });
  std::for_each(queries.begin(), joined, [&](const Query & query) {
    Cell & cell = workspace.m_Cells[query.cell];
    cell.bounds.Tighten(query.bounds);
    labels.Decide(cell.label, MedialVoxelLabel::MedialByGeodesic);
  });
  SortInwards(workspace, joined, queries.end());
  MedialVoxelAbortChecker checker;
  for (auto query = joined; query != queries.end() && !input.progress.IsAborted(); ++query)
  {
    checker.Count();
    if (!this->DecideByNeighbors(sites, NeighborReach::OneEdge, *query, workspace, labels) &&
        !this->DecideByNeighbors(sites, NeighborReach::TwoEdges, *query, workspace, labels))
    {
      Cell &     cell = workspace.m_Cells[query->cell];
      const bool reaches = m_Separation.Reaches(sites, *query, workspace.m_Separation);
      cell.bounds.Tighten(query->bounds);
      labels.Decide(cell.label, reaches ? MedialVoxelLabel::MedialByGeodesic : MedialVoxelLabel::NonMedial);
    }
  }
}

/** Label cells that need no search, and make queries of the rest. */
void
MedialVoxelJointClassifier::LabelAtOnce(const MedialVoxelBits & sites,
                                        Workspace &             workspace,
                                        MedialVoxelTileLabels & labels) const
{
  workspace.m_Queries.clear();
  MedialVoxelAbortChecker checker;
  std::size_t             waiting = 0;
  for (std::size_t i = 0; i < workspace.m_Cells.size(); ++i)
  {
    checker.Count();
    Cell & cell = workspace.m_Cells[i];
    if (!cell.isWaiting)
    {
      continue;
    }
    const MedialVoxelPair & pair = workspace.m_Pairs[waiting];
    const double            epsilon = m_Threshold.EpsilonOf(workspace.m_Threshold.radii[waiting]);
    ++waiting;
    cell.limit = std::min(cell.limit, epsilon);
    if (m_Pairs.GetCell().IsTrivial(pair.difference, epsilon))
    {
      labels.CountTrivialCell();
      continue;
    }
    auto label = this->LabelByBound(pair, epsilon, cell);
    if (!label)
    {
      label = this->LabelByLength(sites, pair, epsilon, cell);
    }
    if (label)
    {
      labels.Decide(cell.label, *label);
    }
    else
    {
      workspace.m_Queries.push_back({ pair.a, pair.GetB(), epsilon, i });
    }
  }
}

/** The label of a cell that is known to be medial before any path is searched for its threshold. */
std::optional<std::uint8_t>
MedialVoxelJointClassifier::LabelByBound(const MedialVoxelPair & pair, const double epsilon, const Cell & cell) const
{
  if (MedialVoxelBoundOf(pair, m_Pairs.GetCell(), m_Parameters.bound) >= epsilon)
  {
    return MedialVoxelLabel::MedialByBound;
  }
  const bool isMedial =
    (cell.isAtFloor && epsilon == m_Parameters.epsilon) ||
    (m_Parameters.bound != MedialVoxelPseudoGeodesicBound::FreeSpace &&
     MedialVoxelBoundOf(pair, m_Pairs.GetCell(), MedialVoxelPseudoGeodesicBound::FreeSpace) >= epsilon);
  return isMedial ? std::optional<std::uint8_t>(MedialVoxelLabel::MedialByGeodesic) : std::nullopt;
}

/** The label of a cell when a flood finds the geodesic distance, or that it is longer than the threshold. */
std::optional<std::uint8_t>
MedialVoxelJointClassifier::LabelByLength(const MedialVoxelBits & sites,
                                          const MedialVoxelPair & pair,
                                          const double            epsilon,
                                          Cell &                  cell) const
{
  if (cell.bounds.shortest == 0.0)
  {
    this->FloodLength(sites, pair, cell);
  }
  if (cell.bounds.FallShortOf(epsilon))
  {
    return MedialVoxelLabel::NonMedial;
  }
  return cell.bounds.Reach(epsilon) ? std::optional<std::uint8_t>(MedialVoxelLabel::MedialByGeodesic) : std::nullopt;
}

/** Find the cells of the tile that are not trivial, and the balls in and around the tile. False when aborted. */
bool
MedialVoxelJointClassifier::Collect(const MedialVoxelTileInput & input,
                                    Workspace &                  workspace,
                                    MedialVoxelTileLabels &      labels) const
{
  const MedialVoxelBox & tile = labels.GetTile();
  auto &                 threshold = workspace.m_Threshold;
  threshold.balls.clear();
  workspace.m_Ranks.Reshape(tile);
  workspace.m_Cells.clear();
  workspace.m_Pairs.clear();
  MedialVoxelAbortChecker checker;
  const auto              visit = [&](MedialVoxelCells & cells) {
    checker.Count(static_cast<std::uint32_t>(cells.number));
    const MedialVoxelBits::WordType nontrivial = m_Pairs.FindNontrivial(cells);
    const MedialVoxelBits::WordType inTile = CellsWithin(tile, cells);
    if (inTile != 0)
    {
      labels.AddCandidates(cells.first, inTile, nontrivial);
    }
    MedialVoxelDiagonalNumbers diagonals;
    for (auto rest = nontrivial; rest != 0; rest &= rest - 1)
    {
      const int           x = MedialVoxelLowestBit(rest);
      const bool          isInTile = ((inTile >> x) & 1u) != 0;
      MedialVoxelDiagonal widest;
      if (!m_Pairs.Choose(input.features, cells, x, widest))
      {
        if (isInTile)
        {
          labels.CountTrivialCell();
        }
        continue;
      }
      const MedialVoxelIndex center{ { cells.first[0] + x, cells.first[1], cells.first[2] } };
      const double           radius = m_Threshold.RadiusOf(widest);
      if (m_Threshold.CanRaise(radius))
      {
        threshold.balls.push_back({ center, radius });
      }
      if (isInTile)
      {
        this->AddCell(center, widest.pair, radius, labels, workspace);
        diagonals.Set(x, widest.number);
      }
    }
    if (inTile != 0)
    {
      labels.KeepDiagonals(cells.first, diagonals);
    }
    return !input.progress.IsAborted();
  };
  // Beyond the features no ball reaches the tile.
  MedialVoxelBox cells = input.features.box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    cells.upper[axis] -= m_Grid.GetUnitMargin()[axis];
  }
  cells = cells.Intersection(m_Threshold.GetCellBox(input.cells));
  if (!m_Pairs.Visit(input.corners, input.features, cells, visit))
  {
    return false;
  }
  workspace.m_Ranks.Rank();
  return true;
}

/** Take a cell of the tile that is not trivial. */
void
MedialVoxelJointClassifier::AddCell(const MedialVoxelIndex &      center,
                                    const MedialVoxelPair &       pair,
                                    const double                  radius,
                                    const MedialVoxelTileLabels & labels,
                                    Workspace &                   workspace) const
{
  Cell cell;
  cell.center = center;
  cell.a = pair.a;
  cell.b = pair.GetB();
  cell.label = labels.OffsetOf(center);
  cell.radius = radius;
  workspace.m_Ranks.Set(center);
  workspace.m_Cells.push_back(cell);
  if (m_Parameters.bound == MedialVoxelPseudoGeodesicBound::Paper)
  {
    workspace.m_Pairs.push_back(pair);
  }
}

/** Decide a cell whose points are near each other, if they are near along the boundary too: most of these cells lie
 * beside a sheet, and blocks cannot decide them. */
bool
MedialVoxelJointClassifier::LabelShortPair(const MedialVoxelBits & sites,
                                           Cell &                  cell,
                                           MedialVoxelTileLabels & labels) const
{
  const MedialVoxelDisplacement difference = cell.GetDifference();
  const auto                    isShort = [](const std::int64_t steps) { return std::abs(steps) <= ShortSteps; };
  if (!std::all_of(difference.begin(), difference.end(), isShort) ||
      m_Flood.Decide(sites, cell.a, difference) != MedialVoxelBitFlood::Result::FallsShort)
  {
    return false;
  }
  cell.bounds.longest = m_Parameters.epsilon;
  cell.isWaiting = false;
  labels.Decide(cell.label, MedialVoxelLabel::NonMedial);
  return true;
}

/** Decide cells when no path between their points is shorter than any threshold they can have. */
void
MedialVoxelJointClassifier::SeparateByBlocks(const MedialVoxelTileInput & input,
                                             Workspace &                  workspace,
                                             MedialVoxelTileLabels &      labels) const
{
  if (m_Parameters.bound == MedialVoxelPseudoGeodesicBound::Paper)
  {
    return;
  }
  const double            margin = this->GetBoundMargin(input, labels);
  MedialVoxelAbortChecker checker;
  for (Cell & cell : workspace.m_Cells)
  {
    checker.Count();
    const bool isLabeled = this->LabelShortPair(*input.window.sites, cell, labels);
    if (!isLabeled || margin > 0.0)
    {
      cell.limit = this->GetLargestEpsilon(cell.center, cell.radius, workspace);
    }
    cell.epsilon = isLabeled ? 0.0 : margin + cell.limit;
  }
  m_Blocks.Tighten(*input.window.sites, input.progress, workspace.m_Blocks, workspace.m_Cells);
  for (Cell & cell : workspace.m_Cells)
  {
    checker.Count();
    // The bound has its own label, for which the threshold itself must be known.
    if (cell.isWaiting && cell.bounds.Reach(cell.epsilon) &&
        m_Pairs.GetCell().FreeSpaceLength(cell.GetDifference()) < m_Threshold.EpsilonOf(cell.radius))
    {
      cell.isWaiting = false;
      labels.Decide(cell.label, MedialVoxelLabel::MedialByGeodesic);
    }
  }
}

/** Find by floods the cells that fall short of the threshold of their own ball; the others wait for their threshold. */
void
MedialVoxelJointClassifier::BoundCells(const MedialVoxelTileInput & input,
                                       Workspace &                  workspace,
                                       MedialVoxelTileLabels &      labels) const
{
  auto & threshold = workspace.m_Threshold;
  threshold.cells.Reshape(labels.GetTile());
  threshold.radii.clear();
  const double            margin = this->GetBoundMargin(input, labels);
  MedialVoxelAbortChecker checker;
  for (Cell & cell : workspace.m_Cells)
  {
    checker.Count();
    if (!cell.isWaiting)
    {
      continue;
    }
    double known = 0.0;
    if (m_Parameters.bound != MedialVoxelPseudoGeodesicBound::Paper)
    {
      const MedialVoxelPair pair{ cell.a, cell.GetDifference(), {}, {} };
      const double          epsilon = m_Threshold.EpsilonOf(cell.radius);
      this->BoundByFloods(*input.window.sites, pair, epsilon, cell);
      if (cell.bounds.longest <= m_Parameters.epsilon || cell.bounds.FallShortOf(epsilon))
      {
        cell.isWaiting = false;
        labels.Decide(cell.label, MedialVoxelLabel::NonMedial);
        continue;
      }
      workspace.m_Pairs.push_back(pair);
      // Balls need not raise a radius whose threshold the cell reaches anyway; the bound has its own label.
      const bool isBounded =
        cell.bounds.shortest > 0.0 && m_Pairs.GetCell().FreeSpaceLength(pair.difference) >= epsilon;
      const double reached = (cell.bounds.shortest - margin) * (1.0 - 3.0 * MedialVoxelResolutionBand);
      known = isBounded ? 0.0 : m_Threshold.RadiusBelow(reached);
    }
    threshold.cells.Set(cell.center);
    threshold.radii.push_back(std::max(cell.radius, known));
  }
  threshold.cells.Rank();
}

/** Bound the geodesic distance of a cell whose threshold is at least \a epsilon by floods. */
void
MedialVoxelJointClassifier::BoundByFloods(const MedialVoxelBits & sites,
                                          const MedialVoxelPair & pair,
                                          const double            epsilon,
                                          Cell &                  cell) const
{
  using Result = MedialVoxelBitFlood::Result;
  if (!m_LengthFlood.IsAvailable())
  {
    cell.bounds.longest = this->LengthOfFewEdges(sites, cell, epsilon);
    return;
  }
  const Result result = m_Flood.Decide(sites, pair.a, pair.difference);
  if (result == Result::FallsShort)
  {
    cell.bounds.longest = m_Parameters.epsilon;
    return;
  }
  cell.isAtFloor = result != Result::Undecided;
  if (epsilon > m_Parameters.epsilon || !cell.isAtFloor)
  {
    this->FloodLength(sites, pair, cell);
  }
}

void
MedialVoxelJointClassifier::FloodLength(const MedialVoxelBits & sites, const MedialVoxelPair & pair, Cell & cell) const
{
  if (const auto length = m_LengthFlood.FindLength(sites, pair.a, pair.difference))
  {
    cell.bounds.longest = *length;
    cell.bounds.shortest = std::min(*length, m_LengthFlood.GetThreshold());
  }
}

/** An upper bound of the geodesic distance of a cell, when its points are joined by so few edges that their sum is
 * shorter than \a epsilon; otherwise infinite. */
double
MedialVoxelJointClassifier::LengthOfFewEdges(const MedialVoxelBits & sites,
                                             const Cell &            cell,
                                             const double            epsilon) const
{
  using Layout = MedialVoxelPlaneLayout;
  const double   edge = m_Grid.GetLongestEdge();
  MedialVoxelBox box{ cell.a, cell.a };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::max(std::min(cell.a[axis], cell.b[axis]) - 1, sites.GetBox().lower[axis]);
    box.upper[axis] = std::min(std::max(cell.a[axis], cell.b[axis]) + 2, sites.GetBox().upper[axis]);
    if (box.Extent(axis) > Layout::Edge)
    {
      return std::numeric_limits<double>::infinity();
    }
  }
  std::array<std::uint8_t, 3> size;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::uint8_t>(box.Extent(axis));
  }
  const auto pointOf = [&](const MedialVoxelIndex & index) {
    const auto row = (index[2] - box.lower[2]) * Layout::Edge + index[1] - box.lower[1];
    return Layout::Point(static_cast<std::uint16_t>(row * Layout::Edge + index[0] - box.lower[0]));
  };
  const auto mostEdges = static_cast<std::int64_t>(epsilon * (1.0 - 2.0 * MedialVoxelResolutionBand) / edge);
  const auto edges = MedialVoxelFlood(
    Layout{}, MedialVoxelLoadPlanes(sites, box.lower, size), pointOf(cell.a), pointOf(cell.b), mostEdges);
  return edges == 0 ? std::numeric_limits<double>::infinity() : static_cast<double>(edges) * edge;
}

} // end namespace itk
