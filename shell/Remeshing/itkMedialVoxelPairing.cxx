// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPairing.h"

namespace itk
{
namespace
{

/** Nodes of a search at most. */
constexpr std::size_t MostVisited = 2048;

} // namespace

MedialVoxelPairing::MedialVoxelPairing(const std::size_t numberOfNodes)
  : m_Neighbors(numberOfNodes)
  , m_Partners(numberOfNodes, None)
  , m_States(numberOfNodes)
{}

void
MedialVoxelPairing::Allow(const Index a, const Index b)
{
  m_Neighbors[a].push_back(b);
  m_Neighbors[b].push_back(a);
  if (m_Partners[a] == None && m_Partners[b] == None)
  {
    m_Partners[a] = b;
    m_Partners[b] = a;
  }
}

void
MedialVoxelPairing::Extend()
{
  for (Index node = 0; node < m_Partners.size(); ++node)
  {
    if (m_Partners[node] == None && !m_Neighbors[node].empty())
    {
      this->TryExtend(node);
    }
  }
}

bool
MedialVoxelPairing::TryExtend(const Index root)
{
  const Index end = this->FindEnd(root);
  for (Index node = end; node != None;)
  {
    const Index parent = m_States[node].parent;
    const Index next = m_Partners[parent];
    m_Partners[node] = parent;
    m_Partners[parent] = node;
    node = next;
  }
  for (const Index node : m_Visited)
  {
    m_States[node] = State{};
  }
  m_Visited.clear();
  m_Queue.clear();
  return end != None;
}

void
MedialVoxelPairing::Visit(const Index node)
{
  m_States[node].isVisited = true;
  m_States[node].base = node;
  m_Visited.push_back(node);
}

/** Searches breadth first, for the other lone node of a path. */
auto
MedialVoxelPairing::FindEnd(const Index root) -> Index
{
  this->Visit(root);
  m_States[root].isEven = true;
  m_Queue.push_back(root);
  for (std::size_t next = 0; next < m_Queue.size() && m_Visited.size() < MostVisited; ++next)
  {
    const Index node = m_Queue[next];
    for (const Index other : m_Neighbors[node])
    {
      if (other == m_Partners[node] || (m_States[other].isVisited && m_States[node].base == m_States[other].base))
      {
        continue;
      }
      if (m_States[other].isEven)
      {
        this->Contract(node, other);
      }
      else if (!m_States[other].isVisited)
      {
        this->Visit(other);
        m_States[other].parent = node;
        const Index partner = m_Partners[other];
        if (partner == None)
        {
          return other;
        }
        this->Visit(partner);
        m_States[partner].isEven = true;
        m_Queue.push_back(partner);
      }
    }
  }
  return None;
}

/** Nodes of a circle of odd length can each be the last one of a path. */
void
MedialVoxelPairing::Contract(const Index a, const Index b)
{
  const Index base = this->FindCommonBase(a, b);
  this->MarkToBase(a, base, b);
  this->MarkToBase(b, base, a);
  const std::size_t number = m_Visited.size();
  for (std::size_t k = 0; k < number; ++k)
  {
    State & state = m_States[m_Visited[k]];
    if (m_States[state.base].isMarked)
    {
      state.base = base;
      if (!state.isEven)
      {
        state.isEven = true;
        m_Queue.push_back(m_Visited[k]);
      }
    }
  }
  for (const Index node : m_Visited)
  {
    m_States[node].isMarked = false;
  }
}

auto
MedialVoxelPairing::FindCommonBase(Index a, Index b) -> Index
{
  std::vector<Index> bases;
  for (;;)
  {
    a = m_States[a].base;
    m_States[a].isMarked = true;
    bases.push_back(a);
    if (m_Partners[a] == None)
    {
      break;
    }
    a = m_States[m_Partners[a]].parent;
  }
  for (b = m_States[b].base; !m_States[b].isMarked; b = m_States[b].base)
  {
    b = m_States[m_Partners[b]].parent;
  }
  for (const Index node : bases)
  {
    m_States[node].isMarked = false;
  }
  return b;
}

void
MedialVoxelPairing::MarkToBase(Index node, const Index base, Index child)
{
  while (m_States[node].base != base)
  {
    const Index partner = m_Partners[node];
    m_States[m_States[node].base].isMarked = true;
    m_States[m_States[partner].base].isMarked = true;
    m_States[node].parent = child;
    child = partner;
    node = m_States[partner].parent;
  }
}

} // end namespace itk
