// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTestMeshes_h
#define medialvoxelTestMeshes_h

#include "MeshSink.h"

#include <string>

namespace medialvoxel
{

/** A whole surface. */
struct TestMesh
{
  std::vector<MeshVertex> vertices;
  std::vector<MeshFace>   faces;
};

/** A triangle or quad with its corners; CompleteFaces() fills in the rest. */
MeshFace
MakeFace(const std::vector<std::uint64_t> & corners);

/** Areas, and rims and junctions from how many faces share an edge. */
void
CompleteFaces(TestMesh & surface);

/** "plate", "mixed" (triangles and quads), "cylinder", "cube" (closed), "junction" (three sheets at one line),
 * "empty": small surfaces whose thickness varies. \throw std::invalid_argument for another name. */
TestMesh
MakeTestMesh(const std::string & shape);

/** A rectangle in the plane z = 0 of unequal thickness, row by row, however large. */
struct Strip
{
  double        length{ 1 }; ///< along x
  double        width{ 1 };  ///< along y
  std::uint64_t columns{ 1 };
  std::uint64_t rows{ 1 };
  double        thicknessAtBegin{ 1 };
  double        thicknessAtEnd{ 1 };
  bool          triangles{ false }; ///< each quad as two
};
void
AddStrip(const Strip & strip, MeshSink & sink);

/** Gives the surface to the sink in pieces of so many vertices and faces. */
void
AddInPieces(const TestMesh & surface, size_t pieceSize, MeshSink & sink);

} // end namespace medialvoxel

#endif
