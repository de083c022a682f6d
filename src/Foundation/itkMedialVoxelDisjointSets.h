// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelDisjointSets_h
#define itkMedialVoxelDisjointSets_h

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace itk
{

/** \class MedialVoxelDisjointSets
 * \brief Sets of numbers that are joined two by two; the lowest number stands for its set.
 * \ingroup MedialVoxel
 */
class MedialVoxelDisjointSets
{
public:
  using Index = std::uint32_t;

  explicit MedialVoxelDisjointSets(const Index count)
    : m_Parents(count)
  {
    std::iota(m_Parents.begin(), m_Parents.end(), Index{ 0 });
  }

  Index
  Find(Index number)
  {
    while (m_Parents[number] != number)
    {
      m_Parents[number] = m_Parents[m_Parents[number]];
      number = m_Parents[number];
    }
    return number;
  }

  void
  Join(const Index first, const Index second)
  {
    const Index a = this->Find(first);
    const Index b = this->Find(second);
    m_Parents[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<Index> m_Parents;
};

} // end namespace itk

#endif
