// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoundaryGraph.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <numeric>

namespace itk
{

bool
MedialVoxelBoundaryGraph::Build(const MedialVoxelBits & boundary,
                                const MedialVoxelBox &  box,
                                const std::size_t       mostNodes)
{
  this->Clear();
  this->SetBox(box);
  this->CopyBits(boundary);
  if (!this->NumberNodes(mostNodes))
  {
    this->Clear();
    return false;
  }
  this->Connect();
  return true;
}

void
MedialVoxelBoundaryGraph::Clear()
{
  m_Box = {};
  m_Positions.clear();
  m_Components.clear();
}

void
MedialVoxelBoundaryGraph::SetBox(const MedialVoxelBox & box)
{
  constexpr std::int64_t bitsPerWord = MedialVoxelBits::BitsPerWord;
  m_Box = box;
  m_BitsPerRow = (box.Extent(0) + 2 + bitsPerWord - 1) / bitsPerWord * bitsPerWord;
  m_RowsPerSlice = box.Extent(1) + 2;
  std::size_t row = 0;
  for (std::int64_t dz = -1; dz <= 1; ++dz)
  {
    for (std::int64_t dy = -1; dy <= 1; ++dy)
    {
      m_Rows[row].offset = (dz * m_RowsPerSlice + dy) * m_BitsPerRow;
      m_Rows[row].mask = (dy != 0 ? 2u : 0u) | (dz != 0 ? 4u : 0u);
      ++row;
    }
  }
}

void
MedialVoxelBoundaryGraph::CopyBits(const MedialVoxelBits & boundary)
{
  constexpr std::int64_t bitsPerWord = MedialVoxelBits::BitsPerWord;
  const std::int64_t     wordsPerRow = m_BitsPerRow / bitsPerWord;
  m_Words.assign(static_cast<std::size_t>((m_Box.Extent(2) + 2) * m_RowsPerSlice * wordsPerRow), 0);
  for (std::int64_t z = m_Box.lower[2]; z < m_Box.upper[2]; ++z)
  {
    MedialVoxelCheckAbort();
    for (std::int64_t y = m_Box.lower[1]; y < m_Box.upper[1]; ++y)
    {
      // The bit before the box is padding.
      const std::int64_t firstX = m_Box.lower[0] - 1;
      WordType * const   row = m_Words.data() + (this->PositionOf({ { m_Box.lower[0], y, z } }) >> 6);
      for (std::int64_t word = 0; word < wordsPerRow; ++word)
      {
        const std::int64_t x = firstX + word * bitsPerWord;
        row[word] = boundary.Extract(x, y, z) & MedialVoxelBits::RangeMask(0, m_Box.lower[0] - x, m_Box.upper[0] - x);
      }
    }
  }
}

bool
MedialVoxelBoundaryGraph::NumberNodes(const std::size_t mostNodes)
{
  MedialVoxelAbortChecker checker;
  m_NodesBefore.resize(m_Words.size());
  for (std::size_t word = 0; word < m_Words.size(); ++word)
  {
    checker.Count();
    m_NodesBefore[word] = static_cast<NodeType>(m_Positions.size());
    for (WordType rest = m_Words[word]; rest != 0; rest &= rest - 1)
    {
      m_Positions.push_back(word * 64 + static_cast<std::uint64_t>(MedialVoxelLowestBit(rest)));
    }
    if (m_Positions.size() > mostNodes)
    {
      return false;
    }
  }
  return true;
}

void
MedialVoxelBoundaryGraph::ListNeighbors(const NodeType node)
{
  const auto add = [this](const NodeType neighbor, const unsigned int mask) {
    m_Neighbors.push_back((neighbor << BitsOfMask) | mask);
  };
  for (const Row & row : m_Rows)
  {
    const std::uint64_t first = m_Positions[node] - 1 + static_cast<std::uint64_t>(row.offset);
    const unsigned int  bits = this->ThreeBitsAt(first);
    if (bits == 0)
    {
      continue;
    }
    // Points of a row are numbered one after the other; the point itself is not its neighbor.
    NodeType next = this->NodeAt(first);
    if ((bits & 1u) != 0)
    {
      add(next++, row.mask | 1u);
    }
    if ((bits & 2u) != 0)
    {
      if (row.mask != 0)
      {
        add(next, row.mask);
      }
      ++next;
    }
    if ((bits & 4u) != 0)
    {
      add(next, row.mask | 1u);
    }
  }
}

void
MedialVoxelBoundaryGraph::Connect()
{
  const auto              numberOfNodes = static_cast<NodeType>(m_Positions.size());
  MedialVoxelAbortChecker checker;
  m_FirstNeighbor.resize(m_Positions.size() + 1);
  m_Neighbors.clear();
  for (NodeType node = 0; node < numberOfNodes; ++node)
  {
    checker.Count();
    m_FirstNeighbor[node] = m_Neighbors.size();
    this->ListNeighbors(node);
  }
  m_FirstNeighbor[numberOfNodes] = m_Neighbors.size();

  m_Components.resize(m_Positions.size());
  std::iota(m_Components.begin(), m_Components.end(), NodeType{ 0 });
  const auto rootOf = [this](NodeType node) {
    while (m_Components[node] != node)
    {
      m_Components[node] = m_Components[m_Components[node]];
      node = m_Components[node];
    }
    return node;
  };
  // Roots are the smallest numbers of their trees, so that one pass in the order of the numbers flattens all trees.
  for (NodeType node = 0; node < numberOfNodes; ++node)
  {
    checker.Count();
    this->VisitNeighbors(node, [&](const NodeType neighbor, unsigned int) {
      if (neighbor < node)
      {
        const NodeType root = rootOf(node);
        const NodeType other = rootOf(neighbor);
        m_Components[std::max(root, other)] = std::min(root, other);
      }
    });
  }
  for (NodeType & component : m_Components)
  {
    component = m_Components[component];
  }
}

} // end namespace itk
