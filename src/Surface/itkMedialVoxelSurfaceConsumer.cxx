// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceConsumer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{

namespace
{

/** Share of the shortest step by which rounding may move a coordinate. */
constexpr double LargestRounding = 0.001;

} // namespace

MedialVoxelSurfaceConsumer::~MedialVoxelSurfaceConsumer() = default;

double
MedialVoxelSurfacePlacement::LargestCoordinate(const MedialVoxelIndex & size) const
{
  double largest = 0.0;
  for (unsigned int component = 0; component < 3; ++component)
  {
    // Of all corners of the image.
    double lower = origin[component];
    double upper = lower;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double extent = steps[axis][component] * static_cast<double>(size[axis] - 1);
      lower += std::min(extent, 0.0);
      upper += std::max(extent, 0.0);
    }
    largest = std::max({ largest, std::abs(lower), std::abs(upper) });
  }
  return largest;
}

bool
MedialVoxelSurfacePlacement::FitsFloat(const MedialVoxelIndex & size) const
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::array<double, 3> & step : steps)
  {
    shortest = std::min(shortest, std::sqrt((step[0] * step[0] + step[1] * step[1]) + step[2] * step[2]));
  }
  constexpr double half = 0.5 * std::numeric_limits<float>::epsilon();
  return this->LargestCoordinate(size) * half <= LargestRounding * shortest;
}

} // end namespace itk
