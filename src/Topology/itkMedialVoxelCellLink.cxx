// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelCellLink.h"

#include "itkMedialVoxelBits.h"

#include <algorithm>

namespace itk
{

namespace
{

/** Two vertices of the octahedron. */
struct Edge
{
  int first;
  int second;
};

/** Vertices 0 to 5 are one step down and up along x, y, z. */
constexpr std::array<Edge, 12> Edges{ { { 0, 2 },
                                        { 1, 2 },
                                        { 0, 3 },
                                        { 1, 3 },
                                        { 0, 4 },
                                        { 1, 4 },
                                        { 0, 5 },
                                        { 1, 5 },
                                        { 2, 4 },
                                        { 3, 4 },
                                        { 2, 5 },
                                        { 3, 5 } } };

/** Vertices of the triangle in an octant. */
constexpr std::uint32_t
VerticesOf(const std::uint32_t octant)
{
  return (1u << (octant & 1u)) | (4u << ((octant >> 1) & 1u)) | (16u << (octant >> 2));
}

/** The first \a number of bits, each set where it is in. */
template <typename TIsIn>
std::uint32_t
Collect(const std::uint32_t number, const TIsIn & isIn)
{
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < number; ++i)
  {
    bits |= isIn(i) ? 1u << i : 0u;
  }
  return bits;
}

std::uint32_t
VerticesOfEdge(const std::uint32_t edge)
{
  return (1u << Edges[edge].first) | (1u << Edges[edge].second);
}

/** Parts of the graph of all six vertices with some of the edges. */
std::uint8_t
CountParts(const std::uint32_t edges)
{
  std::array<int, 6> part{ { 0, 1, 2, 3, 4, 5 } };
  std::uint8_t       number = 6;
  for (std::uint32_t edge = 0; edge < Edges.size(); ++edge)
  {
    const int from = part[static_cast<std::size_t>(Edges[edge].first)];
    const int to = part[static_cast<std::size_t>(Edges[edge].second)];
    if (((edges >> edge) & 1u) != 0 && from != to)
    {
      std::replace(part.begin(), part.end(), from, to);
      --number;
    }
  }
  return number;
}

} // namespace

struct MedialVoxelCellLink::Tables
{
  std::array<std::uint8_t, 256>  verticesOfVoxels{};
  std::array<std::uint16_t, 256> edgesOfVoxels{};
  std::array<std::uint16_t, 64>  edgesOfVertices{};
  std::array<std::uint8_t, 4096> trianglesOfEdges{};
  std::array<std::uint8_t, 4096> parts{};

  Tables()
  {
    const auto touches = [](const std::uint32_t voxels, const std::uint32_t vertices) {
      return Collect(8, [&](const std::uint32_t octant) {
               return ((voxels >> octant) & 1u) != 0 && (VerticesOf(octant) & vertices) == vertices;
             }) != 0;
    };
    for (std::uint32_t voxels = 0; voxels < 256; ++voxels)
    {
      verticesOfVoxels[voxels] = static_cast<std::uint8_t>(
        Collect(6, [&](const std::uint32_t vertex) { return touches(voxels, 1u << vertex); }));
      edgesOfVoxels[voxels] = static_cast<std::uint16_t>(
        Collect(12, [&](const std::uint32_t edge) { return touches(voxels, VerticesOfEdge(edge)); }));
    }
    for (std::uint32_t vertices = 0; vertices < 64; ++vertices)
    {
      edgesOfVertices[vertices] = static_cast<std::uint16_t>(
        Collect(12, [&](const std::uint32_t edge) { return (VerticesOfEdge(edge) & ~vertices) == 0; }));
    }
    for (std::uint32_t edges = 0; edges < 4096; ++edges)
    {
      trianglesOfEdges[edges] = static_cast<std::uint8_t>(Collect(8, [&](const std::uint32_t octant) {
        const std::uint32_t own = edgesOfVertices[VerticesOf(octant)];
        return (own & ~edges) == 0;
      }));
      parts[edges] = CountParts(edges);
    }
  }
};

auto
MedialVoxelCellLink::GetTables() -> const Tables &
{
  static const Tables tables;
  return tables;
}

bool
MedialVoxelCellLink::IsSimple(const std::uint32_t cells, const std::uint32_t voxels)
{
  const Tables &      tables = GetTables();
  const auto          bit = [cells](const int from, const int to) { return ((cells >> from) & 1u) << to; };
  const std::uint32_t vertices =
    tables.verticesOfVoxels[voxels] & (bit(12, 0) | bit(14, 1) | bit(10, 2) | bit(16, 3) | bit(4, 4) | bit(22, 5));
  if (vertices == 0)
  {
    return false;
  }
  std::uint32_t edges = tables.edgesOfVoxels[voxels] & tables.edgesOfVertices[vertices];
  if (edges != 0)
  {
    edges &= bit(9, 0) | bit(11, 1) | bit(15, 2) | bit(17, 3) | bit(3, 4) | bit(5, 5) | bit(21, 6) | bit(23, 7) |
             bit(1, 8) | bit(7, 9) | bit(19, 10) | bit(25, 11);
  }
  const int numberOfVertices = MedialVoxelPopulationCount(vertices);
  // Vertices that are not in the link are parts of their own.
  if (tables.parts[edges] - (6 - numberOfVertices) != 1)
  {
    return false;
  }
  std::uint32_t triangles = voxels & tables.trianglesOfEdges[edges];
  if (triangles != 0)
  {
    triangles &= bit(0, 0) | bit(2, 1) | bit(6, 2) | bit(8, 3) | bit(18, 4) | bit(20, 5) | bit(24, 6) | bit(26, 7);
  }
  return numberOfVertices - MedialVoxelPopulationCount(edges) + MedialVoxelPopulationCount(triangles) == 1;
}

} // end namespace itk
