// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceStore.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSurfaceComponents.h"

namespace itk
{

void
MedialVoxelSurfaceStore::AddVertices(const std::vector<MedialVoxelSurfaceVertex> & vertices)
{
  m_Vertices.insert(m_Vertices.end(), vertices.begin(), vertices.end());
}

void
MedialVoxelSurfaceStore::AddQuads(const std::vector<MedialVoxelSurfaceQuad> & quads)
{
  m_Quads.insert(m_Quads.end(), quads.begin(), quads.end());
}

void
MedialVoxelSurfaceStore::RemoveBranches(const double length)
{
  MedialVoxelSurfaceBranches branches;
  branches.AddVertices(m_Vertices.size());
  MedialVoxelAbortChecker checker;
  for (const MedialVoxelSurfaceQuad & quad : m_Quads)
  {
    checker.Count();
    branches.AddFace(quad.vertices, { quad.rimSides, quad.junctionSides });
  }
  branches.Find(length, *this);
  for (std::size_t face = 0; face < m_Quads.size(); ++face)
  {
    checker.Count();
    MedialVoxelSurfaceQuad & quad = m_Quads[face];
    const auto               marks = branches.GetMarks(face, { quad.rimSides, quad.junctionSides });
    quad.rimSides = marks.rimSides;
    quad.junctionSides = marks.junctionSides;
  }
  this->Keep([&](const std::size_t vertex) { return branches.IsVertexKept(vertex); },
             [&](const std::size_t face) { return branches.IsFaceKept(face); },
             [&](const std::uint64_t vertex) { return branches.NumberOf(vertex); });
}

void
MedialVoxelSurfaceStore::RemoveSmallComponents(const std::uint64_t smallest)
{
  MedialVoxelSurfaceComponents components;
  components.AddVertices(m_Vertices.size());
  MedialVoxelAbortChecker checker;
  for (const MedialVoxelSurfaceQuad & quad : m_Quads)
  {
    checker.Count();
    components.AddQuad(quad.vertices);
  }
  components.Keep(smallest);
  this->Keep([&](const std::size_t vertex) { return components.IsKept(vertex); },
             [&](const std::size_t face) { return components.IsKept(m_Quads[face].vertices[0]); },
             [&](const std::uint64_t vertex) { return components.NumberOf(vertex); });
}

template <typename TIsVertexKept, typename TIsQuadKept, typename TNumberOf>
void
MedialVoxelSurfaceStore::Keep(TIsVertexKept && isVertexKept, TIsQuadKept && isQuadKept, TNumberOf && numberOf)
{
  MedialVoxelAbortChecker checker;
  std::size_t             kept = 0;
  for (std::size_t vertex = 0; vertex < m_Vertices.size(); ++vertex)
  {
    checker.Count();
    if (isVertexKept(vertex))
    {
      m_Vertices[kept++] = m_Vertices[vertex];
    }
  }
  m_Vertices.resize(kept);
  kept = 0;
  for (std::size_t face = 0; face < m_Quads.size(); ++face)
  {
    checker.Count();
    if (isQuadKept(face))
    {
      MedialVoxelSurfaceQuad & quad = m_Quads[kept++];
      quad = m_Quads[face];
      for (std::uint64_t & vertex : quad.vertices)
      {
        vertex = numberOf(vertex);
      }
    }
  }
  m_Quads.resize(kept);
}

void
MedialVoxelSurfaceStore::HandOn(MedialVoxelSurfaceConsumer & consumer) const
{
  consumer.AddVertices(m_Vertices);
  consumer.AddQuads(m_Quads);
}

void
MedialVoxelSurfaceStore::ForEachFace(const bool backwards, const Visitor & visit) const
{
  MedialVoxelAbortChecker checker;
  for (std::size_t i = 0; i < m_Quads.size(); ++i)
  {
    checker.Count();
    const VerticesType &     vertices = m_Quads[backwards ? m_Quads.size() - 1 - i : i].vertices;
    std::array<PointType, 4> points;
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double coordinate = m_Vertices[vertices[corner]].point[axis];
        points[corner][axis] = m_RoundsToFloat ? MedialVoxelSurfaceBuilder::RoundedToFloat(coordinate) : coordinate;
      }
    }
    visit(vertices, points);
  }
}

} // end namespace itk
