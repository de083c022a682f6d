// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshPartition.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace medialvoxel
{
namespace
{

/** Cubes along the longest extent. */
constexpr unsigned int MostCubes = 127;

} // namespace

MeshPartition::MeshPartition(MeshReader & reader, const std::uint64_t mostFaces)
{
  this->PlaceLattice(reader);
  std::vector<std::uint32_t> faces(m_PartOf.size());
  reader.ForEachFace(
    [&](std::uint64_t, const MeshFace & face) { ++faces[this->GetCube(reader.GetVertex(face.vertices[0]))]; });
  this->Divide({ { { 0, 0, 0 } }, m_Size }, faces, mostFaces);
}

void
MeshPartition::PlaceLattice(MeshReader & reader)
{
  constexpr double      infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> high{ { -infinity, -infinity, -infinity } };
  m_Low = { { infinity, infinity, infinity } };
  reader.ForEachVertex([&](std::uint64_t, const MeshSpool::Vertex & vertex) {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Low[axis] = std::min(m_Low[axis], vertex.position[axis]);
      high[axis] = std::max(high[axis], vertex.position[axis]);
    }
  });
  double extent = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    extent = std::max(extent, high[axis] - m_Low[axis]);
  }
  m_Edge = extent > 0.0 ? extent / MostCubes : 1.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_Size[axis] = static_cast<unsigned int>(std::max(0.0, high[axis] - m_Low[axis]) / m_Edge) + 1;
  }
  m_PartOf.resize(std::size_t{ m_Size[0] } * m_Size[1] * m_Size[2]);
}

std::size_t
MeshPartition::GetCube(const MeshSpool::Vertex & vertex) const
{
  std::size_t cube = 0;
  for (unsigned int axis = 3; axis-- > 0;)
  {
    const double place = std::max(0.0, (vertex.position[axis] - m_Low[axis]) / m_Edge);
    cube = cube * m_Size[axis] + std::min(static_cast<unsigned int>(place), m_Size[axis] - 1);
  }
  return cube;
}

template <typename TFunction>
void
MeshPartition::ForEachCube(const Box & box, TFunction && function) const
{
  Index cube;
  for (cube[2] = box.first[2]; cube[2] < box.last[2]; ++cube[2])
  {
    for (cube[1] = box.first[1]; cube[1] < box.last[1]; ++cube[1])
    {
      for (cube[0] = box.first[0]; cube[0] < box.last[0]; ++cube[0])
      {
        function(cube, (std::size_t{ cube[2] } * m_Size[1] + cube[1]) * m_Size[0] + cube[0]);
      }
    }
  }
}

void
MeshPartition::Divide(const Box & box, const std::vector<std::uint32_t> & faces, const std::uint64_t mostFaces)
{
  unsigned int longest = 0;
  for (unsigned int axis = 1; axis < 3; ++axis)
  {
    longest = box.last[axis] - box.first[axis] > box.last[longest] - box.first[longest] ? axis : longest;
  }
  std::vector<std::uint64_t> ofLayer(box.last[longest] - box.first[longest]);
  this->ForEachCube(box, [&](const Index & cube, const std::size_t number) {
    ofLayer[cube[longest] - box.first[longest]] += faces[number];
  });
  const std::uint64_t all = std::accumulate(ofLayer.begin(), ofLayer.end(), std::uint64_t{ 0 });
  if (all <= mostFaces || ofLayer.size() == 1)
  {
    this->ForEachCube(box, [&](const Index &, const std::size_t number) { m_PartOf[number] = m_NumberOfParts; });
    ++m_NumberOfParts;
    return;
  }
  // The first boundary with at least half of the faces before it, but not the end.
  unsigned int  layers = 1;
  std::uint64_t before = ofLayer[0];
  while (layers + 1 < ofLayer.size() && 2 * before < all)
  {
    before += ofLayer[layers++];
  }
  Box low = box;
  Box high = box;
  low.last[longest] = high.first[longest] = box.first[longest] + layers;
  this->Divide(low, faces, mostFaces);
  this->Divide(high, faces, mostFaces);
}

} // end namespace medialvoxel
