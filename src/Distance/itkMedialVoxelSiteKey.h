// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSiteKey_h
#define itkMedialVoxelSiteKey_h

#include "itkMedialVoxelGrid.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace itk
{

/** \struct MedialVoxelSiteKey
 * \brief Order of possible sites of one voxel as one number, for equal spacings: the nearest site has the smallest key.
 *
 * A key is a whole number below 2^53, so that a double holds it exactly and doubles add and compare it: from the
 * highest bit the squared length in voxels, dz, dy, and one bit for a positive dx. The length of dx follows from the
 * rest. Keys with the same squared length are thus in the order of (z, y, x).
 * \ingroup MedialVoxel
 */
struct MedialVoxelSiteKey
{
  /** Longest component of a displacement that a key holds. */
  static constexpr std::int64_t LongestReach = 4095;

  /** Key of a voxel without a site. */
  static constexpr double NoSite = std::numeric_limits<double>::infinity();

  /** Displacement of the key. */
  std::int64_t dx;
  std::int64_t dy;
  std::int64_t dz;
  std::int64_t squaredLength;

  /** Key of a site in the own column, \a dz slices away. */
  static double
  AlongZ(const double dz)
  {
    return dz * dz * SquareUnit + (dz * (1 << ShiftZ) + (Bias * (1 << ShiftZ) + Bias * (1 << ShiftY)));
  }

  /** Growth of a key when the site is \a dy rows further on. */
  static double
  StepAlongY(const std::int64_t dy)
  {
    return static_cast<double>(dy * dy) * SquareUnit + static_cast<double>(dy * (1 << ShiftY));
  }

  /** Growth of a key when the site is \a dx columns further on. */
  static double
  StepAlongX(const std::int64_t dx)
  {
    return static_cast<double>(dx * dx) * SquareUnit + (dx > 0 ? 1.0 : 0.0);
  }

  /** The displacement of a key, which is not NoSite. */
  static MedialVoxelSiteKey
  Decode(const double key)
  {
    const auto         bits = static_cast<std::int64_t>(key);
    MedialVoxelSiteKey result;
    result.squaredLength = bits >> ShiftSquare;
    result.dz = ((bits >> ShiftZ) & Mask) - Bias;
    result.dy = DecodeY(key);
    const std::int64_t squareX = result.squaredLength - result.dz * result.dz - result.dy * result.dy;
    // Squares of whole numbers below 2^12 have exact roots in float too.
    const auto length = static_cast<std::int64_t>(std::sqrt(static_cast<float>(squareX)));
    result.dx = (bits & 1) != 0 ? length : -length;
    return result;
  }

  /** The displacement of a key along y. */
  static std::int64_t
  DecodeY(const double key)
  {
    return ((static_cast<std::int64_t>(key) >> ShiftY) & Mask) - Bias;
  }

  /** A length in voxels that the displacement of a key does not reach, at most one above it. */
  static std::int64_t
  ReachOf(const double key)
  {
    const auto square = static_cast<std::int64_t>(key * (1.0 / SquareUnit));
    return static_cast<std::int64_t>(std::sqrt(static_cast<double>(square))) + 1;
  }

private:
  static constexpr int          ShiftY = 1;
  static constexpr int          ShiftZ = 14;
  static constexpr int          ShiftSquare = 27;
  static constexpr std::int32_t Bias = 4096;
  static constexpr std::int32_t Mask = 8191;
  static constexpr double       SquareUnit = 134217728.0;
};

} // end namespace itk

#endif
