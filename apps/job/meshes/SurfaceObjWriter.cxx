// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceWriters.h"

namespace medialvoxel
{

void
WriteSurfaceObj(SurfaceReader & reader, const SurfaceWriteOptions &, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 1);
  output.Text("# Medial surface by MedialVoxel, lengths in the units of the image\n");
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) {
    output.Text("v");
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.Text(" ").Float(coordinate); });
    output.Text("\n");
  });
  reader.ForEachFace([&](std::uint64_t, const SurfaceFace & face) {
    output.Text("f");
    for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
    {
      output.Text(" ").Integer(face.vertices[corner] + 1);
    }
    output.Text("\n");
  });
}

} // end namespace medialvoxel
