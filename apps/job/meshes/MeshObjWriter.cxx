// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshWriters.h"

namespace medialvoxel
{

void
WriteMeshObj(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 1);
  output.Text("# " + GetTitle(options) + "\n");
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) {
    output.Text("v");
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.Text(" ").Float(coordinate); });
    output.Text("\n");
  });
  std::uint32_t object = 0;
  std::uint32_t wall = 0;
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    if (!options.objectLabels.empty() && reader.GetObject(face) != object)
    {
      object = reader.GetObject(face);
      output.Text("g " + GetObjectName(GetLabel(reader, options, face)) + "\n");
    }
    if (options.hasWalls && face.wall != wall)
    {
      wall = face.wall;
      output.Text("g " + GetWallName(wall) + "\n");
    }
    output.Text("f");
    for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
    {
      output.Text(" ").Integer(face.vertices[corner] + 1);
    }
    output.Text("\n");
  });
}

} // end namespace medialvoxel
