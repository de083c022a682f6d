// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshWriters_h
#define medialvoxelMeshWriters_h

#include "BufferedOutput.h"
#include "MeshFormat.h"
#include "MeshReader.h"

namespace medialvoxel
{

/** Each writes the whole content of a file of its format; WriteMesh() has checked that the surface fits. */
using MeshWriter = void(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output);

/** Calls use(coordinate) with the coordinates of a vertex in the precision of its surface: as float or double. */
template <typename TUse>
void
ForEachCoordinate(const MeshReader & reader, const MeshSpool::Vertex & vertex, TUse && use)
{
  for (const double coordinate : vertex.position)
  {
    if (reader.GetMesh().GetPrecision() == MeshPrecision::Double)
    {
      use(coordinate);
    }
    else
    {
      use(static_cast<float>(coordinate));
    }
  }
}

/** The label of the object that a face belongs to, in the surface of a label map. */
inline std::int64_t
GetLabel(MeshReader & reader, const MeshWriteOptions & options, const MeshFace & face)
{
  return options.objectLabels[reader.GetObject(face) - 1];
}

/** Names of groups and sets of the faces of an object: OBJECT_7, and OBJECT_MINUS_7 where no sign is allowed. */
std::string
GetObjectName(std::int64_t label);

/** The same of a wall: WALL_7. */
std::string
GetWallName(std::uint64_t wall);

/** Where sets have numbers, that of a wall is its own and this one; there are some sets before. */
constexpr std::uint64_t FirstWallSet = 1000;

/** The kind of the mesh, for a reader. */
inline std::string
GetTitle(const MeshWriteOptions & options)
{
  return std::string(options.isOfPart ? "Surface" : "Medial surface") +
         " by MedialVoxel, coordinates and thickness in " + options.unit;
}

/** Calls function(number) for all marked vertices in their order. */
template <typename TFunction>
void
ForEachMarked(const std::vector<bool> & marks, TFunction && function)
{
  for (std::uint64_t vertex = 0; vertex < marks.size(); ++vertex)
  {
    if (marks[vertex])
    {
      function(vertex);
    }
  }
}

MeshWriter WriteMeshVtp;
MeshWriter WriteMeshVtu;
MeshWriter WriteMeshVtk;
MeshWriter WriteMeshPly;
MeshWriter WriteMeshStl;
MeshWriter WriteMeshObj;
MeshWriter WriteMeshAbaqus;
MeshWriter WriteMeshNastran;
MeshWriter WriteMeshLsDyna;
MeshWriter WriteMeshGltf;

} // end namespace medialvoxel

#endif
