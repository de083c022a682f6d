// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoundaryDistances.h"

#include "itkMedialVoxelDualCell.h"

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
  m_Queue.Begin(grid);
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
    m_Queue.Push(node, length);
  };
  reach(source, 0.0);
  m_Queue.Run([&](const NodeType node) { return m_Lengths[node]; },
              [&](const NodeType node, const double length) {
                graph.VisitNeighbors(node, [&](const NodeType neighbor, const unsigned int mask) {
                  const double next = length + grid.GetEdgeLength(mask);
                  if (next < m_Lengths[neighbor] && isOfUse(neighbor, next))
                  {
                    reach(neighbor, next);
                  }
                });
                return true;
              },
              isDone);
}

} // end namespace itk
