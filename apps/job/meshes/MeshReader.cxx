// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshReader.h"

namespace medialvoxel
{
MeshReader::MeshReader(const MeshSpool & surface, const std::function<void(double)> & progress)
  : m_Surface(surface)
  , m_Progress(progress)
  , m_Blocks(surface.GetNumberOfVertices(),
             [&surface](std::uint64_t first, std::uint64_t count, std::vector<Vertex> & vertices) {
               surface.ReadVertices(first, count, vertices);
             })
{}

void
MeshReader::SetNumberOfPasses(std::uint64_t vertexPasses, std::uint64_t facePasses)
{
  m_Expected = vertexPasses * m_Surface.GetNumberOfVertices() + facePasses * m_Surface.GetNumberOfFaces();
}

void
MeshReader::AddDone(std::uint64_t count)
{
  m_Done += count;
  if (m_Progress)
  {
    // A writer that finds out late how often it walks must not make the progress fall.
    m_Fraction = std::max(m_Fraction, std::min(1.0, static_cast<double>(m_Done) / static_cast<double>(m_Expected)));
    m_Progress(m_Fraction);
  }
}

} // end namespace medialvoxel
