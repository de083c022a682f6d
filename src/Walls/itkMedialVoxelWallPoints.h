// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallPoints_h
#define itkMedialVoxelWallPoints_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \struct MedialVoxelWallPoints
 * \brief The wall at a medial cell: the nearest boundary points of its corners, and the pair that decided it.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelWallPoints
{
  std::array<MedialVoxelIndex, 8> corners;              ///< the first \a numberOfCorners count
  unsigned int                    numberOfCorners{ 0 }; ///< 2, 4 or 8
  MedialVoxelIndex                a{};                  ///< N(vi) of the chosen diagonal
  MedialVoxelIndex                b{};                  ///< N(vj), not equal to \a a
  MedialVoxelIndex                cell{};               ///< the cell, as the index of its lowest corner

  using SidesType = std::array<std::uint8_t, 8>;

  /** The side of the wall that the point of each corner is on: 0 that of a, 1 that of b, 2 none: on the end of the
   * wall, or the corner across the wall has its point there. Both sides have points. */
  SidesType
  GetSides() const;

  /** The side of the nearer one of a and b in voxels, 2 halfway. */
  SidesType
  GetNearerSides() const;

  /** Whether a and b are at most 3.46 voxels apart, as in walls of up to two layers. */
  bool
  IsThin() const;

  /** The bit of the numbers of corners in which most pairs on opposite sides differ: the axis through the wall. */
  unsigned int
  GetBitOfPairs(const SidesType & sides) const;
};

} // end namespace itk

#endif
