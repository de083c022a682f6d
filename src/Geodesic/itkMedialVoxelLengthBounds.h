// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLengthBounds_h
#define itkMedialVoxelLengthBounds_h

#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <limits>

namespace itk
{

/** \struct MedialVoxelLengthBounds
 * \brief Bounds of a geodesic distance, in physical units and in floating point.
 * \ingroup MedialVoxel
 */
struct MedialVoxelLengthBounds
{
  double shortest{ 0.0 };                                    ///< the distance is not below it
  double longest{ std::numeric_limits<double>::infinity() }; ///< nor above it

  /** The distance is below \a epsilon, whatever rounding did. */
  bool
  FallShortOf(const double epsilon) const
  {
    return longest < epsilon * (1.0 - MedialVoxelResolutionBand);
  }

  /** The distance is at least \a epsilon, whatever rounding did. */
  bool
  Reach(const double epsilon) const
  {
    return shortest >= epsilon * (1.0 + MedialVoxelResolutionBand);
  }

  /** Take over the bounds of a distance that differs by at most \a difference. */
  void
  Tighten(const MedialVoxelLengthBounds & other, const double difference = 0.0)
  {
    shortest = std::max(shortest, other.shortest - difference);
    longest = std::min(longest, other.longest + difference);
  }
};

} // end namespace itk

#endif
