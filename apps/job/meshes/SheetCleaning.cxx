// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetCleaning.h"

#include "Errors.h"
#include "MeshReader.h"
#include "Text.h"

#include "itkMedialVoxelSurfaceBranches.h"
#include "itkMedialVoxelSurfaceComponents.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

using itk::MedialVoxelSurfaceBranches;
using itk::MedialVoxelSurfaceComponents;

/** Vertices or faces that are copied at a time; even, so that pairs of triangles stay together. */
constexpr std::uint64_t CopiedAtATime = std::uint64_t{ 1 } << 14;

/** Memory of the table of components, for each vertex, in a vector that grows; of the table of branches, for each
 * vertex and face, and for each junction side, which are few. */
constexpr std::uint64_t ComponentVertexSize = 8;
constexpr std::uint64_t FacesPerJunctionSide = 8;

/** A quadrilateral with its marks, of one face or of two. */
struct Quad
{
  MedialVoxelSurfaceBranches::VerticesType vertices;
  MedialVoxelSurfaceBranches::Marks        marks;
};

unsigned int
GetFacesPerQuad(const MeshSpool & surface)
{
  return surface.GetNumberOfTriangles() > 0 ? 2 : 1;
}

/** Triangles are the first three corners, and from the third one round to the first: the diagonal is their last side.
 */
Quad
GetQuad(const MeshFace * face)
{
  if (face->numberOfVertices == 4)
  {
    return { face->vertices, { face->rimEdges, face->junctionEdges } };
  }
  const MeshFace & second = face[1];
  return { { { face->vertices[0], face->vertices[1], face->vertices[2], second.vertices[1] } },
           { static_cast<std::uint8_t>(face->rimEdges | second.rimEdges << 2),
             static_cast<std::uint8_t>(face->junctionEdges | second.junctionEdges << 2) } };
}

void
SetMarks(MeshFace * face, const MedialVoxelSurfaceBranches::Marks & marks)
{
  const bool isQuad = face->numberOfVertices == 4;
  face->rimEdges = static_cast<std::uint8_t>(isQuad ? marks.rimSides : marks.rimSides & 3);
  face->junctionEdges = static_cast<std::uint8_t>(isQuad ? marks.junctionSides : marks.junctionSides & 3);
  if (!isQuad)
  {
    face[1].rimEdges = static_cast<std::uint8_t>(marks.rimSides >> 2);
    face[1].junctionEdges = static_cast<std::uint8_t>(marks.junctionSides >> 2);
  }
}

/** Walks over the quadrilaterals of a spool. */
class SpooledQuads : public itk::MedialVoxelSurfaceFaces
{
public:
  SpooledQuads(const MeshSpool & surface, const std::function<void(double)> & progress)
    : m_Surface(surface)
    , m_Progress(progress)
    , m_Points(surface, {})
  {}

  /** Calls visit(quad) in their order, or backwards. */
  template <typename TVisitor>
  void
  ForEachQuad(bool backwards, TVisitor && visit) const
  {
    const std::uint64_t step = GetFacesPerQuad(m_Surface);
    const std::uint64_t blocks = (m_Surface.GetNumberOfFaces() + CopiedAtATime - 1) / CopiedAtATime;
    for (std::uint64_t block = 0; block < blocks; ++block)
    {
      const std::uint64_t first = (backwards ? blocks - 1 - block : block) * CopiedAtATime;
      m_Surface.ReadFaces(first, std::min(CopiedAtATime, m_Surface.GetNumberOfFaces() - first), m_Faces);
      for (std::uint64_t i = 0; i < m_Faces.size(); i += step)
      {
        visit(GetQuad(&m_Faces[backwards ? m_Faces.size() - step - i : i]));
      }
      m_Progress(0.0);
    }
  }

  void
  ForEachFace(bool backwards, const Visitor & visit) const override
  {
    this->ForEachQuad(backwards, [&](const Quad & quad) {
      std::array<PointType, 4> points;
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        points[corner] = m_Points.GetVertex(quad.vertices[corner]).position;
      }
      visit(quad.vertices, points);
    });
  }

private:
  const MeshSpool &                   m_Surface;
  const std::function<void(double)> & m_Progress;
  mutable MeshReader                  m_Points;
  mutable std::vector<MeshFace>       m_Faces;
};

/** Copies the vertices for which isKept(number) holds. */
template <typename TIsKept>
void
CopyVertices(const MeshSpool & from, MeshSpool & to, TIsKept && isKept)
{
  std::vector<MeshSpool::Vertex> vertices;
  std::vector<MeshVertex>        kept;
  for (std::uint64_t first = 0; first < from.GetNumberOfVertices(); first += CopiedAtATime)
  {
    from.ReadVertices(first, std::min(CopiedAtATime, from.GetNumberOfVertices() - first), vertices);
    kept.clear();
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      if (isKept(first + i))
      {
        kept.push_back({ vertices[i].position, vertices[i].thickness, vertices[i].object });
      }
    }
    to.AddVertices(kept);
  }
}

/** Copies the quadrilaterals for whose first face adapt(number, face) holds, and numbers their vertices anew. */
template <typename TAdapt, typename TNumberOf>
void
CopyFaces(const MeshSpool & from, MeshSpool & to, TAdapt && adapt, TNumberOf && numberOf)
{
  const std::uint64_t   step = GetFacesPerQuad(from);
  std::vector<MeshFace> faces;
  for (std::uint64_t first = 0; first < from.GetNumberOfFaces(); first += CopiedAtATime)
  {
    from.ReadFaces(first, std::min(CopiedAtATime, from.GetNumberOfFaces() - first), faces);
    std::size_t kept = 0;
    for (std::uint64_t i = 0; i < faces.size(); i += step)
    {
      if (adapt((first + i) / step, &faces[i]))
      {
        for (std::uint64_t k = 0; k < step; ++k)
        {
          faces[kept++] = faces[i + k];
        }
      }
    }
    faces.resize(kept);
    for (MeshFace & face : faces)
    {
      std::transform(
        face.vertices.begin(), face.vertices.begin() + face.numberOfVertices, face.vertices.begin(), numberOf);
    }
    to.AddFaces(faces);
  }
}

void
CheckMemory(const MeshSpool & surface, std::uint64_t needed, const SheetCleaning & cleaning, const char * what)
{
  if (needed > cleaning.memoryLimit)
  {
    FailForMemory("the surface has ",
                  surface.GetNumberOfVertices(),
                  " vertices; ",
                  what,
                  " takes ",
                  FormatBytes(needed),
                  " of memory, ",
                  FormatBytes(cleaning.memoryLimit),
                  " are left for it; allow more with --memory");
  }
}

std::unique_ptr<MeshSpool>
RemoveBranches(const MeshSpool & surface, const SheetCleaning & cleaning)
{
  const SpooledQuads  quads(surface, cleaning.progress);
  const std::uint64_t numberOfQuads = surface.GetNumberOfFaces() / GetFacesPerQuad(surface);
  std::uint64_t       junctionSides = 0;
  quads.ForEachQuad(false, [&](const Quad & quad) {
    for (unsigned int sides = quad.marks.junctionSides; sides != 0; sides &= sides - 1)
    {
      ++junctionSides;
    }
  });
  // Vectors that grow by doubling.
  CheckMemory(surface,
              2 * MedialVoxelSurfaceBranches::GetBytes(surface.GetNumberOfVertices(), numberOfQuads, junctionSides),
              cleaning,
              "finding its branches");
  MedialVoxelSurfaceBranches branches;
  branches.AddVertices(surface.GetNumberOfVertices());
  quads.ForEachQuad(false, [&](const Quad & quad) { branches.AddFace(quad.vertices, quad.marks); });
  branches.Find(cleaning.minimumBranchLength, quads);

  auto kept = std::make_unique<MeshSpool>(cleaning.scratchFolder, surface.GetPrecision());
  CopyVertices(surface, *kept, [&](std::uint64_t vertex) { return branches.IsVertexKept(vertex); });
  CopyFaces(
    surface,
    *kept,
    [&](std::uint64_t number, MeshFace * face) {
      SetMarks(face, branches.GetMarks(number, GetQuad(face).marks));
      return branches.IsFaceKept(number);
    },
    [&](std::uint64_t vertex) { return branches.NumberOf(vertex); });
  return kept;
}

std::unique_ptr<MeshSpool>
RemoveSmallComponents(const MeshSpool & surface, const SheetCleaning & cleaning, PiecesLeftOut & pieces)
{
  CheckMemory(surface, surface.GetNumberOfVertices() * ComponentVertexSize, cleaning, "finding its small components");
  MedialVoxelSurfaceComponents components;
  components.AddVertices(surface.GetNumberOfVertices());
  SpooledQuads(surface, cleaning.progress).ForEachQuad(false, [&](const Quad & quad) {
    components.AddQuad(quad.vertices);
  });
  components.Keep(cleaning.minimumComponentSize);
  pieces.number = components.GetNumberLeftOut();

  auto kept = std::make_unique<MeshSpool>(cleaning.scratchFolder, surface.GetPrecision());
  CopyVertices(surface, *kept, [&](std::uint64_t vertex) { return components.IsKept(vertex); });
  CopyFaces(
    surface,
    *kept,
    [&](std::uint64_t, const MeshFace * face) {
      const bool isKept = components.IsKept(face->vertices[0]);
      for (unsigned int k = 0; !isKept && k < GetFacesPerQuad(surface); ++k)
      {
        pieces.area += face[k].area;
      }
      return isKept;
    },
    [&](std::uint64_t vertex) { return components.NumberOf(vertex); });
  return kept;
}

} // namespace

std::unique_ptr<MeshSpool>
CleanSheet(std::unique_ptr<MeshSpool> surface, const SheetCleaning & cleaning, std::optional<PiecesLeftOut> & pieces)
{
  if (cleaning.minimumBranchLength > 0)
  {
    surface = RemoveBranches(*surface, cleaning);
  }
  if (cleaning.minimumComponentSize > 1)
  {
    surface = RemoveSmallComponents(*surface, cleaning, pieces.emplace());
  }
  return surface;
}

std::uint64_t
GetCleaningMemory(const SheetCleaning & cleaning, std::uint64_t vertices)
{
  const std::uint64_t branches =
    2 * MedialVoxelSurfaceBranches::GetBytes(vertices, vertices, vertices / FacesPerJunctionSide);
  return std::max(cleaning.minimumBranchLength > 0 ? branches : 0,
                  cleaning.minimumComponentSize > 1 ? vertices * ComponentVertexSize : 0);
}

} // end namespace medialvoxel
