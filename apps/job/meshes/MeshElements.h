// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshElements_h
#define medialvoxelMeshElements_h

#include "MeshReader.h"

namespace medialvoxel
{

/** Corners of a triangle or quad, as places in the list of a face. */
using MeshCorners = std::vector<unsigned int>;

/** The elements of a face. */
using MeshElements = std::vector<MeshCorners>;

/** The triangles of a face: a quad is split along its shorter diagonal; when both are equally long, along that from
 * the first corner to the third. */
const MeshElements &
GetTriangles(MeshReader & reader, const MeshFace & face);

/** The finite elements of a face. A quad with a corner whose sine is below 0.2, seen from its mean normal, which takes
 * in corners that turn the other way, becomes two triangles, as solvers refuse it: along the diagonal whose worse
 * triangle has more area, when both are equal along that from the first corner to the third. */
const MeshElements &
GetElements(MeshReader & reader, const MeshFace & face);

/** Which sides of an element are marked ones of its face: bit k is the side from the element's corner k to the next. */
std::uint8_t
GetElementSides(const MeshFace & face, const MeshCorners & corners, std::uint8_t sidesOfFace);

/** Calls function(number, face, corners) for all elements in the order of their faces, with numbers from 1. */
template <typename TFunction>
void
ForEachElement(MeshReader & reader, TFunction && function)
{
  std::uint64_t number = 0;
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    for (const MeshCorners & corners : GetElements(reader, face))
    {
      function(++number, face, corners);
    }
  });
}

} // end namespace medialvoxel

#endif
