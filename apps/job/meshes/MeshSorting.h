// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshSorting_h
#define medialvoxelMeshSorting_h

#include "MeshSpool.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** Bytes of the scratch folder for a vertex while sorting, beside the two meshes. */
constexpr std::uint64_t SortedVertexSize = sizeof(std::uint64_t);

/** The number of the group that a vertex belongs to. */
using MeshGrouping = std::function<std::uint32_t(const MeshSpool::Vertex & vertex)>;

/** A surface with the vertices and faces of each group together, by rising number of the group. */
struct GroupedMesh
{
  std::unique_ptr<MeshSpool> surface;
  std::vector<std::uint64_t> firstVertex; ///< of each group, and the number of all
  std::vector<std::uint64_t> firstFace;
};

/** Vertices and faces of a group keep their order. A face belongs to the group of its first vertex.
 * \param largestGroup the largest number of a group
 * \param scratchFolder of the result
 * \param progress called often with 0; may throw to stop
 * \throw JobError as MeshSpool */
GroupedMesh
SortMesh(std::unique_ptr<MeshSpool>          surface,
         const MeshGrouping &                groupOf,
         std::size_t                         largestGroup,
         const std::filesystem::path &       scratchFolder,
         const std::function<void(double)> & progress);

} // end namespace medialvoxel

#endif
