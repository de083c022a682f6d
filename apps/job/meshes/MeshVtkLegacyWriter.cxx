// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshWriters.h"

namespace medialvoxel
{
namespace
{

/** A scalar per point or cell; WriteValues calls its argument with each value. */
template <typename TWriteValues>
void
WriteScalars(const char * name, const char * type, BufferedOutput & output, TWriteValues && writeValues)
{
  output.Text("SCALARS ").Text(name).Text(" ").Text(type).Text(" 1\nLOOKUP_TABLE default\n");
  writeValues([&output](auto value) { output.BigEndian(value); });
  output.Text("\n");
}

template <typename TGet>
void
WriteFaceScalars(MeshReader & reader, const char * name, const char * type, BufferedOutput & output, TGet get)
{
  WriteScalars(name, type, output, [&](auto && write) {
    reader.ForEachFace([&](std::uint64_t, const MeshFace & face) { write(get(face)); });
  });
}

void
WriteGeometry(MeshReader & reader, BufferedOutput & output)
{
  const MeshSpool & surface = reader.GetMesh();
  output.Text("POINTS ").Integer(surface.GetNumberOfVertices());
  output.Text(surface.GetPrecision() == MeshPrecision::Double ? " double\n" : " float\n");
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) {
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.BigEndian(coordinate); });
  });
  output.Text("\n");
  // VTK reports an error for a list of no polygons.
  if (surface.GetNumberOfFaces() == 0)
  {
    return;
  }
  const std::uint64_t numbers = 4 * surface.GetNumberOfTriangles() + 5 * surface.GetNumberOfQuads();
  output.Text("POLYGONS ").Integer(surface.GetNumberOfFaces()).Text(" ").Integer(numbers).Text("\n");
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    output.BigEndian(std::uint32_t{ face.numberOfVertices });
    for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
    {
      output.BigEndian(static_cast<std::uint32_t>(face.vertices[corner]));
    }
  });
  output.Text("\n");
}

} // namespace

void
WriteMeshVtk(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(2, 4 + (options.objectLabels.empty() ? 0 : 1) + (options.hasWalls ? 1 : 0));
  output.Text("# vtk DataFile Version 3.0\n" + GetTitle(options) + "\nBINARY\nDATASET POLYDATA\n");
  WriteGeometry(reader, output);
  output.Text("POINT_DATA ").Integer(reader.GetMesh().GetNumberOfVertices()).Text("\n");
  WriteScalars("Thickness", "float", output, [&](auto && write) {
    reader.ForEachVertex([&](std::uint64_t, const auto & vertex) { write(vertex.thickness); });
  });
  output.Text("CELL_DATA ").Integer(reader.GetMesh().GetNumberOfFaces()).Text("\n");
  WriteFaceScalars(reader, "RimEdges", "unsigned_char", output, [](const MeshFace & face) { return face.rimEdges; });
  WriteFaceScalars(
    reader, "JunctionEdges", "unsigned_char", output, [](const MeshFace & face) { return face.junctionEdges; });
  WriteFaceScalars(
    reader, "Area", "float", output, [](const MeshFace & face) { return static_cast<float>(face.area); });
  if (!options.objectLabels.empty())
  {
    WriteFaceScalars(
      reader, "Object", "vtktypeint64", output, [&](const MeshFace & face) { return GetLabel(reader, options, face); });
  }
  if (options.hasWalls)
  {
    WriteFaceScalars(reader, "Wall", "unsigned_int", output, [](const MeshFace & face) { return face.wall; });
  }
}

} // end namespace medialvoxel
