// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectAdjacency.h"

#include <algorithm>
#include <bitset>
#include <cassert>
#include <limits>
#include <numeric>
#include <string>

namespace itk
{

namespace
{

/** Boundaries of objects with three voxels between them neither overlap nor touch. */
constexpr std::int64_t ReachOfBoundaries = 3;

/** Voxels around an end of an object, on its far side, that are known to be background: \a reach along one axis, and
 * around the object's voxel, cut by the border of the image, along the others. */
std::uint64_t
CountVoxelsBeside(const MedialVoxelIndex & size, const std::int64_t reach)
{
  const std::int64_t longest = *std::max_element(size.begin(), size.end());
  std::uint64_t      voxels = static_cast<std::uint64_t>(reach);
  bool               isLongestLeft = true;
  for (const std::int64_t extent : size)
  {
    if (isLongestLeft && extent == longest)
    {
      isLongestLeft = false;
      continue;
    }
    voxels *= static_cast<std::uint64_t>(std::min(reach + 1, extent));
  }
  return voxels;
}

constexpr std::uint32_t
MakePair(const MedialVoxelObjectAdjacency::ObjectType first, const MedialVoxelObjectAdjacency::ObjectType second)
{
  return first < second ? (std::uint32_t{ first } << 16 | second) : (std::uint32_t{ second } << 16 | first);
}

/** Pairs that may be stored twice before the first sort. */
constexpr std::size_t MostUnsorted = std::size_t{ 1 } << 16;

/** A power of two; the pair of 0 and 0 is none. */
constexpr unsigned int BitsOfLastPairs = 12;

/** \class Neighbors
 * \brief The neighbors of each object, in one list. */
class Neighbors
{
public:
  using ObjectType = MedialVoxelObjectAdjacency::ObjectType;

  Neighbors(const std::vector<std::uint32_t> & pairs, const std::size_t numberOfObjects)
    : m_Ends(numberOfObjects + 2, 0)
    , m_Objects(2 * pairs.size())
  {
    constexpr std::uint32_t mask = std::numeric_limits<ObjectType>::max();
    for (const std::uint32_t pair : pairs)
    {
      ++m_Ends[(pair >> 16) + 1];
      ++m_Ends[(pair & mask) + 1];
    }
    std::partial_sum(m_Ends.begin(), m_Ends.end(), m_Ends.begin());
    std::vector<std::size_t> next(m_Ends.begin(), m_Ends.end() - 1);
    for (const std::uint32_t pair : pairs)
    {
      m_Objects[next[pair >> 16]++] = static_cast<ObjectType>(pair & mask);
      m_Objects[next[pair & mask]++] = static_cast<ObjectType>(pair >> 16);
    }
  }

  std::size_t
  Count(const std::size_t object) const
  {
    return m_Ends[object + 1] - m_Ends[object];
  }

  template <typename TFunction>
  void
  ForEach(const std::size_t object, TFunction && function) const
  {
    std::for_each(m_Objects.begin() + static_cast<std::ptrdiff_t>(m_Ends[object]),
                  m_Objects.begin() + static_cast<std::ptrdiff_t>(m_Ends[object + 1]),
                  function);
  }

private:
  std::vector<std::size_t> m_Ends;
  std::vector<ObjectType>  m_Objects;
};

/** \class WaitingObjects
 * \brief A heap of the objects that wait for a pass. */
class WaitingObjects
{
public:
  explicit WaitingObjects(const Neighbors & neighbors, const std::size_t numberOfObjects)
    : m_Rank(numberOfObjects + 1, 0)
    , m_Taken(numberOfObjects + 1, 0)
    , m_Place(numberOfObjects + 1)
    , m_Heap(numberOfObjects)
  {
    // Before the first pass is chosen, objects with most neighbors come first, then smaller numbers.
    std::iota(m_Heap.begin(), m_Heap.end(), std::size_t{ 1 });
    std::stable_sort(m_Heap.begin(), m_Heap.end(), [&](const std::size_t a, const std::size_t b) {
      return neighbors.Count(a) > neighbors.Count(b);
    });
    for (std::size_t place = 0; place < m_Heap.size(); ++place)
    {
      m_Rank[m_Heap[place]] = place;
      m_Place[m_Heap[place]] = place;
    }
  }

  bool
  IsEmpty() const
  {
    return m_Heap.empty();
  }

  std::size_t
  Pop()
  {
    const std::size_t first = m_Heap.front();
    const std::size_t last = m_Heap.back();
    m_Heap.pop_back();
    m_Place[first] = None;
    if (!m_Heap.empty())
    {
      this->Sink(last);
    }
    return first;
  }

  /** A neighbor has taken one more pass. */
  void
  Raise(const std::size_t object)
  {
    ++m_Taken[object];
    std::size_t place = m_Place[object];
    if (place == None)
    {
      return;
    }
    while (place > 0 && this->IsBefore(object, m_Heap[(place - 1) / 2]))
    {
      this->Put(m_Heap[(place - 1) / 2], place);
      place = (place - 1) / 2;
    }
    this->Put(object, place);
  }

private:
  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  bool
  IsBefore(const std::size_t a, const std::size_t b) const
  {
    return m_Taken[a] != m_Taken[b] ? m_Taken[a] > m_Taken[b] : m_Rank[a] < m_Rank[b];
  }

  void
  Put(const std::size_t object, const std::size_t place)
  {
    m_Heap[place] = object;
    m_Place[object] = place;
  }

  /** From the top. */
  void
  Sink(const std::size_t object)
  {
    std::size_t place = 0;
    for (std::size_t child = 1; child < m_Heap.size(); child = 2 * place + 1)
    {
      child += child + 1 < m_Heap.size() && this->IsBefore(m_Heap[child + 1], m_Heap[child]) ? 1 : 0;
      if (!this->IsBefore(m_Heap[child], object))
      {
        break;
      }
      this->Put(m_Heap[child], place);
      place = child;
    }
    this->Put(object, place);
  }

  std::vector<std::size_t> m_Rank;  ///< of objects whose neighbors take equally many passes
  std::vector<std::size_t> m_Taken; ///< passes of neighbors
  std::vector<std::size_t> m_Place; ///< in the heap
  std::vector<std::size_t> m_Heap;
};

} // namespace

MedialVoxelObjectAdjacency::MedialVoxelObjectAdjacency(const MedialVoxelIndex & size,
                                                       const std::uint64_t      maximumPoreSize)
  : m_Size(size)
  , m_BlockEdge(GetReach(size, maximumPoreSize))
  , m_BlocksX((size[0] + m_BlockEdge - 1) / m_BlockEdge)
  , m_BlocksY((size[1] + m_BlockEdge - 1) / m_BlockEdge)
{
  m_Layer.first.resize(static_cast<std::size_t>(m_BlocksX * m_BlocksY));
  m_PreviousLayer.first.resize(m_Layer.first.size());
  m_LastPairs.resize(std::size_t{ 1 } << BitsOfLastPairs, 0);
}

std::int64_t
MedialVoxelObjectAdjacency::GetReach(const MedialVoxelIndex & size, const std::uint64_t maximumPoreSize)
{
  const std::int64_t longest = *std::max_element(size.begin(), size.end());
  std::int64_t       reach = ReachOfBoundaries;
  while (maximumPoreSize > 0 && reach < longest && CountVoxelsBeside(size, reach) <= maximumPoreSize)
  {
    ++reach;
  }
  return reach;
}

std::uint64_t
MedialVoxelObjectAdjacency::GetBytes(const MedialVoxelIndex & size, const std::uint64_t maximumPoreSize)
{
  const std::int64_t edge = GetReach(size, maximumPoreSize);
  const auto         blocks = static_cast<std::uint64_t>(((size[0] + edge - 1) / edge) * ((size[1] + edge - 1) / edge));
  return 2 * blocks * sizeof(std::array<ObjectType, MostInBlock>);
}

void
MedialVoxelObjectAdjacency::AddObject(Layer & layer, const std::size_t block, const ObjectType object) const
{
  for (ObjectType & known : layer.first[block])
  {
    if (known == 0 || known == object)
    {
      known = object;
      return;
    }
  }
  std::vector<ObjectType> & rest = layer.rest[block];
  if (std::find(rest.begin(), rest.end(), object) == rest.end())
  {
    rest.push_back(object);
  }
  if (rest.size() + MostInBlock > MostPasses)
  {
    this->RefusePasses();
  }
}

template <typename TFunction>
void
MedialVoxelObjectAdjacency::ForEachObject(const Layer & layer, const std::size_t block, TFunction && function)
{
  for (const ObjectType object : layer.first[block])
  {
    if (object == 0)
    {
      return;
    }
    function(object);
  }
  const auto rest = layer.rest.find(block);
  if (rest != layer.rest.end())
  {
    std::for_each(rest->second.begin(), rest->second.end(), function);
  }
}

void
MedialVoxelObjectAdjacency::AddRow(const ObjectType * const row)
{
  assert(m_NextZ < m_Size[2]);
  const std::int64_t firstBlock = m_NextY / m_BlockEdge * m_BlocksX;
  for (std::int64_t block = 0; block < m_BlocksX; ++block)
  {
    const ObjectType * const end = row + std::min((block + 1) * m_BlockEdge, m_Size[0]);
    ObjectType               last = 0;
    for (const ObjectType * object = row + block * m_BlockEdge; object < end; ++object)
    {
      if (*object != last && *object != 0)
      {
        AddObject(m_Layer, static_cast<std::size_t>(firstBlock + block), *object);
      }
      last = *object;
    }
  }
  if (++m_NextY == m_Size[1])
  {
    m_NextY = 0;
    ++m_NextZ;
    if (m_NextZ % m_BlockEdge == 0 || m_NextZ == m_Size[2])
    {
      this->FinishLayer();
    }
  }
}

void
MedialVoxelObjectAdjacency::FinishLayer()
{
  const auto at = [this](const std::int64_t x, const std::int64_t y) {
    return static_cast<std::size_t>(y * m_BlocksX + x);
  };
  for (std::int64_t y = 0; y < m_BlocksY; ++y)
  {
    for (std::int64_t x = 0; x < m_BlocksX; ++x)
    {
      const std::size_t block = at(x, y);
      if (m_Layer.first[block][0] == 0)
      {
        continue;
      }
      this->CheckPasses(x, y);
      for (std::int64_t otherY = std::max<std::int64_t>(y - 1, 0); otherY <= std::min(y + 1, m_BlocksY - 1); ++otherY)
      {
        for (std::int64_t otherX = std::max<std::int64_t>(x - 1, 0); otherX <= std::min(x + 1, m_BlocksX - 1); ++otherX)
        {
          const std::size_t other = at(otherX, otherY);
          if (other <= block)
          {
            // The same two come again in the other order.
            this->Connect(block, m_Layer, other);
          }
          this->Connect(block, m_PreviousLayer, other);
        }
      }
    }
  }
  std::swap(m_Layer, m_PreviousLayer);
  std::fill(m_Layer.first.begin(), m_Layer.first.end(), std::array<ObjectType, MostInBlock>{});
  m_Layer.rest.clear();
}

void
MedialVoxelObjectAdjacency::Connect(const std::size_t block, const Layer & otherLayer, const std::size_t other)
{
  const auto & own = m_Layer.first[block];
  const auto & others = otherLayer.first[other];
  if (others[0] == 0 || (own[0] == others[0] && own[1] == 0 && others[1] == 0))
  {
    return;
  }
  ForEachObject(m_Layer, block, [&](const ObjectType first) {
    ForEachObject(otherLayer, other, [&](const ObjectType second) {
      if (first != second)
      {
        this->AddPair(first, second);
      }
    });
  });
}

void
MedialVoxelObjectAdjacency::RefusePasses() const
{
  constexpr std::int64_t usual = 6; // of slices; of volumes it is half as large
  throw MedialVoxelLabelError("more than " + std::to_string(MostPasses) +
                              " of its values lie side by side, and each takes a pass of its own; " +
                              (m_BlockEdge > usual ? "with pores of fewer voxels, or fewer labels, passes are fewer"
                                                   : "this looks like a gray scan: give a threshold, such as lower"));
}

void
MedialVoxelObjectAdjacency::CheckPasses(const std::int64_t blockX, const std::int64_t blockY)
{
  std::vector<ObjectType> objects;
  for (const Layer * const layer : { &m_Layer, &m_PreviousLayer })
  {
    for (std::int64_t y = std::max<std::int64_t>(blockY - 1, 0); y <= blockY; ++y)
    {
      for (std::int64_t x = std::max<std::int64_t>(blockX - 1, 0); x <= blockX; ++x)
      {
        const auto add = [&objects](const ObjectType object) { objects.push_back(object); };
        ForEachObject(*layer, static_cast<std::size_t>(y * m_BlocksX + x), add);
      }
    }
  }
  if (objects.size() <= MostPasses)
  {
    return;
  }
  std::sort(objects.begin(), objects.end());
  if (std::unique(objects.begin(), objects.end()) - objects.begin() > static_cast<std::ptrdiff_t>(MostPasses))
  {
    this->RefusePasses();
  }
}

void
MedialVoxelObjectAdjacency::AddPair(const ObjectType first, const ObjectType second)
{
  const std::uint32_t pair = MakePair(first, second);
  // Neighboring blocks mostly have the same pairs.
  std::uint32_t & last = m_LastPairs[(pair * 2654435769u) >> (32 - BitsOfLastPairs)];
  if (last == pair)
  {
    return;
  }
  last = pair;
  m_Pairs.push_back(pair);
  if (m_Pairs.size() >= 2 * m_NumberOfSorted + MostUnsorted)
  {
    this->SortPairs();
  }
}

void
MedialVoxelObjectAdjacency::SortPairs()
{
  std::sort(m_Pairs.begin(), m_Pairs.end());
  m_Pairs.erase(std::unique(m_Pairs.begin(), m_Pairs.end()), m_Pairs.end());
  m_NumberOfSorted = m_Pairs.size();
}

auto
MedialVoxelObjectAdjacency::MakePasses(const std::size_t numberOfObjects) -> std::vector<ObjectType>
{
  this->SortPairs();
  const Neighbors         neighbors(m_Pairs, numberOfObjects);
  WaitingObjects          waiting(neighbors, numberOfObjects);
  std::vector<ObjectType> passes(numberOfObjects + 1, 0);
  using Passes = std::bitset<MostPasses>;
  std::vector<Passes> taken(numberOfObjects + 1);
  while (!waiting.IsEmpty())
  {
    const std::size_t object = waiting.Pop();
    if (taken[object].all())
    {
      this->RefusePasses();
    }
    ObjectType pass = 0;
    while (taken[object][pass])
    {
      ++pass;
    }
    passes[object] = pass;
    neighbors.ForEach(object, [&](const ObjectType neighbor) {
      if (!taken[neighbor][pass])
      {
        taken[neighbor][pass] = true;
        waiting.Raise(neighbor);
      }
    });
  }
  return passes;
}

} // end namespace itk
