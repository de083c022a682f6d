// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceList.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{
namespace
{

/** No two places have the same worst cell. */
bool
IsLarger(const PlaceSums & a, const PlaceSums & b)
{
  return a.areaBeyond != b.areaBeyond ? a.areaBeyond > b.areaBeyond : a.worst.key < b.worst.key;
}

} // namespace

void
PlaceList::Add(const PlaceSums & place, const PlaceRule & rule)
{
  if (!place.hasBegun)
  {
    return;
  }
  if (place.areaBeyond < rule.minimumPlaceArea)
  {
    ++m_Totals.smaller;
    return;
  }
  ++m_Totals.number;
  m_Totals.cells += place.cells;
  m_Totals.area += place.area;
  m_Totals.areaBeyond += place.areaBeyond;
  this->Keep(place);
}

void
PlaceList::Keep(const PlaceSums & place)
{
  if (m_Largest.size() == MostPlaces)
  {
    if (!IsLarger(place, m_Largest.front()))
    {
      return;
    }
    std::pop_heap(m_Largest.begin(), m_Largest.end(), IsLarger);
    m_Largest.pop_back();
  }
  // Memory that is not used yet is not taken, but that of a vector that grows is taken twice.
  m_Largest.reserve(MostPlaces);
  m_Largest.push_back(place);
  std::push_heap(m_Largest.begin(), m_Largest.end(), IsLarger);
}

std::vector<PlaceSums>
PlaceList::TakeSorted()
{
  std::sort(m_Largest.begin(), m_Largest.end(), IsLarger);
  return std::move(m_Largest);
}

void
PlaceList::Clear()
{
  m_Totals = {};
  m_Largest.clear();
}

void
PlaceList::Save(NumberWriter & numbers) const
{
  for (const std::uint64_t number :
       { m_Totals.number, m_Totals.cells, m_Totals.area, m_Totals.areaBeyond, m_Totals.smaller })
  {
    numbers.Add(number);
  }
  numbers.Add(m_Largest.size());
  for (const PlaceSums & place : m_Largest)
  {
    place.Save(numbers);
  }
}

void
PlaceList::Merge(NumberReader & numbers)
{
  m_Totals.number += numbers.Get();
  m_Totals.cells += numbers.Get();
  m_Totals.area += numbers.Get();
  m_Totals.areaBeyond += numbers.Get();
  m_Totals.smaller += numbers.Get();
  const std::size_t length = numbers.GetLength();
  for (std::size_t i = 0; i < length; ++i)
  {
    this->Keep(PlaceSums::Load(numbers));
  }
}

} // end namespace medialvoxel
