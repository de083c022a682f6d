// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// WriteTestSurface SHAPE CLASS-WIDTH FILE...: writes a surface to files of any format and prints it as JSON.
// CLASS-WIDTH is that of sections; "nodes": the thickness is at nodes.
// SHAPE is one of MakeTestMesh(), or strip:LENGTH,WIDTH,COLUMNS,ROWS,THICKNESS,THICKNESS[,triangles], not printed.

#include "MeshFormat.h"
#include "TestMeshes.h"
#include "Text.h"

#include <iostream>
#include <sstream>
#include <stdexcept>

namespace
{
using namespace medialvoxel;

constexpr char StripPrefix[] = "strip:";

/** Before the name of a shape: small and far from the origin, where it needs 64 bits. */
constexpr char FarPrefix[] = "far-";

/** The shape in another place, with the precision for it. */
TestMesh
MoveFar(TestMesh surface)
{
  for (MeshVertex & vertex : surface.vertices)
  {
    auto & [x, y, z] = vertex.position;
    vertex.position = { 2e7 + 0.3 * x, -2e7 + 0.3 * y, 12345678.9 + 0.3 * z };
  }
  CompleteFaces(surface);
  return surface;
}

Strip
ParseStrip(const std::string & shape)
{
  std::istringstream       text(shape.substr(sizeof(StripPrefix) - 1));
  std::vector<std::string> fields;
  for (std::string field; std::getline(text, field, ',');)
  {
    fields.push_back(field);
  }
  if (fields.size() < 6)
  {
    throw std::invalid_argument("a strip has 6 numbers");
  }
  Strip strip;
  strip.length = std::stod(fields[0]);
  strip.width = std::stod(fields[1]);
  strip.columns = std::stoull(fields[2]);
  strip.rows = std::stoull(fields[3]);
  strip.thicknessAtBegin = std::stod(fields[4]);
  strip.thicknessAtEnd = std::stod(fields[5]);
  strip.triangles = fields.size() > 6 && fields[6] == "triangles";
  return strip;
}

/** A list in brackets. */
template <typename TItems, typename TFormat>
std::string
FormatList(const TItems & items, TFormat format)
{
  return "[" + Join(items, ", ", format) + "]";
}

void
PrintJson(const TestMesh & surface)
{
  const auto number = [](auto value) { return FormatNumber(static_cast<double>(value)); };
  const auto printFaces = [&](const char * key, auto get) {
    std::cout << ",\n \"" << key << "\": " << FormatList(surface.faces, get);
  };
  std::cout << "{\"points\": " << FormatList(surface.vertices, [&](const MeshVertex & vertex) {
    return FormatList(vertex.position, number);
  });
  std::cout << ",\n \"thickness\": "
            << FormatList(surface.vertices, [&](const MeshVertex & vertex) { return number(vertex.thickness); });
  printFaces("faces", [&](const MeshFace & face) {
    const auto begin = face.vertices.begin();
    return FormatList(std::vector<std::uint64_t>(begin, begin + face.numberOfVertices), number);
  });
  printFaces("area", [&](const MeshFace & face) { return number(face.area); });
  printFaces("rim", [&](const MeshFace & face) { return number(face.rimEdges); });
  printFaces("junction", [&](const MeshFace & face) { return number(face.junctionEdges); });
  std::cout << "}\n";
}

void
WriteFiles(const MeshSpool & spool, const std::string & classWidth, const std::vector<std::string> & fileNames)
{
  MeshWriteOptions options;
  if (classWidth == "nodes")
  {
    options.thicknessPlace = ThicknessPlace::Nodes;
  }
  else
  {
    options.thicknessClassWidth = std::stod(classWidth);
  }
  for (const std::string & fileName : fileNames)
  {
    OutputFile file(fileName, false);
    file.Create(0, false);
    WriteMesh(GetMeshFormat(fileName), spool, options, file);
    file.Publish();
  }
}

} // namespace

int
main(int argc, char * argv[])
try
{
  if (argc < 4)
  {
    throw std::invalid_argument("usage: WriteTestSurface SHAPE CLASS-WIDTH FILE...");
  }
  const std::string              shape = argv[1];
  const std::vector<std::string> fileNames(argv + 3, argv + argc);
  const bool                     isFar = shape.rfind(FarPrefix, 0) == 0;
  MeshSpool                      spool(std::filesystem::absolute(fileNames.front()).parent_path(),
                  isFar ? MeshPrecision::Double : MeshPrecision::Single);
  if (shape.rfind(StripPrefix, 0) == 0)
  {
    AddStrip(ParseStrip(shape), spool);
  }
  else
  {
    const TestMesh surface = isFar ? MoveFar(MakeTestMesh(shape.substr(sizeof(FarPrefix) - 1))) : MakeTestMesh(shape);
    AddInPieces(surface, 10, spool);
    PrintJson(surface);
  }
  WriteFiles(spool, argv[2], fileNames);
  return 0;
}
catch (const std::exception & error)
{
  std::cerr << "WriteTestSurface: " << error.what() << '\n';
  return 1;
}
