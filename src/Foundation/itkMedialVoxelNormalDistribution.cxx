// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNormalDistribution.h"

#include "itkMedialVoxelElementary.h"

#include <cmath>
#include <cstddef>

namespace itk
{
namespace
{

/** Density at 0. */
constexpr double AtZero = 0.3989422804014326779;

/** Cumulative(x) - 1/2 over the density at x, a series of terms that are all positive. */
double
GetSeries(const double x)
{
  double sum = x;
  double term = x;
  for (int k = 1; k < 200; ++k)
  {
    term *= x * x / (2 * k + 1);
    sum += term;
  }
  return sum;
}

} // namespace

const MedialVoxelNormalDistribution &
MedialVoxelNormalDistribution::Get()
{
  static const MedialVoxelNormalDistribution distribution;
  return distribution;
}

MedialVoxelNormalDistribution::MedialVoxelNormalDistribution()
{
  for (std::size_t i = 0; i < m_Density.size(); ++i)
  {
    const double x = static_cast<double>(i) / Steps;
    m_Density[i] = AtZero * MedialVoxelElementary::Exponential(-0.5 * x * x);
    m_Cumulative[i] = 0.5 + m_Density[i] * GetSeries(x);
  }
}

double
MedialVoxelNormalDistribution::Density(const double x) const
{
  const double at = std::abs(x) * Steps;
  if (!(at < Steps * Reach))
  {
    return 0.0;
  }
  // Between two places of the table: exp(-(i + d)^2 / 2) = exp(-i^2 / 2) exp(-i d - d^2 / 2), with a short series.
  const auto   i = static_cast<std::size_t>(at);
  const double start = static_cast<double>(i) / Steps;
  const double d = std::abs(x) - start;
  const double y = -d * (start + 0.5 * d);
  return m_Density[i] * (1.0 + y * (1.0 + y * (1.0 / 2 + y * (1.0 / 6 + y * (1.0 / 24 + y * (1.0 / 120))))));
}

double
MedialVoxelNormalDistribution::Cumulative(const double x) const
{
  const double at = std::abs(x) * Steps;
  double       upper = 1.0;
  if (at < Steps * Reach)
  {
    // A cubic polynomial with the values and slopes of both places.
    const auto   i = static_cast<std::size_t>(at);
    const double t = at - static_cast<double>(i);
    const double rise = m_Cumulative[i + 1] - m_Cumulative[i];
    const double first = m_Density[i] / Steps - rise;
    const double last = m_Density[i + 1] / Steps - rise;
    upper = m_Cumulative[i] + t * rise + t * (1.0 - t) * ((1.0 - t) * first - t * last);
  }
  return x < 0.0 ? 1.0 - upper : upper;
}

} // end namespace itk
