// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurfaceShapes_h
#define medialvoxelSurfaceShapes_h

#include "SurfaceSink.h"

#include <string>

namespace medialvoxel
{

/** A whole surface. */
struct Surface
{
  std::vector<SurfaceVertex> vertices;
  std::vector<SurfaceFace>   faces;
};

/** A triangle or quad with its corners; CompleteFaces() fills in the rest. */
SurfaceFace
MakeFace(const std::vector<std::uint64_t> & corners);

/** Areas, and rims and junctions from how many faces share an edge. */
void
CompleteFaces(Surface & surface);

/** "plate", "mixed" (triangles and quads), "cylinder", "cube" (closed), "junction" (three sheets at one line),
 * "empty": small surfaces whose thickness varies. \throw std::invalid_argument for another name. */
Surface
MakeSurface(const std::string & shape);

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
AddStrip(const Strip & strip, SurfaceSink & sink);

/** Gives the surface to the sink in pieces of so many vertices and faces. */
void
AddInPieces(const Surface & surface, size_t pieceSize, SurfaceSink & sink);

} // end namespace medialvoxel

#endif
