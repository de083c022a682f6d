// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallRay.h"

#include "itkMedialVoxelNormalDistribution.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

constexpr std::int64_t Radius = 3; // voxels of the smoothed gradient
constexpr unsigned int StepsPerVoxel = 4;
constexpr unsigned int Bisections = 20;

/** Weights of the smoothed value and of its derivative along an axis, of the voxels from \a first on. */
struct Weights
{
  std::int64_t                       first;
  std::array<double, 2 * Radius + 2> smooth;
  std::array<double, 2 * Radius + 2> derivative;

  explicit Weights(double coordinate)
    : first(static_cast<std::int64_t>(std::floor(coordinate)) - Radius)
    , smooth()
    , derivative()
  {
    double sum = 0.0;
    double moment = 0.0;
    for (std::size_t i = 0; i < smooth.size(); ++i)
    {
      const double distance = static_cast<double>(first + static_cast<std::int64_t>(i)) - coordinate;
      smooth[i] = MedialVoxelNormalDistribution::Get().Density(distance);
      derivative[i] = distance * smooth[i];
      sum += smooth[i];
      moment += derivative[i];
    }
    for (std::size_t i = 0; i < smooth.size(); ++i)
    {
      derivative[i] -= smooth[i] * (moment / sum); // values that are all equal have no derivative
    }
  }
};

} // namespace

MedialVoxelWallRay::MedialVoxelWallRay(const MedialVoxelMargins &           margins,
                                       const MedialVoxelGrid::SpacingType & spacing,
                                       const double                         maximum)
  : m_Margins(margins)
  , m_Spacing(spacing)
  , m_Maximum(maximum)
  , m_Step(*std::min_element(spacing.begin(), spacing.end()) / StepsPerVoxel)
{}

std::int64_t
MedialVoxelWallRay::GetHalo(const double spacingOfSlices, const double maximum)
{
  return std::max(static_cast<std::int64_t>(std::ceil(maximum / spacingOfSlices)) + 2, Radius + 1);
}

MedialVoxelRayResult
MedialVoxelWallRay::Measure(const Point & start) const
{
  if (!this->IsInImage(start))
  {
    return { MedialVoxelRayEnd::Image };
  }
  const std::optional<Point> direction = this->FindDirection(start);
  if (!direction)
  {
    return { MedialVoxelRayEnd::Unknown };
  }
  const auto at = [&](double length) {
    Point point = start;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] += length * (*direction)[axis] / m_Spacing[axis];
    }
    return point;
  };
  bool   hasEntered = false;
  double inside = 0.0;
  for (unsigned int k = 1; k * m_Step <= m_Maximum; ++k)
  {
    const double length = k * m_Step;
    const Point  point = at(length);
    if (!this->IsInImage(point))
    {
      return { MedialVoxelRayEnd::Image };
    }
    const double margin = this->Interpolate(point);
    if (margin >= 0.0)
    {
      hasEntered = true;
      inside = length;
      continue;
    }
    if (std::isnan(margin))
    {
      return { MedialVoxelRayEnd::Unknown };
    }
    if (hasEntered)
    {
      double outside = length;
      for (unsigned int i = 0; i < Bisections; ++i)
      {
        const double middle = 0.5 * (inside + outside);
        (this->Interpolate(at(middle)) >= 0.0 ? inside : outside) = middle;
      }
      return { MedialVoxelRayEnd::Surface, inside };
    }
    if (k >= StepsPerVoxel)
    {
      return { MedialVoxelRayEnd::Unknown };
    }
  }
  return { MedialVoxelRayEnd::Maximum };
}

std::optional<MedialVoxelWallRay::Point>
MedialVoxelWallRay::FindDirection(const Point & start) const
{
  const std::array<Weights, 3> weights{ Weights(start[0]), Weights(start[1]), Weights(start[2]) };
  const auto                   clamped = [this](unsigned int axis, std::int64_t index) {
    return std::clamp<std::int64_t>(index, 0, m_Margins.GetSize()[axis] - 1);
  };
  Point gradient{};
  for (std::size_t k = 0; k < weights[2].smooth.size(); ++k)
  {
    const std::int64_t z = clamped(2, weights[2].first + static_cast<std::int64_t>(k));
    for (std::size_t j = 0; j < weights[1].smooth.size(); ++j)
    {
      const float * const row = m_Margins.GetRow(clamped(1, weights[1].first + static_cast<std::int64_t>(j)), z);
      double              smooth = 0.0;
      double              derivative = 0.0;
      for (std::size_t i = 0; i < weights[0].smooth.size(); ++i)
      {
        const double margin = row[clamped(0, weights[0].first + static_cast<std::int64_t>(i))];
        if (std::isfinite(margin))
        {
          smooth += weights[0].smooth[i] * margin;
          derivative += weights[0].derivative[i] * margin;
        }
      }
      gradient[0] += derivative * weights[1].smooth[j] * weights[2].smooth[k];
      gradient[1] += smooth * weights[1].derivative[j] * weights[2].smooth[k];
      gradient[2] += smooth * weights[1].smooth[j] * weights[2].derivative[k];
    }
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    gradient[axis] /= m_Spacing[axis];
  }
  const double length = MedialVoxelNorm(gradient);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return std::nullopt;
  }
  std::transform(gradient.begin(), gradient.end(), gradient.begin(), [length](double g) { return g / length; });
  return gradient;
}

bool
MedialVoxelWallRay::IsInImage(const Point & point) const
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (!(point[axis] >= 0.0 && point[axis] <= static_cast<double>(m_Margins.GetSize()[axis] - 1)))
    {
      return false;
    }
  }
  return true;
}

double
MedialVoxelWallRay::Interpolate(const Point & point) const
{
  std::array<std::int64_t, 3> lower{};
  std::array<std::int64_t, 3> upper{};
  Point                       share{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    lower[axis] = static_cast<std::int64_t>(point[axis]);
    upper[axis] = std::min(lower[axis] + 1, m_Margins.GetSize()[axis] - 1);
    share[axis] = point[axis] - static_cast<double>(lower[axis]);
  }
  const auto alongX = [&](std::int64_t y, std::int64_t z) {
    const float * const row = m_Margins.GetRow(y, z);
    return (1.0 - share[0]) * row[lower[0]] + share[0] * row[upper[0]];
  };
  const auto alongY = [&](std::int64_t z) {
    return (1.0 - share[1]) * alongX(lower[1], z) + share[1] * alongX(upper[1], z);
  };
  return (1.0 - share[2]) * alongY(lower[2]) + share[2] * alongY(upper[2]);
}

} // end namespace itk
