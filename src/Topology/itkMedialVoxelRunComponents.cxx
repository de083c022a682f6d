// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRunComponents.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace itk
{

namespace
{

/** Whether one of the bits from \a first to \a last is set. */
bool
HasBit(const MedialVoxelBits::WordType * const bits, const std::int64_t first, const std::int64_t last)
{
  for (std::int64_t word = first / MedialVoxelBits::BitsPerWord; word <= last / MedialVoxelBits::BitsPerWord; ++word)
  {
    if ((bits[word] & MedialVoxelBits::RangeMask(word, first, last + 1)) != 0)
    {
      return true;
    }
  }
  return false;
}

} // namespace

/** Number the components of the slice before anew, so that memory does not grow. */
void
MedialVoxelRunComponents::BeginSlice()
{
  constexpr std::size_t    none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> numbers(m_Components.GetSize(), none);
  std::size_t              next = 0;
  for (Run & run : m_Own.runs)
  {
    std::size_t & number = numbers[m_Components.Find(run.component)];
    number = number == none ? next++ : number;
    run.component = number;
  }
  m_Components = MedialVoxelDisjointSets<std::size_t>(next);
  std::swap(m_Own, m_Before);
  m_Own.runs.clear();
  m_Own.ends.clear();
}

void
MedialVoxelRunComponents::AddRow(const Row & row, const std::int64_t numberOfWords)
{
  const std::size_t first = m_Own.runs.size();
  std::size_t       open = first; // the first run without an end
  WordType          carry = 0;
  for (std::int64_t word = 0; word < numberOfWords; ++word)
  {
    const WordType points = row.points[word];
    const WordType joined = row.toNext[word];
    for (WordType begins = points & ~((joined << 1) | carry); begins != 0; begins &= begins - 1)
    {
      m_Own.runs.push_back(
        { word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(begins), 0, m_Components.Add() });
    }
    for (WordType ends = points & ~joined; ends != 0; ends &= ends - 1)
    {
      m_Own.runs[open++].last = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(ends);
    }
    carry = joined >> (MedialVoxelBits::BitsPerWord - 1);
  }
  m_NumberOfComponents += static_cast<std::int64_t>(m_Own.runs.size() - first);
  const std::size_t number = m_Own.ends.size();
  m_Own.ends.push_back(m_Own.runs.size());
  if (number > 0)
  {
    this->JoinRows(first, m_Own, number - 1, row.toRow);
  }
  if (number < m_Before.ends.size())
  {
    this->JoinRows(first, m_Before, number, row.toSlice);
  }
}

void
MedialVoxelRunComponents::Join(Run & a, const Run & b)
{
  m_NumberOfComponents -= m_Components.Join(a.component, b.component) ? 1 : 0;
  a.component = m_Components.Find(a.component);
}

/** Join the runs from \a first on with those of another row. */
void
MedialVoxelRunComponents::JoinRows(const std::size_t      first,
                                   const Slice &          other,
                                   const std::size_t      row,
                                   const WordType * const links)
{
  std::size_t       at = row == 0 ? 0 : other.ends[row - 1];
  const std::size_t end = other.ends[row];
  for (std::size_t own = first; own < m_Own.runs.size() && at < end;)
  {
    Run &              a = m_Own.runs[own];
    const Run &        b = other.runs[at];
    const std::int64_t begin = std::max(a.begin, b.begin);
    const std::int64_t last = std::min(a.last, b.last);
    if (begin <= last && HasBit(links, begin, last))
    {
      this->Join(a, b);
    }
    a.last < b.last ? ++own : ++at;
  }
}

} // end namespace itk
