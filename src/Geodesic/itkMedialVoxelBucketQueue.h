// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBucketQueue_h
#define itkMedialVoxelBucketQueue_h

#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <cassert>
#include <cstddef>
#include <vector>

namespace itk
{

/** \class MedialVoxelBucketQueue
 * \brief Points that wait in Dijkstra's algorithm, in buckets by the length of their path (Dial, 1969).
 *
 * Buckets are a little narrower than the shortest edge: no edge joins two points of a bucket, so that these can be done
 * in any order and no heap is needed. Buckets are used again once the front has passed them.
 * \ingroup MedialVoxel
 */
template <typename TPoint>
class MedialVoxelBucketQueue
{
public:
  /** Empty the queue for paths on \a grid. */
  void
  Begin(const MedialVoxelGrid & grid)
  {
    m_Width = grid.GetShortestEdge() * (1.0 - MedialVoxelResolutionBand);
    m_BucketsPerLength = 1.0 / m_Width;
    m_Buckets.resize(this->BucketOf(grid.GetLongestEdge()) + 2);
    for (auto & bucket : m_Buckets)
    {
      bucket.clear();
    }
    m_Waiting = 0;
  }

  /** Have \a point wait. Its \a length is at most one edge longer than that of the point that is being visited. */
  void
  Push(const TPoint point, const double length)
  {
    m_Buckets[this->BucketOf(length) % m_Buckets.size()].push_back(point);
    ++m_Waiting;
  }

  /** Call \a visit(point, length) for the points, shorter paths first, until it returns false, no point waits, or
   * \a isDone(length) is true, with a length that all further points reach. \a lengthOf(point) gives the length now: a
   * point that got a shorter path after it was pushed is visited once. */
  template <typename TLengthOf, typename TVisit, typename TIsDone>
  void
  Run(TLengthOf && lengthOf, TVisit && visit, TIsDone && isDone)
  {
    assert(!m_Buckets.empty());
    MedialVoxelAbortChecker checker;
    for (std::size_t front = 0; m_Waiting > 0 && !isDone(static_cast<double>(front) * m_Width); ++front)
    {
      auto & bucket = m_Buckets[front % m_Buckets.size()];
      for (const TPoint point : bucket)
      {
        checker.Count();
        const double length = lengthOf(point);
        if (this->BucketOf(length) == front && !visit(point, length))
        {
          return;
        }
      }
      m_Waiting -= bucket.size();
      bucket.clear();
    }
  }

private:
  std::size_t
  BucketOf(const double length) const
  {
    return static_cast<std::size_t>(length * m_BucketsPerLength);
  }

  double                           m_Width{ 0.0 };
  double                           m_BucketsPerLength{ 0.0 };
  std::size_t                      m_Waiting{ 0 };
  std::vector<std::vector<TPoint>> m_Buckets;
};

} // end namespace itk

#endif
