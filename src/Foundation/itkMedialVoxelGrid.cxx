// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace itk
{

bool
MedialVoxelBox::Contains(const MedialVoxelBox & other) const
{
  if (other.IsEmpty())
  {
    return true;
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (other.lower[axis] < lower[axis] || other.upper[axis] > upper[axis])
    {
      return false;
    }
  }
  return true;
}

bool
MedialVoxelBox::Contains(const MedialVoxelIndex & index) const
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] < lower[axis] || index[axis] >= upper[axis])
    {
      return false;
    }
  }
  return true;
}

MedialVoxelBox
MedialVoxelBox::Expanded(const MedialVoxelIndex & margin) const
{
  MedialVoxelBox result;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    result.lower[axis] = lower[axis] - margin[axis];
    result.upper[axis] = upper[axis] + margin[axis];
  }
  return result;
}

MedialVoxelBox
MedialVoxelBox::Intersection(const MedialVoxelBox & other) const
{
  MedialVoxelBox result;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    result.lower[axis] = std::max(lower[axis], other.lower[axis]);
    result.upper[axis] = std::max(result.lower[axis], std::min(upper[axis], other.upper[axis]));
  }
  return result;
}

MedialVoxelBox
MedialVoxelBox::Union(const MedialVoxelBox & other) const
{
  if (this->IsEmpty())
  {
    return other;
  }
  if (other.IsEmpty())
  {
    return *this;
  }
  MedialVoxelBox result;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    result.lower[axis] = std::min(lower[axis], other.lower[axis]);
    result.upper[axis] = std::max(upper[axis], other.upper[axis]);
  }
  return result;
}

bool
operator==(const MedialVoxelBox & a, const MedialVoxelBox & b)
{
  return a.lower == b.lower && a.upper == b.upper;
}

MedialVoxelGrid::MedialVoxelGrid(const MedialVoxelIndex & size, const SpacingType & spacing)
  : m_Size(size)
  , m_Spacing(spacing)
{
  const unsigned int none = 3;
  unsigned int       firstActive = none;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    assert(size[axis] > 0 && spacing[axis] > 0.0 && std::isfinite(spacing[axis]));
    if (this->IsActive(axis))
    {
      m_Spacing[axis] = this->FindEqualSpacing(axis);
      firstActive = (firstActive == none) ? axis : firstActive;
      m_HasEqualSpacing = m_HasEqualSpacing && m_Spacing[axis] == m_Spacing[firstActive];
    }
  }
  if (m_HasEqualSpacing)
  {
    m_MetricUnit = (firstActive == none) ? 1.0 : m_Spacing[firstActive];
  }
  else
  {
    m_MetricSpacing = m_Spacing;
  }

  m_ShortestEdge = std::numeric_limits<double>::infinity();
  for (unsigned int mask = 1; mask < 8; ++mask)
  {
    double sum = 0.0;
    bool   exists = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      if (mask & (1u << axis))
      {
        sum += m_Spacing[axis] * m_Spacing[axis];
        exists = exists && this->IsActive(axis);
      }
    }
    m_EdgeLength[mask] = std::sqrt(sum);
    if (exists)
    {
      m_LongestEdge = std::max(m_LongestEdge, m_EdgeLength[mask]);
      m_ShortestEdge = std::min(m_ShortestEdge, m_EdgeLength[mask]);
    }
  }
}

double
MedialVoxelGrid::FindEqualSpacing(const unsigned int axis) const
{
  for (unsigned int other = 0; other < axis; ++other)
  {
    if (this->IsActive(other) && std::abs(m_Spacing[axis] - m_Spacing[other]) <= EqualSpacing * m_Spacing[other])
    {
      return m_Spacing[other];
    }
  }
  return m_Spacing[axis];
}

MedialVoxelBox
MedialVoxelGrid::GetCellBox() const
{
  MedialVoxelBox box = this->GetVoxelBox();
  bool           anyActive = false;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (this->IsActive(axis))
    {
      --box.upper[axis];
      anyActive = true;
    }
  }
  return anyActive ? box : MedialVoxelBox{};
}

MedialVoxelIndex
MedialVoxelGrid::GetUnitMargin() const
{
  MedialVoxelIndex margin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    margin[axis] = this->IsActive(axis) ? 1 : 0;
  }
  return margin;
}

MedialVoxelIndex
MedialVoxelGrid::MarginForMetricLength(const double length) const
{
  MedialVoxelIndex margin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    // No margin needs to exceed the image, which also keeps an infinite length within the integer range.
    const double voxels = std::ceil(length / m_MetricSpacing[axis]);
    margin[axis] =
      this->IsActive(axis) ? static_cast<std::int64_t>(std::min(voxels, static_cast<double>(m_Size[axis]))) : 0;
  }
  return margin;
}

} // end namespace itk
