// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceComponents.h"

#include "itkMedialVoxelProgress.h"

#include <limits>
#include <stdexcept>
#include <utility>

namespace itk
{

void
MedialVoxelSurfaceComponents::AddVertices(const std::uint64_t number)
{
  constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
  if (number > most - m_Entries.size())
  {
    throw std::length_error("The medial surface has more than 2147483647 vertices, too many to find its components.");
  }
  m_Entries.resize(m_Entries.size() + static_cast<std::size_t>(number), -1);
}

void
MedialVoxelSurfaceComponents::AddQuad(const std::array<std::uint64_t, 4> & vertices)
{
  std::size_t root = this->RootOf(static_cast<std::size_t>(vertices[0]));
  for (unsigned int i = 1; i < 4; ++i)
  {
    std::size_t other = this->RootOf(static_cast<std::size_t>(vertices[i]));
    if (other == root)
    {
      continue;
    }
    // The smaller component goes below the larger one, so that the trees stay flat.
    if (m_Entries[other] < m_Entries[root])
    {
      std::swap(root, other);
    }
    m_Entries[root] += m_Entries[other] + 1;
    m_Entries[other] = static_cast<std::int32_t>(root);
  }
  if (m_Entries[root] == std::numeric_limits<std::int32_t>::min())
  {
    throw std::length_error("A component of the medial surface has more than 2147483647 faces, too many to count.");
  }
  --m_Entries[root];
}

void
MedialVoxelSurfaceComponents::Keep(const std::uint64_t smallest)
{
  MedialVoxelAbortChecker checker;
  std::vector<bool>       kept(m_Entries.size());
  for (std::size_t vertex = 0; vertex < kept.size(); ++vertex)
  {
    checker.Count();
    const std::int64_t entry = m_Entries[this->RootOf(vertex)];
    const auto         quads = static_cast<std::uint64_t>(-1 - entry);
    kept[vertex] = quads >= smallest;
    m_LeftOut += m_Entries[vertex] < 0 && quads > 0 && !kept[vertex] ? 1u : 0u;
  }
  std::int32_t number = 0;
  for (std::size_t vertex = 0; vertex < kept.size(); ++vertex)
  {
    m_Entries[vertex] = kept[vertex] ? number++ : -1;
  }
}

std::size_t
MedialVoxelSurfaceComponents::RootOf(std::size_t vertex)
{
  while (m_Entries[vertex] >= 0)
  {
    const auto parent = static_cast<std::size_t>(m_Entries[vertex]);
    if (m_Entries[parent] >= 0)
    {
      m_Entries[vertex] = m_Entries[parent];
    }
    vertex = parent;
  }
  return vertex;
}

} // end namespace itk
