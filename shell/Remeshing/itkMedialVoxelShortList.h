// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelShortList_h
#define itkMedialVoxelShortList_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace itk
{

/** \class MedialVoxelShortList
 * \brief A list that takes memory from the heap only when it has more than VSize elements.
 * \ingroup MedialVoxel
 */
template <typename TElement, std::size_t VSize>
class MedialVoxelShortList
{
public:
  void
  push_back(const TElement & element)
  {
    if (m_Size == VSize)
    {
      m_Long.assign(m_Short.begin(), m_Short.end());
    }
    if (m_Size < VSize)
    {
      m_Short[m_Size] = element;
    }
    else
    {
      m_Long.push_back(element);
    }
    ++m_Size;
  }

  /** Before a place of the list. */
  void
  insert(const TElement * place, const TElement & element)
  {
    const std::ptrdiff_t offset = place - this->begin();
    this->push_back(element);
    TElement * const begin = this->begin();
    std::copy_backward(begin + offset, begin + m_Size - 1, begin + m_Size);
    begin[offset] = element;
  }

  std::size_t
  size() const
  {
    return m_Size;
  }
  TElement *
  begin()
  {
    return m_Size > VSize ? m_Long.data() : m_Short.data();
  }
  const TElement *
  begin() const
  {
    return m_Size > VSize ? m_Long.data() : m_Short.data();
  }
  TElement *
  end()
  {
    return this->begin() + m_Size;
  }
  const TElement *
  end() const
  {
    return this->begin() + m_Size;
  }
  const TElement &
  operator[](const std::size_t place) const
  {
    return this->begin()[place];
  }

private:
  std::array<TElement, VSize> m_Short;
  std::vector<TElement>       m_Long; ///< all of them, when they are more
  std::size_t                 m_Size{ 0 };
};

} // end namespace itk

#endif
