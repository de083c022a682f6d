// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBoundaryDistances_h
#define itkMedialVoxelBoundaryDistances_h

#include "itkMedialVoxelBoundaryGraph.h"
#include "itkMedialVoxelBucketQueue.h"
#include "itkMedialVoxelGrid.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** \class MedialVoxelBoundaryDistances
 * \brief Lengths of the shortest paths from one point of a boundary graph, by Dijkstra's algorithm.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBoundaryDistances
{
public:
  using NodeType = MedialVoxelBoundaryGraph::NodeType;

  /** Length of points that were not reached. */
  static constexpr double NotReached = std::numeric_limits<double>::infinity();

  /** Bytes of memory for each point of the graph. */
  static constexpr std::uint64_t BytesPerNode = sizeof(double) + 3 * sizeof(NodeType);

  /** Find the points within \a radius, in physical units, of \a source. */
  void
  Compute(const MedialVoxelBoundaryGraph & graph, const MedialVoxelGrid & grid, NodeType source, double radius);

  /** Find the length to \a target if it is at most \a radius; skips other points that cannot be on such a path. */
  void
  ComputeTowards(const MedialVoxelBoundaryGraph & graph,
                 const MedialVoxelGrid &          grid,
                 NodeType                         source,
                 NodeType                         target,
                 double                           radius);

  /** Lengths in physical units, by point; sums of edge lengths in floating point. */
  const std::vector<double> &
  GetLengths() const
  {
    return m_Lengths;
  }

private:
  /** Leave out edges to points for which \a isOfUse(point, length) is false, and end when \a isDone(bucket) is true. */
  template <typename TIsOfUse, typename TIsDone>
  void
  Search(const MedialVoxelBoundaryGraph & graph,
         const MedialVoxelGrid &          grid,
         NodeType                         source,
         TIsOfUse &&                      isOfUse,
         TIsDone &&                       isDone);

  std::vector<double>              m_Lengths;
  std::vector<NodeType>            m_Reached; // points that have a length
  MedialVoxelBucketQueue<NodeType> m_Queue;
};

} // end namespace itk

#endif
