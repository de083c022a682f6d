// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNontrivialEdges_h
#define itkMedialVoxelNontrivialEdges_h

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** Rows of the three components of displacements to the nearest boundary points. */
using MedialVoxelDisplacementRows = std::array<const std::int32_t *, 3>;

/** \brief The voxel edges whose boundary points are more than a voxel apart along some axis.
 *
 * An edge whose voxels both have no boundary point is not one of them; when one of both has none, it may be.
 * \param lower   of the lower voxels of the edges
 * \param upper   of the upper voxels, one further along \a axis
 * \param edges   bits of the edges that are asked for, bit 0 the first one
 * \param number  edges of the row, at most 64; no voxel beyond them is read
 * \return the bits of \a edges that hold; other bits are zero
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT std::uint64_t
                   MedialVoxelNontrivialEdges(const MedialVoxelDisplacementRows & lower,
                                              const MedialVoxelDisplacementRows & upper,
                                              unsigned int                        axis,
                                              std::uint64_t                       edges,
                                              std::int64_t                        number);

} // end namespace itk

#endif
