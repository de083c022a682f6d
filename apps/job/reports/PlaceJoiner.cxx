// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceJoiner.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace medialvoxel
{
namespace
{

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

/** \class Unions
 * \brief Sets of numbers that are joined two at a time; the smallest number of a set stands for it. */
class Unions
{
public:
  explicit Unions(std::size_t size)
    : m_Parents(size)
  {
    std::iota(m_Parents.begin(), m_Parents.end(), 0);
  }

  std::uint32_t
  Find(std::uint32_t number)
  {
    while (m_Parents[number] != number)
    {
      m_Parents[number] = m_Parents[m_Parents[number]];
      number = m_Parents[number];
    }
    return number;
  }

  void
  Join(std::uint32_t a, std::uint32_t b)
  {
    a = this->Find(a);
    b = this->Find(b);
    m_Parents[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> m_Parents;
};

} // namespace

PlaceJoiner::PlaceJoiner(const PlaceRule & rule, const PlaceGrid & grid)
  : m_Rule(rule)
  , m_Grid(grid)
{}

void
PlaceJoiner::Add(const std::deque<PlaceCell> & cells, const itk::MedialVoxelBox & region)
{
  const unsigned int slices = m_Grid.GetSliceAxis();
  const unsigned int rows = m_Grid.GetRowAxis();
  m_FirstSlice = m_FirstSlice < 0 ? region.lower[slices] : m_FirstSlice;
  m_EndSlice = region.upper[slices];
  Nodes nodes;
  nodes.reserve(m_OpenCells.size() + cells.size());
  nodes = m_OpenCells;
  auto number = static_cast<std::uint32_t>(m_OpenPlaces.size());
  for (const PlaceCell & cell : cells)
  {
    nodes.push_back({ cell.key, number++ });
  }
  this->Join(std::move(nodes), m_OpenPlaces, cells, [&](std::int64_t key) {
    const std::int64_t slice = m_Grid.GetSlice(key);
    const bool         touchesNextSlice = slice == region.upper[slices] - 1 && m_EndSlice < m_Grid.GetNumberOfSlices();
    const bool         touchesNextRow = m_Grid.GetRow(key) >= region.upper[rows] - 1 &&
                                region.upper[rows] < m_Grid.GetNumberOfRows() && slice >= region.lower[slices] - 1;
    const bool touchesOthers = slice == m_FirstSlice && m_FirstSlice > 0;
    return touchesNextSlice || touchesNextRow || touchesOthers;
  });
}

template <typename TIsOpen>
void
PlaceJoiner::Join(Nodes                          nodes,
                  const std::vector<PlaceSums> & places,
                  const std::deque<PlaceCell> &  cells,
                  const TIsOpen &                isOpen)
{
  std::sort(nodes.begin(), nodes.end(), [](const Node & a, const Node & b) { return a.key < b.key; });
  std::vector<std::uint32_t> joinedOf = this->FindRoots(nodes, places.size());
  std::uint32_t              numberOfRoots = 0;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
  {
    numberOfRoots += joinedOf[i] == i ? 1 : 0;
  }
  std::vector<PlaceSums> joined;
  std::vector<bool>      isJoinedOpen;
  std::vector<bool>      isCounted(places.size(), false);
  std::size_t            numberOfOpenCells = 0;
  joined.reserve(numberOfRoots);
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
  {
    // Roots come first, and become the numbers of their places.
    if (joinedOf[i] == i)
    {
      joinedOf[i] = static_cast<std::uint32_t>(joined.size());
      joined.emplace_back();
      isJoinedOpen.push_back(false);
    }
    else
    {
      joinedOf[i] = joinedOf[joinedOf[i]];
    }
    const Node  node = nodes[i];
    PlaceSums & sums = joined[joinedOf[i]];
    if (node.number >= places.size())
    {
      sums.Add(cells[node.number - places.size()], m_Rule, m_Grid);
    }
    else if (!isCounted[node.number])
    {
      isCounted[node.number] = true;
      sums.Add(places[node.number], m_Rule);
    }
    if (isOpen(node.key))
    {
      isJoinedOpen[joinedOf[i]] = true;
      nodes[numberOfOpenCells++] = { node.key, joinedOf[i] };
    }
  }
  std::vector<PlaceSums>     openPlaces;
  std::vector<std::uint32_t> openOf(joined.size(), None);
  openPlaces.reserve(joined.size());
  for (std::size_t place = 0; place < joined.size(); ++place)
  {
    if (isJoinedOpen[place])
    {
      openOf[place] = static_cast<std::uint32_t>(openPlaces.size());
      openPlaces.push_back(joined[place]);
    }
    else
    {
      m_Complete.Add(joined[place], m_Rule);
    }
  }
  m_OpenCells.assign(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(numberOfOpenCells));
  for (Node & cell : m_OpenCells)
  {
    cell.number = openOf[cell.number];
  }
  m_OpenPlaces = std::move(openPlaces);
}

/** For each node the first node that it is joined with. */
std::vector<std::uint32_t>
PlaceJoiner::FindRoots(const Nodes & nodes, std::size_t numberOfPlaces) const
{
  Unions                       unions(nodes.size());
  std::vector<std::uint32_t>   firstOf(numberOfPlaces, None);
  const auto                   rowsBefore = m_Grid.GetRowsBefore();
  std::array<std::size_t, 4>   cursors{};
  itk::MedialVoxelAbortChecker checker;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
  {
    checker.Count(1);
    const Node & node = nodes[i];
    if (node.number < numberOfPlaces)
    {
      std::uint32_t & first = firstOf[node.number];
      first = first == None ? i : first;
      unions.Join(first, i);
    }
    if (i > 0 && nodes[i - 1].key == node.key - 1)
    {
      unions.Join(i - 1, i);
    }
    for (std::size_t row = 0; row < rowsBefore.size(); ++row)
    {
      // Passed nodes come before the neighbors of all later nodes.
      const std::int64_t middle = node.key + rowsBefore[row];
      std::size_t &      cursor = cursors[row];
      while (nodes[cursor].key < middle - 1)
      {
        ++cursor;
      }
      for (std::size_t other = cursor; nodes[other].key <= middle + 1; ++other)
      {
        unions.Join(static_cast<std::uint32_t>(other), i);
      }
    }
  }
  std::vector<std::uint32_t> roots(nodes.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
  {
    roots[i] = unions.Find(i);
  }
  return roots;
}

void
PlaceJoiner::Clear()
{
  m_FirstSlice = -1;
  m_EndSlice = 0;
  m_OpenCells.clear();
  m_OpenPlaces.clear();
  m_Complete.Clear();
}

void
PlaceJoiner::Save(NumberWriter & numbers) const
{
  m_Complete.Save(numbers);
  numbers.Add(static_cast<std::uint64_t>(m_EndSlice));
  numbers.Add(m_OpenPlaces.size());
  for (const PlaceSums & place : m_OpenPlaces)
  {
    place.Save(numbers);
  }
  numbers.Add(m_OpenCells.size());
  std::int64_t last = 0;
  for (const Node & cell : m_OpenCells)
  {
    numbers.AddSigned(cell.key - last);
    numbers.Add(cell.number);
    last = cell.key;
  }
}

void
PlaceJoiner::Merge(NumberReader & numbers)
{
  m_Complete.Merge(numbers);
  m_EndSlice = static_cast<std::int64_t>(numbers.Get());
  std::vector<PlaceSums> places = m_OpenPlaces;
  const auto             offset = static_cast<std::uint32_t>(places.size());
  const std::size_t      numberOfPlaces = numbers.GetLength();
  for (std::size_t i = 0; i < numberOfPlaces; ++i)
  {
    places.push_back(PlaceSums::Load(numbers));
  }
  Nodes             nodes = m_OpenCells;
  const std::size_t numberOfCells = numbers.GetLength();
  std::int64_t      key = 0;
  for (std::size_t i = 0; i < numberOfCells; ++i)
  {
    key += numbers.GetSigned();
    const std::uint64_t place = numbers.Get();
    if (place >= numberOfPlaces)
    {
      RefuseSaved();
    }
    nodes.push_back({ key, offset + static_cast<std::uint32_t>(place) });
  }
  this->Join(std::move(nodes), places, {}, [&](std::int64_t open) { return m_Grid.GetSlice(open) == m_EndSlice - 1; });
}

PlaceList
PlaceJoiner::Finish() const
{
  PlaceList list = m_Complete;
  for (const PlaceSums & place : m_OpenPlaces)
  {
    list.Add(place, m_Rule);
  }
  return list;
}

} // end namespace medialvoxel
