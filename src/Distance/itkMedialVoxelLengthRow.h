// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLengthRow_h
#define itkMedialVoxelLengthRow_h

#include "MedialVoxelExport.h"

#include <cstdint>

namespace itk
{

/** \class MedialVoxelLengthRow
 * \brief Turns rows of squared distances in voxels into signed distances, or their squares, in units of the spacing.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelLengthRow
{
public:
  /** Voxels that are written at once, at most. */
  static constexpr std::int64_t MostVoxels = 64;

  /** \param spacing  of all axes
   *  \param squared  write squares */
  MedialVoxelLengthRow(double spacing, bool squared);

  /** Write some distances.
   *
   * \param squares    squared distances, at least MedialVoxelSquaredLengths::None for a voxel that gets NaN
   * \param number     voxels, at most MostVoxels
   * \param negatives  bits of the voxels whose distances are negative */
  void
  Write(const std::int32_t * squares, std::int64_t number, std::uint64_t negatives, float * target) const;

private:
  double m_SquaredSpacing;
  bool   m_IsSquared;
  bool   m_FitsFloats; ///< products of the squared spacing and small numbers do
};

} // end namespace itk

#endif
