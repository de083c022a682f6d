// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBoundary_h
#define itkMedialVoxelBoundary_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelEnums.h"

namespace itk
{

/** \brief Boundary voxels of the object, for all voxels of a box.
 *
 * \param object    object voxels; its box holds \a box and a margin of 1 voxel, as far as the image goes
 * \param image     all voxels of the image; others are neither object nor background
 * \param kind      which side of the border is the boundary, see MedialVoxelEnums::Boundary
 * \param box       voxels to decide
 * \param boundary  result; its box holds \a box, in which its bits are clear
 *
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT void
MedialVoxelComputeBoundary(const MedialVoxelBits & object,
                           const MedialVoxelBox &  image,
                           MedialVoxelBoundary     kind,
                           const MedialVoxelBox &  box,
                           MedialVoxelBits &       boundary);

} // end namespace itk

#endif
