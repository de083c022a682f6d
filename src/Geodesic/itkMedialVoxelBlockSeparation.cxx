// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBlockSeparation.h"

#include <cmath>

namespace itk
{

MedialVoxelBox
MedialVoxelBlockSeparation::GetBox(const Extent & extent, const double length) const
{
  // A path that leaves the box by the plane beside it is at least 2 sqrt(h^2 + s^2 / 4) long, with the length s of the
  // pair and the distance h from its nearer point to the plane.
  const double     focalSum = length / m_Grid.GetMetricUnit() * (1.0 + 2.0 * MedialVoxelResolutionBand);
  const double     squaredWay = 0.25 * std::max(0.0, focalSum * focalSum - extent.squaredLength);
  MedialVoxelIndex margin = m_Grid.MarginForMetricLength(std::sqrt(squaredWay));
  for (std::int64_t & steps : margin)
  {
    steps = std::max<std::int64_t>(steps - 1, 0);
  }
  return extent.points.Expanded(margin).Intersection(m_Grid.GetVoxelBox());
}

} // end namespace itk
