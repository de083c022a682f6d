// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoundaryDistances.h"

#include <cmath>

namespace itk
{

void
MedialVoxelBoundaryDistances::Compute(const MedialVoxelBoundaryGraph & graph,
                                      const MedialVoxelGrid &          grid,
                                      const NodeType                   source,
                                      const double                     radius)
{
  // A little narrower than the shortest edge, so that rounding does not leave both ends of an edge in one bucket.
  const double bucketsPerLength = 1.0 / (grid.GetShortestEdge() * (1.0 - 1e-9));
  const auto   bucketOf = [&](const double length) { return static_cast<std::size_t>(length * bucketsPerLength); };
  // Buckets are used again once the front has passed them.
  m_Buckets.resize(bucketOf(grid.GetLongestEdge()) + 2);
  m_Lengths.assign(graph.GetNumberOfNodes(), NotReached);
  m_Lengths[source] = 0.0;
  m_Buckets[0].push_back(source);

  std::size_t waiting = 1;
  for (std::size_t front = 0; waiting > 0; ++front)
  {
    auto & bucket = m_Buckets[front % m_Buckets.size()];
    for (const NodeType node : bucket)
    {
      const double length = m_Lengths[node];
      if (bucketOf(length) != front)
      {
        continue;
      }
      graph.VisitNeighbors(node, [&](const NodeType neighbor, const unsigned int mask) {
        const double next = length + grid.GetEdgeLength(mask);
        if (next < m_Lengths[neighbor] && next <= radius)
        {
          m_Lengths[neighbor] = next;
          m_Buckets[bucketOf(next) % m_Buckets.size()].push_back(neighbor);
          ++waiting;
        }
      });
    }
    waiting -= bucket.size();
    bucket.clear();
  }
}

} // end namespace itk
