// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceWriters.h"

namespace medialvoxel
{

void
WriteSurfacePly(SurfaceReader & reader, const SurfaceWriteOptions &, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 1);
  output.Text("ply\nformat binary_little_endian 1.0\ncomment Medial surface by MedialVoxel\nelement vertex ");
  output.Integer(reader.GetSurface().GetNumberOfVertices());
  const std::string type = reader.GetSurface().GetPrecision() == SurfacePrecision::Double ? "double" : "float";
  output.Text("\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type +
              " z\nproperty float thickness\nelement face ");
  output.Integer(reader.GetSurface().GetNumberOfFaces());
  // Nothing more per face: not every reader skips it, that of meshio does not.
  output.Text("\nproperty list uchar int vertex_indices\nend_header\n");
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) {
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.LittleEndian(coordinate); });
    output.LittleEndian(vertex.thickness);
  });
  reader.ForEachFace([&](std::uint64_t, const SurfaceFace & face) {
    output.LittleEndian(face.numberOfVertices);
    for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
    {
      output.LittleEndian(static_cast<std::uint32_t>(face.vertices[corner]));
    }
  });
}

} // end namespace medialvoxel
