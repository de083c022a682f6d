// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRandomSample_h
#define itkMedialVoxelRandomSample_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace itk
{

/** A number as random as one can be that depends on another one (SplitMix64). */
inline std::uint64_t
MedialVoxelHash(std::uint64_t number)
{
  number += 0x9E3779B97F4A7C15u;
  number = (number ^ (number >> 30)) * 0xBF58476D1CE4E5B9u;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EBu;
  return number ^ (number >> 31);
}

/** \class MedialVoxelRandomSample
 * \brief As many items of a set as wanted, with the smallest hashes.
 *
 * The same items remain in whatever order and division they come.
 * \ingroup MedialVoxel
 */
template <typename TItem>
class MedialVoxelRandomSample
{
public:
  explicit MedialVoxelRandomSample(const std::size_t size)
    : m_Size(size)
  {}

  /** Whether an item with this hash may still count. */
  bool
  Wants(const std::uint64_t hash) const
  {
    return hash <= m_Limit;
  }

  std::size_t
  GetSize() const
  {
    return std::min(m_Items.size(), m_Size);
  }

  /** Items that the other sample does not want are not wanted here either. */
  void
  LimitTo(const MedialVoxelRandomSample & other)
  {
    m_Limit = other.m_Limit;
  }

  void
  Add(const std::uint64_t hash, TItem item)
  {
    if (this->Wants(hash))
    {
      m_Items.emplace_back(hash, std::move(item));
      if (m_Items.size() >= 2 * m_Size)
      {
        this->Shrink();
      }
    }
  }

  void
  Add(MedialVoxelRandomSample && other)
  {
    for (auto & item : other.m_Items)
    {
      this->Add(item.first, std::move(item.second));
    }
  }

  /** The items, in the order of their hashes. */
  std::vector<TItem>
  Take()
  {
    this->Shrink();
    std::sort(m_Items.begin(), m_Items.end(), HasSmallerHash);
    std::vector<TItem> items;
    items.reserve(m_Items.size());
    for (auto & item : m_Items)
    {
      items.push_back(std::move(item.second));
    }
    m_Items.clear();
    return items;
  }

private:
  using Entry = std::pair<std::uint64_t, TItem>;

  static bool
  HasSmallerHash(const Entry & a, const Entry & b)
  {
    return a.first < b.first;
  }

  void
  Shrink()
  {
    if (m_Items.size() > m_Size)
    {
      const auto end = m_Items.begin() + static_cast<std::ptrdiff_t>(m_Size);
      std::nth_element(m_Items.begin(), end - 1, m_Items.end(), HasSmallerHash);
      m_Items.erase(end, m_Items.end());
      m_Limit = m_Items.back().first;
    }
  }

  std::size_t        m_Size;
  std::uint64_t      m_Limit{ ~std::uint64_t{ 0 } };
  std::vector<Entry> m_Items;
};

} // end namespace itk

#endif
