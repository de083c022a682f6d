// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNormalDistribution_h
#define itkMedialVoxelNormalDistribution_h

#include "MedialVoxelExport.h"

#include <array>

namespace itk
{

/** \class MedialVoxelNormalDistribution
 * \brief The standard normal distribution from sums, products and quotients alone.
 *
 * The functions of a C library may differ in the last bit from one processor to another, and a job may run on several.
 * Errors are below 1e-8; beyond 7 standard deviations the density is 0.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelNormalDistribution
{
public:
  /** The table is made once. */
  static const MedialVoxelNormalDistribution &
  Get();

  /** Share of the distribution below \a x. */
  double
  Cumulative(double x) const;

  double
  Density(double x) const;

private:
  MedialVoxelNormalDistribution();

  static constexpr int Steps = 32; // of the table, from one standard deviation to the next
  static constexpr int Reach = 7;

  std::array<double, Steps * Reach + 2> m_Cumulative{}; // from 0 on
  std::array<double, Steps * Reach + 2> m_Density{};
};

} // end namespace itk

#endif
