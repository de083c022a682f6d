// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelNamedCounts_h
#define medialvoxelNamedCounts_h

#include "itkMedialVoxelParameters.h"

#include <array>
#include <cstdint>

namespace medialvoxel
{

/** A count and its name in files. */
struct NamedCount
{
  const char *  name{ nullptr };
  std::uint64_t itk::MedialVoxelCounts::* member{ nullptr };
};

/** All counts, in the order of reports. */
constexpr std::array<NamedCount, sizeof(itk::MedialVoxelCounts) / sizeof(std::uint64_t)> NamedCounts{
  { { "object_voxels", &itk::MedialVoxelCounts::objectVoxels },
    { "boundary_voxels", &itk::MedialVoxelCounts::boundaryVoxels },
    { "not_a_number_voxels", &itk::MedialVoxelCounts::notANumberVoxels },
    { "filled_voxels", &itk::MedialVoxelCounts::filledVoxels },
    { "removed_voxels", &itk::MedialVoxelCounts::removedVoxels },
    { "candidate_cells", &itk::MedialVoxelCounts::candidateCells },
    { "trivial", &itk::MedialVoxelCounts::trivialCells },
    { "bound", &itk::MedialVoxelCounts::boundCells },
    { "geodesic_medial", &itk::MedialVoxelCounts::geodesicMedialCells },
    { "geodesic_non_medial", &itk::MedialVoxelCounts::geodesicNonMedialCells } }
};
static_assert(NamedCounts.back().member != nullptr, "a count has no name");

} // end namespace medialvoxel

#endif
