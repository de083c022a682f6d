// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoundaryDistances.h"

#include "itkMedialVoxelDualCell.h"
#include "itkMedialVoxelProgress.h"

namespace itk
{

void
MedialVoxelBoundaryDistances::Compute(const MedialVoxelBoundaryGraph & graph,
                                      const MedialVoxelGrid &          grid,
                                      const NodeType                   source,
                                      const double                     radius)
{
  this->Search(
    graph,
    grid,
    source,
    [&](const NodeType, const double length) { return length <= radius; },
    [](const double) { return false; });
}

void
MedialVoxelBoundaryDistances::ComputeTowards(const MedialVoxelBoundaryGraph & graph,
                                             const MedialVoxelGrid &          grid,
                                             const NodeType                   source,
                                             const NodeType                   target,
                                             const double                     radius)
{
  const MedialVoxelDualCell cell(grid);
  const MedialVoxelIndex    end = graph.IndexOf(target);
  this->Search(
    graph,
    grid,
    source,
    [&](const NodeType node, const double length) {
      const MedialVoxelIndex index = graph.IndexOf(node);
      return length + cell.FreeSpaceLength({ { end[0] - index[0], end[1] - index[1], end[2] - index[2] } }) <= radius;
    },
    [&](const double done) { return m_Lengths[target] < done; });
}

template <typename TIsOfUse, typename TIsDone>
void
MedialVoxelBoundaryDistances::Search(const MedialVoxelBoundaryGraph & graph,
                                     const MedialVoxelGrid &          grid,
                                     const NodeType                   source,
                                     TIsOfUse &&                      isOfUse,
                                     TIsDone &&                       isDone)
{
  // A little narrower than the shortest edge, so that rounding does not leave both ends of an edge in one bucket.
  const double width = grid.GetShortestEdge() * (1.0 - 1e-9);
  const double bucketsPerLength = 1.0 / width;
  const auto   bucketOf = [&](const double length) { return static_cast<std::size_t>(length * bucketsPerLength); };
  // Buckets are used again once the front has passed them.
  m_Buckets.resize(bucketOf(grid.GetLongestEdge()) + 2);
  for (auto & bucket : m_Buckets)
  {
    bucket.clear();
  }
  // Most searches reach few of the points.
  for (const NodeType node : m_Reached)
  {
    m_Lengths[node] = NotReached;
  }
  m_Reached.clear();
  m_Lengths.resize(graph.GetNumberOfNodes(), NotReached);
  const auto reach = [&](const NodeType node, const double length) {
    if (m_Lengths[node] == NotReached)
    {
      m_Reached.push_back(node);
    }
    m_Lengths[node] = length;
    m_Buckets[bucketOf(length) % m_Buckets.size()].push_back(node);
  };
  reach(source, 0.0);

  MedialVoxelPollCounter poll;
  std::size_t            waiting = 1;
  for (std::size_t front = 0; waiting > 0 && !isDone(static_cast<double>(front) * width); ++front)
  {
    auto & bucket = m_Buckets[front % m_Buckets.size()];
    for (const NodeType node : bucket)
    {
      poll.Count();
      const double length = m_Lengths[node];
      if (bucketOf(length) != front)
      {
        continue;
      }
      graph.VisitNeighbors(node, [&](const NodeType neighbor, const unsigned int mask) {
        const double next = length + grid.GetEdgeLength(mask);
        if (next < m_Lengths[neighbor] && isOfUse(neighbor, next))
        {
          reach(neighbor, next);
          ++waiting;
        }
      });
    }
    waiting -= bucket.size();
    bucket.clear();
  }
}

} // end namespace itk
