// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLengthRow_h
#define itkMedialVoxelLengthRow_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

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

  /** True when lengths do not depend on the order of their computation, as all products and sums are exact. */
  static bool
  HasExactLengths(double spacing);

  /** Append the squares from \a begin on and before \a end whose lengths could become another float when computed from
   * the components of a displacement. They are very rare. */
  static void
  AppendDoubtful(double spacing, std::int32_t begin, std::int32_t end, std::vector<std::int32_t> & squares);

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
