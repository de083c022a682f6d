// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoundedGeodesic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Relative width of the band around epsilon in which lengths are resolved exactly; sums err by far less. */
constexpr double Band = 1e-9;

/** Edge of the box that fits a word per plane. */
constexpr std::int64_t FloodSize = 8;

MedialVoxelDisplacement
Difference(const MedialVoxelIndex & a, const MedialVoxelIndex & b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}

unsigned int
ChangedAxes(const MedialVoxelIndex & a, const MedialVoxelIndex & b)
{
  return (a[0] != b[0] ? 1u : 0u) | (a[1] != b[1] ? 2u : 0u) | (a[2] != b[2] ? 4u : 0u);
}

} // namespace

MedialVoxelBoundedGeodesic::MedialVoxelBoundedGeodesic(const MedialVoxelGrid & grid, const double epsilon)
  : m_Grid(grid)
  , m_Cell(grid)
  , m_Epsilon(epsilon)
  , m_Lower(epsilon * (1.0 - Band))
  , m_Upper(epsilon * (1.0 + Band))
{}

MedialVoxelBox
MedialVoxelBoundedGeodesic::GetSearchBox(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const
{
  const MedialVoxelDisplacement difference = Difference(a, b);
  if (m_Cell.FreeSpaceLength(difference) > m_Upper)
  {
    return {};
  }
  const auto &          spacing = m_Grid.GetSpacing();
  std::array<double, 3> focus;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    focus[axis] = 0.5 * static_cast<double>(difference[axis]) * spacing[axis];
  }
  const double squaredFocus = focus[0] * focus[0] + focus[1] * focus[1] + focus[2] * focus[2];
  const double squaredMinor = std::max(0.0, 0.25 * m_Upper * m_Upper - squaredFocus);

  MedialVoxelBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double center = 0.5 * static_cast<double>(a[axis] + b[axis]);
    const double extent = std::sqrt(squaredMinor + focus[axis] * focus[axis]) / spacing[axis] * (1.0 + Band);
    const double size = static_cast<double>(m_Grid.GetSize()[axis]);
    box.lower[axis] = static_cast<std::int64_t>(std::ceil(std::max(0.0, center - extent)));
    box.upper[axis] = static_cast<std::int64_t>(std::floor(std::min(size - 1.0, center + extent))) + 1;
  }
  return box;
}

bool
MedialVoxelBoundedGeodesic::ReachesThreshold(const MedialVoxelBits &  boundary,
                                             const MedialVoxelIndex & a,
                                             const MedialVoxelIndex & b,
                                             Workspace &              workspace) const
{
  const MedialVoxelBox box = this->GetSearchBox(a, b);
  if (box.IsEmpty())
  {
    return true;
  }
  const FloodResult flood = this->Flood(boundary, box, a, b);
  if (flood != FloodResult::Undecided)
  {
    return flood == FloodResult::Reaches;
  }
  workspace.Load(boundary, box);
  const double length = this->ShortestLength(a, b, workspace);
  if (length < m_Lower)
  {
    return false;
  }
  if (length > m_Upper)
  {
    return true;
  }
  return this->ResolveLength(a, b, workspace) >= m_Epsilon;
}

namespace
{

/** Eight planes of 8 x 8 bits, x fastest. */
using FloodPlanes = std::array<WordType, FloodSize>;

constexpr WordType FirstColumn = 0x0101010101010101u;
constexpr WordType LastColumn = 0x8080808080808080u;

/** One step of 26-connected dilation. */
FloodPlanes
Dilate(const FloodPlanes & planes)
{
  FloodPlanes inPlane;
  for (std::size_t z = 0; z < planes.size(); ++z)
  {
    const WordType row = planes[z] | ((planes[z] << 1) & ~FirstColumn) | ((planes[z] >> 1) & ~LastColumn);
    inPlane[z] = row | (row << FloodSize) | (row >> FloodSize);
  }
  FloodPlanes result = inPlane;
  for (std::size_t z = 1; z < planes.size(); ++z)
  {
    result[z] |= inPlane[z - 1];
    result[z - 1] |= inPlane[z];
  }
  return result;
}

} // namespace

MedialVoxelBoundedGeodesic::FloodResult
MedialVoxelBoundedGeodesic::Flood(const MedialVoxelBits &  boundary,
                                  const MedialVoxelBox &   box,
                                  const MedialVoxelIndex & a,
                                  const MedialVoxelIndex & b) const
{
  if (box.Extent(0) > FloodSize || box.Extent(1) > FloodSize || box.Extent(2) > FloodSize)
  {
    return FloodResult::Undecided;
  }
  FloodPlanes    domain{};
  const WordType columns = (WordType{ 1 } << box.Extent(0)) - 1;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      domain[static_cast<std::size_t>(z - box.lower[2])] |= (boundary.Extract(box.lower[0], y, z) & columns)
                                                            << (FloodSize * (y - box.lower[1]));
    }
  }
  const auto plane = [&](const MedialVoxelIndex & index) { return static_cast<std::size_t>(index[2] - box.lower[2]); };
  const auto bit = [&](const MedialVoxelIndex & index) {
    return WordType{ 1 } << (FloodSize * (index[1] - box.lower[1]) + (index[0] - box.lower[0]));
  };

  FloodPlanes reached{};
  reached[plane(a)] = bit(a);
  if (a == b)
  {
    return FloodResult::FallsShort;
  }
  // No path needs more edges than the box has points.
  const double mostEdges = static_cast<double>(FloodSize * FloodSize * FloodSize);
  const auto   longestPath = static_cast<std::int64_t>(std::min(m_Upper / m_Grid.GetShortestEdge(), mostEdges));
  for (std::int64_t edges = 1; edges <= longestPath; ++edges)
  {
    FloodPlanes next = Dilate(reached);
    for (std::size_t z = 0; z < next.size(); ++z)
    {
      next[z] &= domain[z];
    }
    if (next[plane(b)] & bit(b))
    {
      const bool isShort = static_cast<double>(edges) * m_Grid.GetLongestEdge() < m_Lower;
      return isShort ? FloodResult::FallsShort : FloodResult::Undecided;
    }
    if (next == reached)
    {
      break;
    }
    reached = next;
  }
  return FloodResult::Reaches;
}

void
MedialVoxelBoundedGeodesic::Workspace::Load(const MedialVoxelBits & boundary, const MedialVoxelBox & box)
{
  m_Box = box;
  m_WordsPerRow = (box.Extent(0) + MedialVoxelBits::BitsPerWord - 1) / MedialVoxelBits::BitsPerWord;
  m_NumberOfNodes = 0;
  m_Words.clear();
  m_NodesBefore.clear();
  m_Indices.clear();
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      for (std::int64_t x = box.lower[0]; x < box.upper[0]; x += MedialVoxelBits::BitsPerWord)
      {
        const WordType bits = boundary.Extract(x, y, z) & MedialVoxelBits::RangeMask(0, 0, box.upper[0] - x);
        m_Words.push_back(bits);
        m_NodesBefore.push_back(m_NumberOfNodes);
        for (WordType rest = bits; rest != 0; rest &= rest - 1)
        {
          m_Indices.push_back({ { x + MedialVoxelLowestBit(rest), y, z } });
          ++m_NumberOfNodes;
        }
      }
    }
  }
}

std::int64_t
MedialVoxelBoundedGeodesic::Workspace::NodeOf(const MedialVoxelIndex & index) const
{
  const std::int64_t x = index[0] - m_Box.lower[0];
  const std::int64_t row = (index[2] - m_Box.lower[2]) * m_Box.Extent(1) + (index[1] - m_Box.lower[1]);
  const auto         word = static_cast<std::size_t>(row * m_WordsPerRow + (x >> 6));
  const WordType     before = m_Words[word] & ((WordType{ 1 } << (x & 63)) - 1);
  return m_NodesBefore[word] + MedialVoxelPopulationCount(before);
}

template <typename TVisitor>
void
MedialVoxelBoundedGeodesic::Workspace::VisitNeighbors(const MedialVoxelIndex & index, TVisitor && visit) const
{
  const std::int64_t firstX = std::max(index[0] - 1, m_Box.lower[0]);
  const std::int64_t lastX = std::min(index[0] + 1, m_Box.upper[0] - 1);
  for (std::int64_t z = std::max(index[2] - 1, m_Box.lower[2]); z < std::min(index[2] + 2, m_Box.upper[2]); ++z)
  {
    for (std::int64_t y = std::max(index[1] - 1, m_Box.lower[1]); y < std::min(index[1] + 2, m_Box.upper[1]); ++y)
    {
      const std::int64_t     row = (z - m_Box.lower[2]) * m_Box.Extent(1) + (y - m_Box.lower[1]);
      const WordType * const words = m_Words.data() + row * m_WordsPerRow;
      for (std::int64_t x = firstX; x <= lastX; ++x)
      {
        const std::int64_t     bit = x - m_Box.lower[0];
        const MedialVoxelIndex neighbor{ { x, y, z } };
        if (((words[bit >> 6] >> (bit & 63)) & 1u) != 0 && neighbor != index)
        {
          visit(this->NodeOf(neighbor), ChangedAxes(index, neighbor));
        }
      }
    }
  }
}

namespace
{

/** Order of the queue: the smallest bound first, then the node number, so that runs repeat. */
template <typename TEntry>
bool
IsLater(const TEntry & a, const TEntry & b)
{
  return a.bound != b.bound ? a.bound > b.bound : a.node > b.node;
}

} // namespace

void
MedialVoxelBoundedGeodesic::Workspace::Push(const QueueEntry & entry)
{
  m_Queue.push_back(entry);
  std::push_heap(m_Queue.begin(), m_Queue.end(), IsLater<QueueEntry>);
}

MedialVoxelBoundedGeodesic::Workspace::QueueEntry
MedialVoxelBoundedGeodesic::Workspace::Pop()
{
  std::pop_heap(m_Queue.begin(), m_Queue.end(), IsLater<QueueEntry>);
  const QueueEntry entry = m_Queue.back();
  m_Queue.pop_back();
  return entry;
}

std::uint64_t
MedialVoxelBoundedGeodesic::GetWorkspaceBytes(const MedialVoxelIndex & reach)
{
  constexpr std::uint64_t bytesPerPoint = sizeof(MedialVoxelIndex) + sizeof(double) + sizeof(Workspace::QueueEntry);
  std::uint64_t           voxels = 1;
  for (const std::int64_t length : reach)
  {
    voxels *= static_cast<std::uint64_t>(2 * length + 1);
  }
  return voxels * bytesPerPoint / 4;
}

double
MedialVoxelBoundedGeodesic::ShortestLength(const MedialVoxelIndex & source,
                                           const MedialVoxelIndex & target,
                                           Workspace &              workspace) const
{
  workspace.m_Length.assign(static_cast<std::size_t>(workspace.m_NumberOfNodes), Infinity);
  workspace.m_Queue.clear();
  const std::int64_t targetNode = workspace.NodeOf(target);
  const std::int64_t sourceNode = workspace.NodeOf(source);
  workspace.m_Length[static_cast<std::size_t>(sourceNode)] = 0.0;
  workspace.Push({ m_Cell.FreeSpaceLength(Difference(source, target)), 0.0, sourceNode });

  // Every node that a path of at most m_Upper can use gets its length, unless a path below the band ends the search.
  while (!workspace.m_Queue.empty())
  {
    const auto entry = workspace.Pop();
    if (entry.length > workspace.m_Length[static_cast<std::size_t>(entry.node)])
    {
      continue;
    }
    const MedialVoxelIndex index = workspace.m_Indices[static_cast<std::size_t>(entry.node)];
    workspace.VisitNeighbors(index, [&](const std::int64_t node, const unsigned int mask) {
      const double length = entry.length + m_Grid.GetEdgeLength(mask);
      if (length < workspace.m_Length[static_cast<std::size_t>(node)])
      {
        const MedialVoxelIndex & neighbor = workspace.m_Indices[static_cast<std::size_t>(node)];
        const double             bound = length + m_Cell.FreeSpaceLength(Difference(neighbor, target));
        if (bound <= m_Upper)
        {
          workspace.m_Length[static_cast<std::size_t>(node)] = length;
          workspace.Push({ bound, length, node });
        }
      }
    });
    if (workspace.m_Length[static_cast<std::size_t>(targetNode)] < m_Lower)
    {
      break;
    }
  }
  return workspace.m_Length[static_cast<std::size_t>(targetNode)];
}

double
MedialVoxelBoundedGeodesic::ResolveLength(const MedialVoxelIndex & a,
                                          const MedialVoxelIndex & b,
                                          Workspace &              workspace) const
{
  // Lengths from b to every node of interest prune all partial paths from a that cannot end within the band.
  this->ShortestLength(b, a, workspace);

  struct PartialPath
  {
    std::int64_t          node;
    double                length;
    MedialVoxelEdgeCounts counts;
  };
  std::set<std::pair<std::int64_t, MedialVoxelEdgeCounts>> known;
  std::vector<PartialPath>                                 open{ { workspace.NodeOf(a), 0.0, {} } };
  const std::int64_t                                       end = workspace.NodeOf(b);
  double                                                   shortest = Infinity;
  while (!open.empty())
  {
    const PartialPath path = open.back();
    open.pop_back();
    if (path.node == end)
    {
      shortest = std::min(shortest, MedialVoxelPathLength(m_Grid, path.counts));
      continue;
    }
    const MedialVoxelIndex index = workspace.m_Indices[static_cast<std::size_t>(path.node)];
    workspace.VisitNeighbors(index, [&](const std::int64_t node, const unsigned int mask) {
      PartialPath next{ node, path.length + m_Grid.GetEdgeLength(mask), path.counts };
      ++next.counts[mask];
      if (next.length + workspace.m_Length[static_cast<std::size_t>(node)] <= m_Upper &&
          known.emplace(node, next.counts).second)
      {
        open.push_back(next);
      }
    });
  }
  return shortest;
}

} // end namespace itk
