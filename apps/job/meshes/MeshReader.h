// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshReader_h
#define medialvoxelMeshReader_h

#include "RecordBlocks.h"
#include "MeshSpool.h"

#include <algorithm>
#include <functional>

namespace medialvoxel
{

/** \class MeshReader
 * \brief Walks over the vertices and faces of a spooled mesh, and reports the progress of writing. */
class MeshReader
{
public:
  using Vertex = MeshSpool::Vertex;

  /** \param progress as in MeshWriteOptions */
  MeshReader(const MeshSpool & surface, const std::function<void(double)> & progress);

  const MeshSpool &
  GetMesh() const
  {
    return m_Surface;
  }

  /** How often the writer walks over all vertices, and over all faces: for the progress. */
  void
  SetNumberOfPasses(std::uint64_t vertexPasses, std::uint64_t facePasses);

  /** Calls function(number, vertex) for all vertices in their order. */
  template <typename TFunction>
  void
  ForEachVertex(TFunction && function)
  {
    ForEach(
      m_Surface.GetNumberOfVertices(),
      [this](std::uint64_t first, std::uint64_t count) { m_Surface.ReadVertices(first, count, m_Vertices); },
      [&](std::uint64_t first, std::uint64_t index) { function(first + index, m_Vertices[index]); });
  }

  /** Calls function(number, face) for all faces in their order, which have these parts. */
  template <typename TFunction>
  void
  ForEachFace(TFunction && function, MeshFaceFields parts = MeshFaceFields::All)
  {
    ForEach(
      m_Surface.GetNumberOfFaces(),
      [=](std::uint64_t first, std::uint64_t count) { m_Surface.ReadFaces(first, count, m_Faces, parts); },
      [&](std::uint64_t first, std::uint64_t index) { function(first + index, m_Faces[index]); });
  }

  /** One vertex; fast when successive calls ask for neighbors, like the corners of successive faces. */
  const Vertex &
  GetVertex(std::uint64_t number)
  {
    return m_Blocks.Get(number);
  }

  /** The object that a face belongs to, as in MeshVertex. */
  std::uint32_t
  GetObject(const MeshFace & face)
  {
    return this->GetVertex(face.vertices[0]).object;
  }

private:
  static constexpr std::uint64_t BlockSize = 1024;

  template <typename TRead, typename TCall>
  void
  ForEach(std::uint64_t number, TRead && read, TCall && call)
  {
    for (std::uint64_t first = 0; first < number; first += BlockSize)
    {
      const std::uint64_t count = std::min(BlockSize, number - first);
      read(first, count);
      for (std::uint64_t index = 0; index < count; ++index)
      {
        call(first, index);
      }
      this->AddDone(count);
    }
  }

  void
  AddDone(std::uint64_t count);

  const MeshSpool &           m_Surface;
  std::function<void(double)> m_Progress;
  std::uint64_t               m_Expected{ 0 };
  std::uint64_t               m_Done{ 0 };
  double                      m_Fraction{ 0.0 };
  std::vector<Vertex>         m_Vertices;
  std::vector<MeshFace>       m_Faces;
  RecordBlocks<Vertex>        m_Blocks;
};

} // end namespace medialvoxel

#endif
