// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGeodesicLandmarks.h"

#include <algorithm>
#include <cmath>

namespace itk
{

void
MedialVoxelGeodesicLandmarks::Clear()
{
  m_NumberOfLandmarks = 0;
}

void
MedialVoxelGeodesicLandmarks::Add(const std::vector<double> & lengths, const double radius)
{
  if (m_NumberOfLandmarks < MostLandmarks)
  {
    m_Order[m_NumberOfLandmarks] = m_NumberOfLandmarks;
    ++m_NumberOfLandmarks;
  }
  const auto end = m_Order.begin() + static_cast<std::ptrdiff_t>(m_NumberOfLandmarks);
  std::rotate(m_Order.begin(), end - 1, end);
  Landmark & landmark = m_Landmarks[m_Order.front()];
  landmark.radius = radius;
  landmark.lengths.resize(lengths.size());
  std::transform(lengths.begin(), lengths.end(), landmark.lengths.begin(), [](const double length) {
    return static_cast<float>(length);
  });
}

MedialVoxelGeodesicLandmarks::Result
MedialVoxelGeodesicLandmarks::Compare(const NodeType a, const NodeType b, const double lower, const double upper)
{
  for (std::size_t i = 0; i < m_NumberOfLandmarks; ++i)
  {
    const Landmark & landmark = m_Landmarks[m_Order[i]];
    // Points that were not reached are farther than the radius; single precision is far better than the slack.
    const double slack = 1e-5 * landmark.radius;
    const double toA = static_cast<double>(landmark.lengths[a]);
    const double toB = static_cast<double>(landmark.lengths[b]);
    const double nearer = std::min(toA, toB);
    const double farther = std::max(toA, toB);
    Result       result = Result::Undecided;
    if (nearer + farther + slack < lower)
    {
      result = Result::Shorter;
    }
    else if (std::min(farther, landmark.radius) - nearer - slack > upper)
    {
      result = Result::Longer;
    }
    if (result != Result::Undecided)
    {
      const auto position = m_Order.begin() + static_cast<std::ptrdiff_t>(i);
      std::rotate(m_Order.begin(), position, position + 1);
      return result;
    }
  }
  return Result::Undecided;
}

} // end namespace itk
