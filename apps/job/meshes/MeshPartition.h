// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshPartition_h
#define medialvoxelMeshPartition_h

#include "MeshReader.h"

#include <array>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class MeshPartition
 * \brief Boxes of space with so many faces of a surface at most.
 *
 * A lattice of cubes is halved across its longest extent, by the number of faces, until no box has more, or each is one
 * cube. A face belongs to the box of its first vertex. The boxes depend on the surface alone. */
class MeshPartition
{
public:
  MeshPartition(MeshReader & reader, std::uint64_t mostFaces);

  std::uint32_t
  GetNumberOfParts() const
  {
    return m_NumberOfParts;
  }

  std::uint32_t
  GetPart(const MeshSpool::Vertex & vertex) const
  {
    return m_PartOf[this->GetCube(vertex)];
  }

private:
  using Index = std::array<unsigned int, 3>;

  /** Cubes from the first to before the last. */
  struct Box
  {
    Index first;
    Index last;
  };

  void
  PlaceLattice(MeshReader & reader);

  std::size_t
  GetCube(const MeshSpool::Vertex & vertex) const;

  template <typename TFunction>
  void
  ForEachCube(const Box & box, TFunction && function) const;

  void
  Divide(const Box & box, const std::vector<std::uint32_t> & faces, std::uint64_t mostFaces);

  std::array<double, 3>      m_Low{};
  double                     m_Edge{ 1 };
  Index                      m_Size{};
  std::vector<std::uint32_t> m_PartOf;
  std::uint32_t              m_NumberOfParts{ 0 };
};

} // end namespace medialvoxel

#endif
