// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLocalThicknessSums_h
#define itkMedialVoxelLocalThicknessSums_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \struct MedialVoxelLocalThicknessSums
 * \brief Sums of a map of local thickness over the voxels with a thickness.
 *
 * Whole numbers, so any division of the voxels gives the same sums: lengths are multiples of the maximum over 2^21.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelLocalThicknessSums
{
  std::uint64_t voxels{ 0 };
  std::uint64_t lengths{ 0 };
  std::uint64_t lowSquares{ 0 };  ///< of the lower 32 bits of the squared lengths
  std::uint64_t highSquares{ 0 }; ///< of the upper bits of these
  float         largest{ 0.0f };

  /** \param thickness  of voxels; 0 or NaN: none
   * \param maximum  no thickness is larger; greater than 0 */
  void
  Add(const std::vector<float> & thickness, float maximum);

  MedialVoxelLocalThicknessSums &
  operator+=(const MedialVoxelLocalThicknessSums & other);

  /** 0 without voxels. */
  double
  GetMean(float maximum) const;

  /** Standard deviation of the voxels themselves; 0 without voxels. */
  double
  GetStandardDeviation(float maximum) const;
};

} // end namespace itk

#endif
