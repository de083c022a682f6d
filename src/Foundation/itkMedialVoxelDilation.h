// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelDilation_h
#define itkMedialVoxelDilation_h

#include "itkMedialVoxelBits.h"

#include "MedialVoxelExport.h"

#include <cstdint>

namespace itk
{

/** \brief The bits and those of all voxels up to \a reach from them along each axis, within the box of the bits.
 *
 * \param reach  from 1 to 63
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT MedialVoxelBits
MedialVoxelDilate(const MedialVoxelBits & bits, std::int64_t reach);

} // end namespace itk

#endif
