// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGridLimits_h
#define itkMedialVoxelGridLimits_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <string>
#include <vector>

namespace itk
{

/** \struct MedialVoxelGridLimits
 * \brief Ranges of the numbers that place an image in space, for filters and files.
 *
 * Within them, squares and products of lengths stay far from the ends of the range of numbers, in 32 bits too, so that
 * results do not depend on the unit of length.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelGridLimits
{
  static constexpr double SmallestSpacing = 1e-12;
  static constexpr double LargestSpacing = 1e12;

  /** Largest ratio of the largest to the smallest spacing, among the axes longer than 1. */
  static constexpr double LargestRatio = 1000.0;

  /** Of an axis, of a coordinate of the origin, and of the bounds of an automatic thickness. */
  static constexpr double LargestLength = 1e18;

  /** Voxels along an axis. */
  static constexpr std::uint64_t LargestSize = 2147483647;

  /** Voxels of an image; their bytes are still a valid offset in a file. */
  static constexpr std::uint64_t MostVoxels = std::uint64_t{ 1 } << 59;

  /** Ratio of the largest to the smallest spacing beyond which sheets and thickness are inaccurate. */
  static constexpr double AccurateRatio = 4.0;

  /** Error text with value and range, as in "its spacing along axis 2 is 0; it must be a number from 1e-12 to 1e+12";
   * empty when all is well. The vectors have a value for each axis. */
  static std::string
  FindProblem(const std::vector<std::uint64_t> & size,
              const std::vector<double> &        spacing,
              const std::vector<double> &        origin);

  /** Largest cosine of the angle between two axes; with more, lengths along a straight grid are wrong. */
  static constexpr double LargestShear = 0.01;

  /** Error text for axes that are not at right angles to each other; empty when all are. \param axes unit vectors */
  static std::string
  FindShear(const std::vector<std::vector<double>> & axes);

  /** Ratio of the largest to the smallest spacing, among the axes longer than 1; 1 without any. */
  static double
  RatioOf(const MedialVoxelGrid & grid);

  /** Warning that sheets and thickness are inaccurate on a grid; empty up to AccurateRatio. */
  static std::string
  FindInaccuracy(const MedialVoxelGrid & grid);

  /** The least thickness that a grid resolves: the largest spacing beyond AccurateRatio, otherwise 0. With a smaller
   * one, each step along the longest axis would count as a path around a wall. */
  static double
  LeastThickness(const MedialVoxelGrid & grid);
};

} // end namespace itk

#endif
