// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSums_h
#define itkMedialVoxelSums_h

#include "itkMedialVoxelLocalThicknessSums.h"
#include "itkMedialVoxelParameters.h"

#include "MedialVoxelExport.h"

#include <cstdint>

namespace itk
{

/** \struct MedialVoxelSums
 * \brief Counts and measurements of tiles, regions or pieces, which add up.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelSums
{
  MedialVoxelCounts             counts;
  std::uint64_t                 voxelsAtMaximum{ 0 };         ///< of the local thickness, whose balls may be cut
  std::uint64_t                 voxelsWithoutWall{ 0 };       ///< of the local thickness, that no wall covers
  MedialVoxelLocalThicknessSums localThickness;               ///< over the voxels that have one
  std::uint64_t                 recomputedVoxels{ 0 };        ///< of tiles that depended on more than the window held
  double                        distanceSeconds{ 0.0 };       ///< of all threads together
  double                        classificationSeconds{ 0.0 }; ///< of all threads together
  double                        threadSeconds{ 0.0 };         ///< of all threads together, on tiles and windows
  double                        tileSeconds{ 0.0 };           ///< from the first to the last work of each run

  MedialVoxelSums &
  operator+=(const MedialVoxelSums & other);
};

} // end namespace itk

#endif
