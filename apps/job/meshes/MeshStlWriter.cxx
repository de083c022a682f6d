// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshElements.h"
#include "MeshWriters.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

constexpr size_t HeaderSize = 80;

using Position = std::array<float, 3>;

/** The unit normal to the side that sees the corners counterclockwise; zero for a triangle without area. */
Position
GetNormal(const std::array<Position, 3> & corners)
{
  std::array<double, 3> first{};
  std::array<double, 3> second{};
  for (size_t axis = 0; axis < 3; ++axis)
  {
    first[axis] = static_cast<double>(corners[1][axis]) - static_cast<double>(corners[0][axis]);
    second[axis] = static_cast<double>(corners[2][axis]) - static_cast<double>(corners[0][axis]);
  }
  const std::array<double, 3> product{ first[1] * second[2] - first[2] * second[1],
                                       first[2] * second[0] - first[0] * second[2],
                                       first[0] * second[1] - first[1] * second[0] };

  const double length = std::sqrt(product[0] * product[0] + product[1] * product[1] + product[2] * product[2]);
  const double scale = length > 0 ? 1 / length : 0;
  return { static_cast<float>(product[0] * scale),
           static_cast<float>(product[1] * scale),
           static_cast<float>(product[2] * scale) };
}

void
WriteTriangle(const std::array<Position, 3> & corners, BufferedOutput & output)
{
  const auto write = [&output](const Position & position) {
    for (const float coordinate : position)
    {
      output.LittleEndian(coordinate);
    }
  };
  write(GetNormal(corners));
  for (const Position & corner : corners)
  {
    write(corner);
  }
  output.LittleEndian(std::uint16_t{ 0 });
}

} // namespace

void
WriteMeshStl(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(0, 1);
  // Readers take a header that begins with "solid" for a text file.
  std::string header = GetTitle(options);
  header.resize(HeaderSize, ' ');
  output.Text(header);
  const MeshSpool & surface = reader.GetMesh();
  output.LittleEndian(static_cast<std::uint32_t>(surface.GetNumberOfTriangles() + 2 * surface.GetNumberOfQuads()));
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    for (const auto & triangle : GetTriangles(reader, face))
    {
      std::array<Position, 3> corners;
      for (size_t corner = 0; corner < corners.size(); ++corner)
      {
        const auto & position = reader.GetVertex(face.vertices[triangle[corner]]).position;
        std::transform(position.begin(), position.end(), corners[corner].begin(), [](double coordinate) {
          return static_cast<float>(coordinate);
        });
      }
      WriteTriangle(corners, output);
    }
  });
}

} // end namespace medialvoxel
