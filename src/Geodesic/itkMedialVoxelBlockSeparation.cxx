// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBlockSeparation.h"

#include <cmath>

namespace itk
{

MedialVoxelBox
MedialVoxelBlockSeparation::GetBox(const Extent & extent) const
{
  // Paths stay in an ellipsoid around their points; along the line through them it reaches less far beyond them.
  const double unit = m_Grid.GetMetricUnit();
  const double focalSum = extent.epsilon / unit * (1.0 + 8.0 * MedialVoxelResolutionBand);
  const double squaredMinor = 0.25 * std::max(0.0, focalSum * focalSum - extent.squaredLength);
  return extent.points.Expanded(m_Grid.MarginForMetricLength(std::sqrt(squaredMinor)))
    .Intersection(m_Grid.GetVoxelBox());
}

} // end namespace itk
