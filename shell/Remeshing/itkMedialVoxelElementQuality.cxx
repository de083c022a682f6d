// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelElementQuality.h"

#include "itkMedialVoxelElementary.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;

/** Aspect ratio that stands for a quality of 1. */
constexpr double GoodAspect = 1.3;

template <std::size_t VCorners>
std::array<Vector, VCorners>
GetSides(const std::array<Vector, VCorners> & corners)
{
  std::array<Vector, VCorners> sides;
  for (std::size_t k = 0; k < VCorners; ++k)
  {
    sides[k] = MedialVoxelSubtract(corners[(k + 1) % VCorners], corners[k]);
  }
  return sides;
}

double
ToDegrees(const double cosine)
{
  return MedialVoxelElementary::ArcCosine(cosine) * 180.0 / 3.14159265358979323846;
}

/** Longest side times circumference, over the area times a number that makes it 1 for the best shape. */
template <std::size_t VCorners>
double
GetAspectRatio(const std::array<Vector, VCorners> & sides, const double area, const double best)
{
  double longest = 0.0;
  double sum = 0.0;
  for (const Vector & side : sides)
  {
    const double length = MedialVoxelNorm(side);
    longest = std::max(longest, length);
    sum += length;
  }
  return area > 0.0 ? longest * sum / (best * area) : std::numeric_limits<double>::infinity();
}

/** The least cosine of the angle between the normals at two corners. */
double
GetLeastCosine(const std::array<Vector, 4> & points)
{
  std::array<Vector, 4> normals;
  for (std::size_t corner = 0; corner < 4; ++corner)
  {
    normals[corner] =
      MedialVoxelTriangleNormal({ { points[(corner + 3) % 4], points[corner], points[(corner + 1) % 4] } });
  }
  double least = 1.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    for (std::size_t k = i + 1; k < 4; ++k)
    {
      least = std::min(least, MedialVoxelCosine(normals[i], normals[k]));
    }
  }
  return least;
}

/** Of a quadrilateral: the sum of the normals of its corners, twice its area in the mean. */
Vector
GetNormal(const std::array<Vector, 4> & corners)
{
  return MedialVoxelCross(MedialVoxelSubtract(corners[2], corners[0]), MedialVoxelSubtract(corners[3], corners[1]));
}

} // namespace

double
MedialVoxelScaledJacobian(const std::array<Vector, 3> & corners)
{
  const auto   sides = GetSides(corners);
  const double a = MedialVoxelNorm(sides[0]);
  const double b = MedialVoxelNorm(sides[1]);
  const double c = MedialVoxelNorm(sides[2]);
  const double product = std::max({ a * b, b * c, c * a });
  return product > 0.0 ? MedialVoxelNorm(MedialVoxelTriangleNormal(corners)) / product * (2.0 / std::sqrt(3.0)) : 0.0;
}

double
MedialVoxelScaledJacobian(const std::array<Vector, 4> & corners)
{
  const auto   sides = GetSides(corners);
  const Vector normal = GetNormal(corners);
  const double length = MedialVoxelNorm(normal);
  double       least = length > 0.0 ? 1.0 : 0.0;
  for (unsigned int k = 0; k < 4 && length > 0.0; ++k)
  {
    const Vector & before = sides[(k + 3) % 4];
    const double   product = MedialVoxelNorm(before) * MedialVoxelNorm(sides[k]) * length;
    const double   jacobian = MedialVoxelDot(MedialVoxelCross(before, sides[k]), normal);
    least = std::min(least, product > 0.0 ? jacobian / product : 0.0);
  }
  return least;
}

double
MedialVoxelAspectRatio(const std::array<Vector, 3> & corners)
{
  return GetAspectRatio(
    GetSides(corners), MedialVoxelNorm(MedialVoxelTriangleNormal(corners)) / 2.0, 4.0 * std::sqrt(3.0));
}

double
MedialVoxelAspectRatio(const std::array<Vector, 4> & corners)
{
  return GetAspectRatio(GetSides(corners), MedialVoxelNorm(GetNormal(corners)) / 2.0, 4.0);
}

double
MedialVoxelShellQuality(const std::array<Vector, 3> & corners)
{
  return MedialVoxelScaledJacobian(corners);
}

double
MedialVoxelShellQuality(const std::array<Vector, 4> & corners)
{
  return std::min({ MedialVoxelScaledJacobian(corners),
                    2.0 * GetLeastCosine(corners) - 1.0,
                    GoodAspect / MedialVoxelAspectRatio(corners) });
}

double
MedialVoxelWarpage(const std::array<Vector, 4> & corners)
{
  double least = 1.0;
  for (const std::size_t k : { 0, 1 })
  {
    const auto at = [&](const std::size_t n) { return corners[(k + n) % 4]; };
    least = std::min(least,
                     MedialVoxelCosine(MedialVoxelTriangleNormal({ { at(0), at(1), at(2) } }),
                                       MedialVoxelTriangleNormal({ { at(2), at(3), at(0) } })));
  }
  return ToDegrees(least);
}

void
MedialVoxelElementShapes::Add(const std::vector<MedialVoxelVector3> & points,
                              const std::array<std::uint32_t, 4> &    corners,
                              const unsigned int                      number)
{
  const auto at = [&](const unsigned int k) { return points[corners[k]]; };
  if (number == 4)
  {
    const std::array<Vector, 4> places{ { at(0), at(1), at(2), at(3) } };
    this->AddShape(places);
    m_Warpages.push_back(MedialVoxelWarpage(places));
  }
  else
  {
    this->AddShape(std::array<Vector, 3>{ { at(0), at(1), at(2) } });
  }
}

template <std::size_t VCorners>
void
MedialVoxelElementShapes::AddShape(const std::array<Vector, VCorners> & corners)
{
  const auto sides = GetSides(corners);
  m_Jacobians.push_back(MedialVoxelScaledJacobian(corners));
  m_Aspects.push_back(MedialVoxelAspectRatio(corners));
  for (std::size_t k = 0; k < VCorners; ++k)
  {
    const Vector back = MedialVoxelAddScaled({}, sides[(k + VCorners - 1) % VCorners], -1.0);
    m_Cosines.push_back(MedialVoxelCosine(sides[k], back));
    m_Lengths.push_back(MedialVoxelNorm(sides[k]));
  }
}

MedialVoxelShapeSummary
MedialVoxelElementShapes::Summarize() const
{
  MedialVoxelShapeSummary summary;
  if (!m_Jacobians.empty())
  {
    std::vector<double> jacobians = m_Jacobians;
    std::vector<double> aspects = m_Aspects;
    summary.notPositive = static_cast<std::uint64_t>(
      std::count_if(jacobians.begin(), jacobians.end(), [](const double jacobian) { return !(jacobian > 0.0); }));
    summary.leastJacobian = *std::min_element(jacobians.begin(), jacobians.end());
    summary.lowJacobian = MedialVoxelFindPercentile(jacobians, 0.01);
    summary.highAspect = MedialVoxelFindPercentile(aspects, 0.99);
    summary.largestAspect = *std::max_element(aspects.begin(), aspects.end());
    const auto [least, largest] = std::minmax_element(m_Cosines.begin(), m_Cosines.end());
    summary.leastAngle = ToDegrees(*largest);
    summary.largestAngle = ToDegrees(*least);
    const auto [shortest, longest] = std::minmax_element(m_Lengths.begin(), m_Lengths.end());
    summary.shortestSide = *shortest;
    summary.longestSide = *longest;
    summary.meanSide = std::accumulate(m_Lengths.begin(), m_Lengths.end(), 0.0) / static_cast<double>(m_Lengths.size());
  }
  if (!m_Warpages.empty())
  {
    std::vector<double> warpages = m_Warpages;
    summary.highWarpage = MedialVoxelFindPercentile(warpages, 0.99);
    summary.largestWarpage = *std::max_element(warpages.begin(), warpages.end());
  }
  return summary;
}

double
MedialVoxelFindPercentile(std::vector<double> & values, const double share)
{
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

} // end namespace itk
