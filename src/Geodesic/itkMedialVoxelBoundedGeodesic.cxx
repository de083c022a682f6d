// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoundedGeodesic.h"

#include "itkMedialVoxelBitFlood.h"
#include "itkMedialVoxelFloodPrivate.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace itk
{

namespace
{

/** Searches over fewer edges cost less than keeping their results. */
constexpr double FewEdges = 8.0;

/** Size of the tiles that the region around a tile is planned for. */
constexpr MedialVoxelIndex PlannedTile{ { 128, 32, 32 } };

/** A region with more points costs more than the searches that would share it. */
constexpr std::uint64_t MostNodes = std::uint64_t{ 1 } << 17;

MedialVoxelDisplacement
Difference(const MedialVoxelIndex & a, const MedialVoxelIndex & b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}

/** An eighth of the voxels of a box with this size and a margin of \a reach on all sides. */
std::uint64_t
EighthOfVoxels(const MedialVoxelIndex & size, const MedialVoxelIndex & reach)
{
  std::uint64_t voxels = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    voxels *= static_cast<std::uint64_t>(size[axis] + 2 * reach[axis]);
  }
  return voxels / 8;
}

/** Voxels along each axis that have half of the length of the threshold. */
MedialVoxelIndex
ReachOf(const MedialVoxelGrid & grid, const double epsilon)
{
  return grid.MarginForMetricLength(0.5 * epsilon / grid.GetMetricUnit());
}

/** None where floods leave hardly anything to search. */
std::uint64_t
MostNodesOfTile(const MedialVoxelGrid & grid, const double epsilon)
{
  return MedialVoxelBitFlood::Covers(grid, epsilon)
           ? 0
           : std::min(MostNodes, EighthOfVoxels(PlannedTile, ReachOf(grid, epsilon)));
}

} // namespace

MedialVoxelBoundedGeodesic::MedialVoxelBoundedGeodesic(const MedialVoxelGrid & grid, const double epsilon)
  : m_Grid(grid)
  , m_Cell(grid)
  , m_Epsilon(epsilon)
  , m_Lower(epsilon * (1.0 - MedialVoxelResolutionBand))
  , m_Upper(epsilon * (1.0 + MedialVoxelResolutionBand))
  , m_HasLandmarks(epsilon > FewEdges * grid.GetShortestEdge())
  , m_Radius(1.4 * m_Upper)
  , m_MostNodesOfTile(MostNodesOfTile(grid, epsilon))
{}

MedialVoxelBox
MedialVoxelBoundedGeodesic::SearchBoxOf(const MedialVoxelGrid &  grid,
                                        const MedialVoxelIndex & a,
                                        const MedialVoxelIndex & b,
                                        const double             length)
{
  // Sums of rounded edges may be a little too small.
  const double                  longest = length * (1.0 + MedialVoxelResolutionBand);
  const MedialVoxelDisplacement difference = Difference(a, b);
  const auto &                  spacing = grid.GetSpacing();
  std::array<double, 3>         focus;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    focus[axis] = 0.5 * static_cast<double>(difference[axis]) * spacing[axis];
  }
  const double squaredFocus = focus[0] * focus[0] + focus[1] * focus[1] + focus[2] * focus[2];
  const double squaredMinor = std::max(0.0, 0.25 * longest * longest - squaredFocus);

  MedialVoxelBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double center = 0.5 * static_cast<double>(a[axis] + b[axis]);
    const double extent =
      std::sqrt(squaredMinor + focus[axis] * focus[axis]) / spacing[axis] * (1.0 + MedialVoxelResolutionBand);
    const double size = static_cast<double>(grid.GetSize()[axis]);
    box.lower[axis] = static_cast<std::int64_t>(std::ceil(std::max(0.0, center - extent)));
    box.upper[axis] = static_cast<std::int64_t>(std::floor(std::min(size - 1.0, center + extent))) + 1;
  }
  return box;
}

double
MedialVoxelBoundedGeodesic::LengthWithin(const MedialVoxelGrid &  grid,
                                         const MedialVoxelIndex & a,
                                         const MedialVoxelIndex & b,
                                         const MedialVoxelBox &   box)
{
  const MedialVoxelDisplacement difference = Difference(a, b);
  const auto &                  spacing = grid.GetSpacing();
  double                        squaredFocus = 0.0;
  double                        squaredMinor = std::numeric_limits<double>::infinity();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double focus = 0.5 * static_cast<double>(difference[axis]) * spacing[axis];
    const double center = 0.5 * static_cast<double>(a[axis] + b[axis]);
    const auto   limit = [&](const double voxels) {
      const double extent = voxels * spacing[axis];
      squaredMinor = std::min(squaredMinor, extent * extent - focus * focus);
    };
    if (box.lower[axis] > 0)
    {
      limit(center - static_cast<double>(box.lower[axis]));
    }
    if (box.upper[axis] < grid.GetSize()[axis])
    {
      limit(static_cast<double>(box.upper[axis] - 1) - center);
    }
    squaredFocus += focus * focus;
  }
  return 2.0 * std::sqrt(squaredMinor + squaredFocus) * (1.0 - 4.0 * MedialVoxelResolutionBand);
}

MedialVoxelBox
MedialVoxelBoundedGeodesic::GetSearchBox(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const
{
  return m_Cell.FreeSpaceLength(Difference(a, b)) > m_Upper ? MedialVoxelBox{} : SearchBoxOf(m_Grid, a, b, m_Epsilon);
}

void
MedialVoxelBoundedGeodesic::Begin(const MedialVoxelBits & boundary,
                                  const MedialVoxelBox &  tile,
                                  Workspace &             workspace) const
{
  // Pairs of a cell lie around it: half of epsilon for their paths, and half of that for oblique walls.
  const MedialVoxelIndex margin = m_Grid.MarginForMetricLength(0.75 * m_Epsilon / m_Grid.GetMetricUnit());
  workspace.m_Boundary = &boundary;
  workspace.m_TileBox =
    m_MostNodesOfTile == 0 ? MedialVoxelBox{} : tile.Expanded(margin).Intersection(boundary.GetBox());
  workspace.m_MostNodesOfTile = m_MostNodesOfTile;
  workspace.m_Tile.graph.Clear();
  workspace.m_Elsewhere.graph.Clear();
}

bool
MedialVoxelBoundedGeodesic::ReachesThreshold(const MedialVoxelIndex & a,
                                             const MedialVoxelIndex & b,
                                             Workspace &              workspace) const
{
  const MedialVoxelBox box = this->GetSearchBox(a, b);
  if (box.IsEmpty())
  {
    return true;
  }
  assert(workspace.m_Boundary != nullptr && workspace.m_Boundary->GetBox().Contains(box));
  const FloodResult flood = this->Flood(*workspace.m_Boundary, box, a, b);
  return flood == FloodResult::Undecided ? this->Search(a, b, box, workspace) : flood == FloodResult::Reaches;
}

namespace
{

/** As much of a box as a flood can hold, around its center. */
MedialVoxelBox
MiddleOf(const MedialVoxelBox & box)
{
  constexpr std::int64_t edge = MedialVoxelPlaneLayout::Edge;
  MedialVoxelBox         middle = box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (box.Extent(axis) > edge)
    {
      middle.lower[axis] += (box.Extent(axis) - edge) / 2;
      middle.upper[axis] = middle.lower[axis] + edge;
    }
  }
  return middle;
}

} // namespace

MedialVoxelBoundedGeodesic::FloodResult
MedialVoxelBoundedGeodesic::Flood(const MedialVoxelBits &  boundary,
                                  const MedialVoxelBox &   searchBox,
                                  const MedialVoxelIndex & a,
                                  const MedialVoxelIndex & b) const
{
  if (a == b)
  {
    return FloodResult::FallsShort;
  }
  const MedialVoxelBox box = MiddleOf(searchBox);
  if (!box.Contains(a) || !box.Contains(b))
  {
    return FloodResult::Undecided;
  }
  using Layout = MedialVoxelPlaneLayout;
  const auto pointOf = [&](const MedialVoxelIndex & index) {
    const auto [x, y, z] =
      MedialVoxelIndex{ { index[0] - box.lower[0], index[1] - box.lower[1], index[2] - box.lower[2] } };
    return Layout::Point(static_cast<std::uint16_t>((z * Layout::Edge + y) * Layout::Edge + x));
  };
  std::array<std::uint8_t, 3> size;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::uint8_t>(box.Extent(axis));
  }
  // No path needs more edges than the box has points.
  constexpr double   mostPoints = Layout::Edge * Layout::Edge * Layout::Edge;
  const auto         mostEdges = static_cast<std::int64_t>(std::min(m_Upper / m_Grid.GetShortestEdge(), mostPoints));
  const Layout::Set  domain = MedialVoxelLoadPlanes(boundary, box.lower, size);
  const std::int64_t edges = MedialVoxelFlood(Layout{}, domain, pointOf(a), pointOf(b), mostEdges);
  if (edges == 0)
  {
    return box == searchBox ? FloodResult::Reaches : FloodResult::Undecided;
  }
  const bool isShort = static_cast<double>(edges) * m_Grid.GetLongestEdge() < m_Lower;
  return isShort ? FloodResult::FallsShort : FloodResult::Undecided;
}

bool
MedialVoxelBoundedGeodesic::Workspace::Region::Build(const MedialVoxelBits & boundary,
                                                     const MedialVoxelBox &  box,
                                                     const std::size_t       mostNodes)
{
  landmarks.Clear();
  return graph.Build(boundary, box, mostNodes);
}

MedialVoxelBoundedGeodesic::Workspace::Region &
MedialVoxelBoundedGeodesic::Workspace::GetRegion(const MedialVoxelBox & searchBox)
{
  if (m_TileBox.Contains(searchBox))
  {
    if (!m_Tile.graph.GetBox().IsEmpty())
    {
      return m_Tile;
    }
    if (m_Tile.Build(*m_Boundary, m_TileBox, m_MostNodesOfTile))
    {
      return m_Tile;
    }
    // Too many points; not to be tried again.
    m_TileBox = {};
  }
  if (!m_Elsewhere.graph.GetBox().Contains(searchBox))
  {
    m_Elsewhere.Build(*m_Boundary, searchBox, MedialVoxelBoundaryGraph::MostNodes);
  }
  return m_Elsewhere;
}

bool
MedialVoxelBoundedGeodesic::Search(const MedialVoxelIndex & a,
                                   const MedialVoxelIndex & b,
                                   const MedialVoxelBox &   searchBox,
                                   Workspace &              workspace) const
{
  MedialVoxelCheckAbort();
  Workspace::Region & region = workspace.GetRegion(searchBox);
  const auto          source = region.graph.NodeOf(a);
  const auto          target = region.graph.NodeOf(b);
  if (!region.graph.AreConnected(source, target))
  {
    return true;
  }
  const auto known = region.landmarks.Compare(source, target, m_Lower, m_Upper);
  if (known != MedialVoxelGeodesicLandmarks::Result::Undecided)
  {
    return known == MedialVoxelGeodesicLandmarks::Result::Longer;
  }
  if (m_HasLandmarks)
  {
    workspace.m_Distances.Compute(region.graph, m_Grid, source, m_Radius);
    region.landmarks.Add(workspace.m_Distances.GetLengths(), m_Radius);
  }
  else
  {
    workspace.m_Distances.ComputeTowards(region.graph, m_Grid, source, target, m_Upper);
  }
  const double length = workspace.m_Distances.GetLengths()[target];
  if (length < m_Lower || length > m_Upper)
  {
    return length > m_Upper;
  }
  return this->ResolveLength(region.graph, source, target, workspace.m_Distances) >= m_Epsilon;
}

std::uint64_t
MedialVoxelBoundedGeodesic::GetBytes(const MedialVoxelGrid & grid, const double epsilon)
{
  constexpr std::uint64_t bytesPerRegionNode =
    MedialVoxelBoundaryGraph::BytesPerNode + MedialVoxelGeodesicLandmarks::BytesPerNode;
  const std::uint64_t elsewhere = EighthOfVoxels({ { 1, 1, 1 } }, ReachOf(grid, epsilon));
  const std::uint64_t tile = MostNodesOfTile(grid, epsilon);
  return (tile + elsewhere) * bytesPerRegionNode +
         std::max(tile, elsewhere) * MedialVoxelBoundaryDistances::BytesPerNode;
}

double
MedialVoxelBoundedGeodesic::ResolveLength(const MedialVoxelBoundaryGraph &         graph,
                                          const MedialVoxelBoundaryGraph::NodeType a,
                                          const MedialVoxelBoundaryGraph::NodeType b,
                                          MedialVoxelBoundaryDistances &           distances) const
{
  using NodeType = MedialVoxelBoundaryGraph::NodeType;
  // Lengths from b to every point of interest prune all partial paths from a that cannot end within the band.
  distances.Compute(graph, m_Grid, b, m_Upper);

  struct PartialPath
  {
    NodeType              node;
    double                length;
    MedialVoxelEdgeCounts counts;
  };
  std::set<std::pair<NodeType, MedialVoxelEdgeCounts>> known;
  std::vector<PartialPath>                             open{ { a, 0.0, {} } };
  double                                               shortest = MedialVoxelBoundaryDistances::NotReached;
  MedialVoxelAbortChecker                              checker;
  while (!open.empty())
  {
    checker.Count();
    const PartialPath path = open.back();
    open.pop_back();
    if (path.node == b)
    {
      shortest = std::min(shortest, MedialVoxelPathLength(m_Grid, path.counts));
      continue;
    }
    graph.VisitNeighbors(path.node, [&](const NodeType node, const unsigned int mask) {
      PartialPath next{ node, path.length + m_Grid.GetEdgeLength(mask), path.counts };
      ++next.counts[mask];
      if (next.length + distances.GetLengths()[node] <= m_Upper && known.emplace(node, next.counts).second)
      {
        open.push_back(next);
      }
    });
  }
  return shortest;
}

} // end namespace itk
