// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayBoundary.h"

#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using PositionType = MedialVoxelGrayBoundary::PositionType;

PositionType
Along(const PositionType & start, const PositionType & line, const double times)
{
  return { { start[0] + times * line[0], start[1] + times * line[1], start[2] + times * line[2] } };
}

} // namespace

struct MedialVoxelGrayBoundary::Field
{
  const MedialVoxelGray & gray;
  const MedialVoxelGrid & grid;
  double                  level;
  double                  sign; // positive values are object
  MedialVoxelBox          box;  // of the voxels that may be read

  /** Trilinear; axes of one voxel drop out. */
  double
  At(const PositionType & position) const
  {
    MedialVoxelIndex below;
    MedialVoxelIndex above;
    PositionType     share;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double       floor = std::floor(position[axis]);
      const auto         index = static_cast<std::int64_t>(floor);
      const std::int64_t last = grid.GetSize()[axis] - 1;
      share[axis] = position[axis] - floor;
      below[axis] = std::clamp<std::int64_t>(index, 0, last);
      above[axis] = share[axis] > 0.0 ? std::clamp<std::int64_t>(index + 1, 0, last) : below[axis];
    }
    double sum = 0.0;
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      double           weight = 1.0;
      MedialVoxelIndex voxel;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const bool isAbove = ((corner >> axis) & 1u) != 0;
        weight *= isAbove ? share[axis] : 1.0 - share[axis];
        voxel[axis] = isAbove ? above[axis] : below[axis];
      }
      sum += weight > 0.0 ? weight * static_cast<double>(gray.Get(voxel)) : 0.0;
    }
    return sign * (sum - level);
  }

  /** Of the voxels around a position, smoothed across each axis so that steep components count as much as others
   * (Scharr). */
  PositionType
  GetGradient(const PositionType & position) const
  {
    constexpr double       smooth[3] = { 3.0 / 16, 10.0 / 16, 3.0 / 16 };
    PositionType           gradient{ { 0.0, 0.0, 0.0 } };
    const MedialVoxelIndex margin = grid.GetUnitMargin();
    for (std::int64_t z = -margin[2]; z <= margin[2]; ++z)
    {
      for (std::int64_t y = -margin[1]; y <= margin[1]; ++y)
      {
        for (std::int64_t x = -margin[0]; x <= margin[0]; ++x)
        {
          const double value = this->At({ { position[0] + static_cast<double>(x),
                                            position[1] + static_cast<double>(y),
                                            position[2] + static_cast<double>(z) } });
          gradient[0] += static_cast<double>(x) * smooth[y + 1] * smooth[z + 1] * value;
          gradient[1] += static_cast<double>(y) * smooth[x + 1] * smooth[z + 1] * value;
          gradient[2] += static_cast<double>(z) * smooth[x + 1] * smooth[y + 1] * value;
        }
      }
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] /= grid.GetSpacing()[axis];
    }
    return gradient;
  }

  /** Whether the voxels around a position may be read. */
  bool
  Reaches(const PositionType & position) const
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double last = static_cast<double>(grid.GetSize()[axis] - 1);
      const double inImage = std::clamp(position[axis], 0.0, last);
      if (!(std::floor(inImage) >= static_cast<double>(box.lower[axis]) &&
            std::ceil(inImage) <= static_cast<double>(box.upper[axis] - 1)))
      {
        return false;
      }
    }
    return true;
  }

  /** The multiple of \a line from the start at which the values rise through the threshold; false when they do not. The
   * nearest one, so that another wall behind a narrow gap does not count. */
  bool
  FindCrossing(const PositionType & start, const PositionType & line, double & times) const
  {
    constexpr double step = 0.25;
    constexpr int    first = -3;
    constexpr int    last = 8;
    if (!this->Reaches(start))
    {
      return false;
    }
    double    here = this->At(start);
    const int direction = here < 0.0 ? 1 : -1;
    for (int i = direction; i >= first && i <= last; i += direction)
    {
      const PositionType position = Along(start, line, i * step);
      if (!this->Reaches(position))
      {
        return false;
      }
      const double next = this->At(position);
      if ((here < 0.0) != (next < 0.0))
      {
        times = step * (i - direction * next / (next - here));
        return std::isfinite(times);
      }
      here = next;
    }
    return false;
  }
};

MedialVoxelGrayBoundary::MedialVoxelGrayBoundary(const MedialVoxelGrid & grid, const double lower, const double upper)
  : m_Grid(grid)
  , m_Lower(lower)
  , m_Upper(upper)
{}

/** The mean of the crossings of the threshold on four lines along the gradient around the point. The error of a line
 * depends on its place between the voxels; half a voxel further it has the opposite sign. */
auto
MedialVoxelGrayBoundary::Find(const MedialVoxelGray &  gray,
                              const MedialVoxelIndex & point,
                              const PositionType &     inwards) const -> Crossing
{
  const bool           isBelow = static_cast<double>(gray.Get(point)) < m_Lower;
  const MedialVoxelBox box =
    MedialVoxelBox{ point, { { point[0] + 1, point[1] + 1, point[2] + 1 } } }.Expanded({ { Reach, Reach, Reach } });
  const Field        field{ gray, m_Grid, isBelow ? m_Lower : m_Upper, isBelow ? 1.0 : -1.0, box };
  const PositionType start{
    { static_cast<double>(point[0]), static_cast<double>(point[1]), static_cast<double>(point[2]) }
  };
  const PositionType gradient = field.GetGradient(Along(start, this->ToVoxels(inwards), 0.5));
  const double       length = MedialVoxelNorm(gradient);
  Crossing           mean;
  mean.isRising = isBelow;
  if (!(length > 0.0) || !std::isfinite(length) || !(MedialVoxelDot(gradient, inwards) > 0.0))
  {
    return mean;
  }
  const PositionType line = this->ToVoxels(gradient);
  PositionType       across[2];
  this->GetTangents(gradient, across);
  for (const double first : { -0.25, 0.25 })
  {
    for (const double second : { -0.25, 0.25 })
    {
      const PositionType beside = Along(Along(start, across[0], first), across[1], second);
      double             times = 0.0;
      if (field.FindCrossing(beside, line, times))
      {
        mean.position = Along(mean.position, Along(beside, line, times), 1.0);
        mean.numberOfLines += 1.0;
      }
    }
  }
  for (unsigned int axis = 0; axis < 3 && mean.numberOfLines > 0.0; ++axis)
  {
    mean.position[axis] *= m_Grid.GetSpacing()[axis] / mean.numberOfLines;
    mean.normal[axis] = gradient[axis] / length;
  }
  return mean;
}

bool
MedialVoxelGrayBoundary::FindAround(const MedialVoxelGray & gray,
                                    const MedialVoxelBox &  box,
                                    const PositionType &    place,
                                    const Crossing &        surface,
                                    double &                position) const
{
  const Field        field{ gray, m_Grid, surface.isRising ? m_Lower : m_Upper, surface.isRising ? 1.0 : -1.0, box };
  const PositionType line = this->ToVoxels(surface.normal);
  PositionType       across[2];
  this->GetTangents(surface.normal, across);
  PositionType start; // in voxels
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    start[axis] = place[axis] / m_Grid.GetSpacing()[axis];
  }
  const auto find = [&](const double first, const double second, double & along) {
    const PositionType beside = Along(Along(start, across[0], first), across[1], second);
    double             times = 0.0;
    if (!field.FindCrossing(beside, line, times))
    {
      return false;
    }
    PositionType found = Along(beside, line, times);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      found[axis] *= m_Grid.GetSpacing()[axis];
    }
    along = MedialVoxelDot(found, surface.normal);
    return true;
  };
  // Opposite lines count together, so that a surface which is not quite across the normal is met in the middle.
  double sum = 0.0;
  double numberOfLines = 0.0;
  for (const double first : { -0.75, -0.25, 0.25, 0.75 })
  {
    for (const double second : { 0.25, 0.75 })
    {
      double along[2];
      if (find(first, second, along[0]) && find(-first, -second, along[1]))
      {
        sum += along[0] + along[1];
        numberOfLines += 2.0;
      }
    }
  }
  position = numberOfLines > 0.0 ? sum / numberOfLines : position;
  return numberOfLines > 0.0;
}

auto
MedialVoxelGrayBoundary::ToVoxels(const PositionType & direction) const -> PositionType
{
  PositionType voxels;
  double       largest = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    voxels[axis] = direction[axis] / m_Grid.GetSpacing()[axis];
    largest = std::max(largest, std::abs(voxels[axis]));
  }
  return Along({ { 0.0, 0.0, 0.0 } }, voxels, 1.0 / largest);
}

/** Two directions in voxels along which the values do not change, with 1 as the largest component, or 0 where an image
 * lacks the direction. */
void
MedialVoxelGrayBoundary::GetTangents(const PositionType & gradient, PositionType (&tangents)[2]) const
{
  PositionType steep; // in voxels
  unsigned int steepest = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    steep[axis] = gradient[axis] * m_Grid.GetSpacing()[axis];
    steepest = std::abs(steep[axis]) > std::abs(steep[steepest]) ? axis : steepest;
  }
  for (unsigned int i = 0; i < 2; ++i)
  {
    const unsigned int axis = (steepest + 1 + i) % 3;
    tangents[i] = { { 0.0, 0.0, 0.0 } };
    if (m_Grid.IsActive(axis))
    {
      tangents[i][axis] = 1.0;
      tangents[i][steepest] = -steep[axis] / steep[steepest];
    }
  }
}

} // end namespace itk
