// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TestMeshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

namespace medialvoxel
{
namespace
{

using Point = std::array<double, 3>;
using Map = std::function<Point(double, double)>;

double
GetTriangleArea(const Point & a, const Point & b, const Point & c)
{
  Point u;
  Point v;
  for (size_t axis = 0; axis < 3; ++axis)
  {
    u[axis] = b[axis] - a[axis];
    v[axis] = c[axis] - a[axis];
  }
  return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
}

double
GetArea(const TestMesh & surface, const MeshFace & face)
{
  const auto   corner = [&](size_t index) { return surface.vertices[face.vertices[index]].position; };
  const double first = GetTriangleArea(corner(0), corner(1), corner(2));
  return face.numberOfVertices == 3 ? first : first + GetTriangleArea(corner(0), corner(2), corner(3));
}

/** Adds a grid of quads over 0..1 x 0..1; vertices where one is already are shared. */
void
AddPatch(TestMesh & surface, unsigned int columns, unsigned int rows, const Map & map)
{
  const auto find = [&](unsigned int column, unsigned int row) {
    const Point position = map(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
    const auto  found = std::find_if(surface.vertices.begin(), surface.vertices.end(), [&](const auto & vertex) {
      const Point & p = vertex.position;
      return std::hypot(p[0] - position[0], p[1] - position[1], p[2] - position[2]) < 1e-9;
    });
    const auto  number = static_cast<std::uint64_t>(found - surface.vertices.begin());
    if (found == surface.vertices.end())
    {
      surface.vertices.push_back({ position, 0.5 + 0.1 * static_cast<double>(number % 7) });
    }
    return number;
  };
  for (unsigned int row = 0; row < rows; ++row)
  {
    for (unsigned int column = 0; column < columns; ++column)
    {
      const std::vector<std::uint64_t> corners{
        find(column, row), find(column + 1, row), find(column + 1, row + 1), find(column, row + 1)
      };
      surface.faces.push_back(MakeFace(corners));
    }
  }
}

TestMesh
MakePlate()
{
  TestMesh surface;
  AddPatch(surface, 5, 3, [](double u, double v) {
    return Point{ 10.1 + 3.7 * u, -4.3 + 2.2 * v + 0.3 * u, 1e-5 + 0.7 * u * v };
  });
  return surface;
}

TestMesh
MakeMixed()
{
  TestMesh              surface = MakePlate();
  std::vector<MeshFace> faces;
  for (const MeshFace & quad : surface.faces)
  {
    const auto & [a, b, c, d] = quad.vertices;
    if (faces.size() % 3 == 0)
    {
      faces.push_back(MakeFace({ a, b, c }));
      faces.push_back(MakeFace({ a, c, d }));
    }
    else
    {
      faces.push_back(quad);
    }
  }
  surface.faces = faces;
  return surface;
}

TestMesh
MakeCylinder()
{
  TestMesh surface;
  AddPatch(surface, 12, 4, [](double u, double v) {
    const double angle = 2 * std::acos(-1.0) * u;
    return Point{ 3 * std::cos(angle), 3 * std::sin(angle), 5 * v };
  });
  return surface;
}

TestMesh
MakeCube()
{
  TestMesh surface;
  for (size_t axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      AddPatch(surface, 3, 3, [&](double u, double v) {
        Point point;
        point[axis] = side;
        point[(axis + 1) % 3] = (2 * u - 1) * side;
        point[(axis + 2) % 3] = 2 * v - 1;
        return point;
      });
    }
  }
  return surface;
}

TestMesh
MakeJunction()
{
  TestMesh surface;
  AddPatch(surface, 6, 4, [](double u, double v) { return Point{ 6 * u, 4 * v, 0 }; });
  AddPatch(surface, 3, 4, [](double u, double v) { return Point{ 3, 4 * v, 3 * u }; });
  return surface;
}

} // namespace

MeshFace
MakeFace(const std::vector<std::uint64_t> & corners)
{
  MeshFace face{};
  face.numberOfVertices = static_cast<std::uint8_t>(corners.size());
  std::copy(corners.begin(), corners.end(), face.vertices.begin());
  return face;
}

void
CompleteFaces(TestMesh & surface)
{
  const auto getEdge = [](const MeshFace & face, unsigned int corner) {
    return std::minmax({ face.vertices[corner], face.vertices[(corner + 1) % face.numberOfVertices] });
  };
  std::map<std::pair<std::uint64_t, std::uint64_t>, unsigned int> facesOfEdge;
  for (const MeshFace & face : surface.faces)
  {
    for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
    {
      ++facesOfEdge[getEdge(face, corner)];
    }
  }
  for (MeshFace & face : surface.faces)
  {
    face.area = GetArea(surface, face);
    for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
    {
      const unsigned int faces = facesOfEdge[getEdge(face, corner)];
      face.rimEdges = static_cast<std::uint8_t>(face.rimEdges | (faces == 1 ? 1U << corner : 0U));
      face.junctionEdges = static_cast<std::uint8_t>(face.junctionEdges | (faces > 2 ? 1U << corner : 0U));
    }
  }
}

TestMesh
MakeTestMesh(const std::string & shape)
{
  const std::map<std::string, TestMesh (*)()> makers{
    { "plate", MakePlate }, { "mixed", MakeMixed },       { "cylinder", MakeCylinder },
    { "cube", MakeCube },   { "junction", MakeJunction }, { "empty", [] { return TestMesh(); } }
  };
  const auto found = makers.find(shape);
  if (found == makers.end())
  {
    throw std::invalid_argument("no shape " + shape);
  }
  TestMesh surface = found->second();
  CompleteFaces(surface);
  return surface;
}

void
AddStrip(const Strip & strip, MeshSink & sink)
{
  const std::uint64_t perRow = strip.columns + 1;
  const double        area =
    strip.length * strip.width / static_cast<double>(strip.columns * strip.rows) / (strip.triangles ? 2 : 1);
  for (std::uint64_t row = 0; row <= strip.rows; ++row)
  {
    std::vector<MeshVertex> vertices;
    std::vector<MeshFace>   faces;
    for (std::uint64_t column = 0; column <= strip.columns; ++column)
    {
      const double u = static_cast<double>(column) / static_cast<double>(strip.columns);
      const double v = static_cast<double>(row) / static_cast<double>(strip.rows);
      vertices.push_back({ { strip.length * u, strip.width * v, 0 },
                           strip.thicknessAtBegin + (strip.thicknessAtEnd - strip.thicknessAtBegin) * u });
    }
    for (std::uint64_t column = 0; row > 0 && column < strip.columns; ++column)
    {
      const std::uint64_t a = (row - 1) * perRow + column;
      const std::uint64_t c = a + perRow + 1;
      if (strip.triangles)
      {
        faces.push_back(MakeFace({ a, a + 1, c }));
        faces.push_back(MakeFace({ a, c, c - 1 }));
      }
      else
      {
        faces.push_back(MakeFace({ a, a + 1, c, c - 1 }));
      }
    }
    for (MeshFace & face : faces)
    {
      face.area = area;
    }
    sink.AddVertices(vertices);
    sink.AddFaces(faces);
  }
}

void
AddInPieces(const TestMesh & surface, size_t pieceSize, MeshSink & sink)
{
  const auto getPiece = [pieceSize](const auto & all, size_t first) {
    using VectorType = std::decay_t<decltype(all)>;
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size()));
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(first + pieceSize, all.size()));
    return VectorType(begin, end);
  };
  for (size_t first = 0; first < std::max(surface.vertices.size(), surface.faces.size()); first += pieceSize)
  {
    sink.AddFaces(getPiece(surface.faces, first));
    sink.AddVertices(getPiece(surface.vertices, first));
  }
}

} // end namespace medialvoxel
