// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGuidedQueue_h
#define itkMedialVoxelGuidedQueue_h

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>
#include <vector>

namespace itk
{

/** \class MedialVoxelGuidedQueue
 * \brief Points that wait in a search towards a target, in buckets by the least length of a path through them (A*;
 * Hart, Nilsson and Raphael, 1968).
 *
 * The latest point of a bucket comes first, so that the search runs straight on. A point may get a shorter path after
 * it was visited; it then waits and is visited again.
 * \ingroup MedialVoxel
 */
template <typename TPoint>
class MedialVoxelGuidedQueue
{
public:
  /** A point, and the length of its path when it was pushed. */
  struct Entry
  {
    TPoint point;
    double length;
  };

  /** Empty the queue. No path is shorter than \a least; buckets are \a width wide. */
  void
  Begin(const double least, const double width)
  {
    assert(width > 0.0);
    for (auto & bucket : m_Buckets)
    {
      bucket.clear();
    }
    m_Least = least;
    m_BucketsPerLength = 1.0 / width;
    m_Front = 0;
  }

  /** Have a point wait; paths through it are at least as long as \a least. */
  void
  Push(const Entry & entry, const double least)
  {
    // Rounding must not put a point behind the front.
    const double beyond = std::max(0.0, (least - m_Least) * m_BucketsPerLength);
    const auto   bucket = std::max(m_Front, static_cast<std::size_t>(beyond));
    if (bucket >= m_Buckets.size())
    {
      m_Buckets.resize(bucket + 1);
    }
    m_Buckets[bucket].push_back(entry);
  }

  /** Take the next point; none when no point waits. */
  std::optional<Entry>
  Pop()
  {
    while (m_Front < m_Buckets.size() && m_Buckets[m_Front].empty())
    {
      ++m_Front;
    }
    if (m_Front == m_Buckets.size())
    {
      return std::nullopt;
    }
    const Entry entry = m_Buckets[m_Front].back();
    m_Buckets[m_Front].pop_back();
    return entry;
  }

private:
  double                          m_Least{ 0.0 };
  double                          m_BucketsPerLength{ 0.0 };
  std::size_t                     m_Front{ 0 };
  std::vector<std::vector<Entry>> m_Buckets;
};

} // end namespace itk

#endif
