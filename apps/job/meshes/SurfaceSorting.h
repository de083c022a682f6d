// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurfaceSorting_h
#define medialvoxelSurfaceSorting_h

#include "SurfaceSpool.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace medialvoxel
{

/** What sorting takes of the scratch folder for a vertex, beside the two surfaces. */
constexpr std::uint64_t ScratchBytesPerSortedVertex = sizeof(std::uint64_t);

/** The same surface with the vertices and faces of each object together, by rising number of the object; those of an
 * object keep their order. A face belongs to the object of its vertices.
 * \param numberOfObjects the largest number
 * \param scratchFolder of the result
 * \param progress called often with 0; may throw to stop
 * \throw JobError as SurfaceSpool */
std::unique_ptr<SurfaceSpool>
SortSurfaceByObject(std::unique_ptr<SurfaceSpool>       surface,
                    std::size_t                         numberOfObjects,
                    const std::filesystem::path &       scratchFolder,
                    const std::function<void(double)> & progress);

} // end namespace medialvoxel

#endif
