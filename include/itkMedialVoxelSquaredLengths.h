// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSquaredLengths_h
#define itkMedialVoxelSquaredLengths_h

#include "itkMedialVoxelGrid.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \struct MedialVoxelSquaredLengths
 * \brief Squared distances in voxels to the nearest boundary voxels, for boxes with equal spacings.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSquaredLengths
{
  /** Least value of a voxel without a boundary voxel, above all distances within the largest size of an image. */
  static constexpr std::int32_t None = 1 << 30;

  /** Largest size of an image along each axis. */
  static constexpr std::int64_t LargestSize = 16384;

  double                    spacing{ 1.0 }; ///< of all axes
  MedialVoxelBox            box;
  std::vector<std::int32_t> values; ///< x fastest
};

} // end namespace itk

#endif
