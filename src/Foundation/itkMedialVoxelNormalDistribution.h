// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNormalDistribution_h
#define itkMedialVoxelNormalDistribution_h

#include "MedialVoxelExport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace itk
{

/** \class MedialVoxelNormalDistribution
 * \brief The standard normal distribution from sums, products and quotients alone.
 *
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

  /** \struct Values
   * \brief Both functions at a place.
   * \ingroup MedialVoxel
   */
  struct Values
  {
    double cumulative;
    double density;
  };

  /** Both from the polynomials of Cumulative(), and faster: the error of the density is below 1e-6. */
  Values
  Evaluate(double x) const
  {
    const double at = std::min(std::abs(x) * Steps, static_cast<double>(Steps * Reach));
    const auto   i = static_cast<std::size_t>(at);
    const double t = at - static_cast<double>(i);
    const double rest = 1.0 - t;
    const double rise = m_Cumulative[i + 1] - m_Cumulative[i];
    const double first = m_Density[i] / Steps - rise;
    const double last = m_Density[i + 1] / Steps - rise;
    const double bend = rest * first - t * last;
    const double upper = m_Cumulative[i] + t * rise + t * rest * bend;
    const double slope = rise + (rest - t) * bend - t * rest * (first + last);
    return { x < 0.0 ? 1.0 - upper : upper, slope * Steps };
  }

private:
  MedialVoxelNormalDistribution();

  static constexpr int Steps = 32; // of the table, from one standard deviation to the next
  static constexpr int Reach = 7;

  std::array<double, Steps * Reach + 2> m_Cumulative{}; // from 0 on
  std::array<double, Steps * Reach + 2> m_Density{};
};

} // end namespace itk

#endif
