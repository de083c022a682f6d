// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshSink_h
#define medialvoxelMeshSink_h

#include <array>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** Bits of the coordinates in files. Numbers are rounded once, so that all formats agree. */
enum class MeshPrecision
{
  Single, ///< float32, about 7 digits
  Double  ///< float64, for surfaces whose neighboring vertices float32 would not keep apart
};

/** A vertex of a surface. Files hold the thickness rounded to float32. */
struct MeshVertex
{
  std::array<double, 3> position;       ///< physical units of the image
  double                thickness{ 0 }; ///< of the wall, physical units; not finite or not above 0: unknown
  std::uint32_t         object{ 0 }; ///< number of the object of a label map that its faces belong to; 0: no label map
};

/** A triangle or a quad of a surface. */
struct MeshFace
{
  std::array<std::uint64_t, 4> vertices;              ///< counted from 0; a triangle ignores the last one
  std::uint8_t                 numberOfVertices{ 4 }; ///< 3 or 4
  std::uint8_t                 rimEdges{ 0 };         ///< bit k: the edge from corner k to the next is of no other face
  std::uint8_t                 junctionEdges{ 0 };    ///< bit k: the edge from corner k to the next is of more than two
  double                       area{ 0 };             ///< physical units squared
  bool                         isCap{ false };        ///< closes a surface where the image cuts the part
  std::uint32_t                wall{ 0 };             ///< its number; 0: none, or not known
};

/** \class MeshSink
 * \brief Takes a surface piece by piece.
 *
 * Vertices come in the order of their numbers, faces in the order they are to have in a file; a face may come before
 * its vertices. How the pieces are cut makes no difference. */
class MeshSink
{
public:
  virtual ~MeshSink() = default;

  /** \throw JobError Failure when they cannot be stored. */
  virtual void
  AddVertices(const std::vector<MeshVertex> & vertices) = 0;

  /** \throw JobError Failure when they cannot be stored. */
  virtual void
  AddFaces(const std::vector<MeshFace> & faces) = 0;
};

} // end namespace medialvoxel

#endif
