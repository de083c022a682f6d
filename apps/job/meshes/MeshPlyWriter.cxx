// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshWriters.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{
namespace
{

/** PLY has no whole numbers of more bits. */
bool
FitInt32(const std::vector<std::int64_t> & labels)
{
  using Limits = std::numeric_limits<std::int32_t>;
  return std::all_of(
    labels.begin(), labels.end(), [](std::int64_t label) { return label >= Limits::min() && label <= Limits::max(); });
}

} // namespace

void
WriteMeshPly(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 1);
  output.Text("ply\nformat binary_little_endian 1.0\ncomment " + GetTitle(options) + "\nelement vertex ");
  output.Integer(reader.GetMesh().GetNumberOfVertices());
  const std::string type = reader.GetMesh().GetPrecision() == MeshPrecision::Double ? "double" : "float";
  output.Text("\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type + " z\nproperty float thickness");
  for (const VertexValues * const array : options.vertexArrays)
  {
    output.Text("\nproperty float " + array->GetName());
  }
  // A face has the object of its vertices.
  const bool hasObjects = !options.objectLabels.empty();
  const bool isInt32 = FitInt32(options.objectLabels);
  output.Text(!hasObjects ? "" : isInt32 ? "\nproperty int object" : "\nproperty double object");
  output.Text("\nelement face ");
  output.Integer(reader.GetMesh().GetNumberOfFaces());
  // Nothing more per face that nobody asked for: not every reader takes it, that of meshio does not.
  output.Text("\nproperty list uchar int vertex_indices")
    .Text(options.hasWalls ? "\nproperty uint wall" : "")
    .Text("\nend_header\n");
  reader.ForEachVertex([&](std::uint64_t number, const auto & vertex) {
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.LittleEndian(coordinate); });
    output.LittleEndian(vertex.thickness);
    for (const VertexValues * const array : options.vertexArrays)
    {
      output.LittleEndian(array->Get(number));
    }
    if (hasObjects)
    {
      const std::int64_t label = options.objectLabels[vertex.object - 1];
      isInt32 ? output.LittleEndian(static_cast<std::int32_t>(label)) : output.LittleEndian(static_cast<double>(label));
    }
  });
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    output.LittleEndian(face.numberOfVertices);
    for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
    {
      output.LittleEndian(static_cast<std::uint32_t>(face.vertices[corner]));
    }
    if (options.hasWalls)
    {
      output.LittleEndian(face.wall);
    }
  });
}

} // end namespace medialvoxel
