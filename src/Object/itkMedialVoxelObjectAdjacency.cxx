// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectAdjacency.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <set>
#include <tuple>

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
MedialVoxelObjectAdjacency::AddObject(Layer & layer, const std::size_t block, const ObjectType object)
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
        m_Pairs.insert(MakePair(first, second));
      }
    });
  });
}

auto
MedialVoxelObjectAdjacency::MakePasses(const std::size_t numberOfObjects) const -> std::vector<ObjectType>
{
  std::vector<std::vector<ObjectType>> neighbors(numberOfObjects + 1);
  for (const std::uint32_t pair : m_Pairs)
  {
    const auto first = static_cast<ObjectType>(pair >> 16);
    const auto second = static_cast<ObjectType>(pair & std::numeric_limits<ObjectType>::max());
    neighbors[first].push_back(second);
    neighbors[second].push_back(first);
  }

  // Of each object that waits: minus the number of passes that its neighbors take, minus that of its neighbors, itself.
  using Waiting = std::tuple<std::int64_t, std::int64_t, std::size_t>;
  std::vector<std::set<ObjectType>> taken(numberOfObjects + 1);
  std::set<Waiting>                 queue;
  const auto                        describe = [&](const std::size_t object) {
    return Waiting{ -static_cast<std::int64_t>(taken[object].size()),
                    -static_cast<std::int64_t>(neighbors[object].size()),
                    object };
  };
  for (std::size_t object = 1; object <= numberOfObjects; ++object)
  {
    queue.insert(describe(object));
  }
  std::vector<ObjectType> passes(numberOfObjects + 1, 0);
  while (!queue.empty())
  {
    const std::size_t object = std::get<2>(*queue.begin());
    queue.erase(queue.begin());
    ObjectType pass = 0;
    while (taken[object].count(pass) > 0)
    {
      ++pass;
    }
    passes[object] = pass;
    for (const ObjectType neighbor : neighbors[object])
    {
      const bool isWaiting = queue.erase(describe(neighbor)) > 0;
      taken[neighbor].insert(pass);
      if (isWaiting)
      {
        queue.insert(describe(neighbor));
      }
    }
  }
  return passes;
}

} // end namespace itk
