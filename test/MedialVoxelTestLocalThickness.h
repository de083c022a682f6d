// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MedialVoxelTestLocalThickness_h
#define MedialVoxelTestLocalThickness_h

#include "itkLocalThicknessImageFilter.h"

#include "MedialVoxelTestRuns.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace MedialVoxelTest
{

template <unsigned int VDimension>
using ThicknessFilter = itk::LocalThicknessImageFilter<MaskImage<VDimension>>;

/** Twice the radius of the largest ball that covers each object voxel, by the definition. */
inline std::vector<float>
ExpectedThickness(const Volume & volume, const double maximumThickness)
{
  // Lengths that are equal must not differ by rounding.
  const itk::MedialVoxelGrid grid({ { volume.size[0], volume.size[1], volume.size[2] } }, volume.spacing);
  const double               maximumRadius = 0.5 * maximumThickness / grid.GetMetricUnit();
  const double               largest = maximumRadius * maximumRadius;
  const auto                 squareOf = [&grid](const Index3 & a, const Index3 & b) {
    double squares[3];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double d = static_cast<double>(a[axis] - b[axis]) * grid.GetMetricSpacing()[axis];
      squares[axis] = d * d;
    }
    return (squares[0] + squares[1]) + squares[2];
  };
  std::vector<Index3> object;
  std::vector<Index3> background;
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    (volume.object[i] ? object : background).push_back(volume.IndexAt(i));
  }
  std::vector<double> radii;
  for (const Index3 & center : object)
  {
    double nearest = largest;
    for (const Index3 & other : background)
    {
      nearest = std::min(nearest, squareOf(center, other));
    }
    radii.push_back(nearest);
  }
  std::vector<float> expected(volume.object.size(), 0.0f);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    double found = 0.0;
    for (std::size_t c = 0; volume.object[i] && c < object.size(); ++c)
    {
      if (squareOf(object[c], volume.IndexAt(i)) < radii[c])
      {
        found = std::max(found, radii[c]);
      }
    }
    const double radius = found == largest ? 0.5 * maximumThickness : std::sqrt(found) * grid.GetMetricUnit();
    expected[i] = 2.0f * static_cast<float>(radius);
  }
  return expected;
}

} // namespace MedialVoxelTest

#endif
