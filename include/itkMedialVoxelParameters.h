// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelParameters_h
#define itkMedialVoxelParameters_h

#include "itkMedialVoxelEnums.h"

#include "MedialVoxelExport.h"

#include <cstdint>

namespace itk
{

/** Labels of dual cells. Medial cells are those with a label of at least MedialByBound. */
namespace MedialVoxelLabel
{
constexpr std::uint8_t NoObject = 0;
constexpr std::uint8_t NonMedial = 1;
constexpr std::uint8_t MedialByBound = 2;
constexpr std::uint8_t MedialByGeodesic = 3;
} // namespace MedialVoxelLabel

/** \struct MedialVoxelParameters
 * \brief Parameters of the classification, in the units of the grid's spacing.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelParameters
{
  /** Threshold on the geodesic distance; a cell is medial when its distance is not below it. */
  double epsilon{ 0.0 };

  MedialVoxelPseudoGeodesicBound bound{ MedialVoxelPseudoGeodesicBound::FreeSpace };

  /** epsilon = pi * thickness / 2 (Michikawa and Suzuki, Eq. 1). */
  static double
  EpsilonFromThickness(double thickness);
};

/** \struct MedialVoxelCounts
 * \brief Numbers of voxels and of dual cells decided by each phase.
 *
 * Every candidate cell is decided by exactly one phase: candidateCells is the sum of the four numbers after it.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelCounts
{
  std::uint64_t objectVoxels{ 0 };
  std::uint64_t boundaryVoxels{ 0 };
  std::uint64_t notANumberVoxels{ 0 };
  std::uint64_t candidateCells{ 0 };
  std::uint64_t trivialCells{ 0 };
  std::uint64_t boundCells{ 0 };
  std::uint64_t geodesicMedialCells{ 0 };
  std::uint64_t geodesicNonMedialCells{ 0 };

  MedialVoxelCounts &
  operator+=(const MedialVoxelCounts & other);
};

} // end namespace itk

#endif
