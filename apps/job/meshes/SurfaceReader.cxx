// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceReader.h"

namespace medialvoxel
{
SurfaceReader::SurfaceReader(const SurfaceSpool & surface, const std::function<void(double)> & progress)
  : m_Surface(surface)
  , m_Progress(progress)
  , m_Slots(NumberOfSlots)
{}

void
SurfaceReader::SetNumberOfPasses(std::uint64_t vertexPasses, std::uint64_t facePasses)
{
  m_Expected = vertexPasses * m_Surface.GetNumberOfVertices() + facePasses * m_Surface.GetNumberOfFaces();
}

void
SurfaceReader::AddDone(std::uint64_t count)
{
  m_Done += count;
  if (m_Progress)
  {
    // A writer that finds out late how often it walks must not make the progress fall.
    m_Fraction = std::max(m_Fraction, std::min(1.0, static_cast<double>(m_Done) / static_cast<double>(m_Expected)));
    m_Progress(m_Fraction);
  }
}

const SurfaceReader::Vertex &
SurfaceReader::GetVertex(std::uint64_t number)
{
  const std::uint64_t block = number / BlockSize;
  Slot &              slot = m_Slots[block % NumberOfSlots];
  if (slot.block != block)
  {
    const std::uint64_t first = block * BlockSize;
    m_Surface.ReadVertices(first, std::min(BlockSize, m_Surface.GetNumberOfVertices() - first), slot.vertices);
    slot.block = block;
  }
  return slot.vertices[number % BlockSize];
}

} // end namespace medialvoxel
