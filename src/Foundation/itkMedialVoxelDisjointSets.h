// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelDisjointSets_h
#define itkMedialVoxelDisjointSets_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace itk
{

/** \class MedialVoxelDisjointSets
 * \brief Sets of numbers that are joined two by two; the lowest number stands for its set.
 * \ingroup MedialVoxel
 */
template <typename TNumber>
class MedialVoxelDisjointSets
{
public:
  explicit MedialVoxelDisjointSets(const TNumber count = 0)
    : m_Parents(static_cast<std::size_t>(count))
  {
    std::iota(m_Parents.begin(), m_Parents.end(), TNumber{ 0 });
  }

  /** Adds a set of one number.
   * \return it */
  TNumber
  Add()
  {
    m_Parents.push_back(static_cast<TNumber>(m_Parents.size()));
    return m_Parents.back();
  }

  /** Of numbers, not of sets. */
  std::size_t
  GetSize() const
  {
    return m_Parents.size();
  }

  std::uint64_t
  GetBytes() const
  {
    return m_Parents.capacity() * sizeof(TNumber);
  }

  TNumber
  Find(TNumber number)
  {
    while (m_Parents[number] != number)
    {
      m_Parents[number] = m_Parents[m_Parents[number]];
      number = m_Parents[number];
    }
    return number;
  }

  /** \return whether they were apart */
  bool
  Join(const TNumber first, const TNumber second)
  {
    const auto [low, high] = std::minmax({ this->Find(first), this->Find(second) });
    m_Parents[high] = low;
    return low != high;
  }

private:
  std::vector<TNumber> m_Parents;
};

} // end namespace itk

#endif
