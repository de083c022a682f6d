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

  const float *               values{ gray.GetRow(gray.GetBox().lower[1], gray.GetBox().lower[2]) };
  std::array<std::int64_t, 3> pitches{
    { 1, gray.GetBox().Extent(0), gray.GetBox().Extent(0) * gray.GetBox().Extent(1) }
  };

  /** The offset of a voxel along an axis, which beyond a face of the image is that of the outermost voxel. */
  std::int64_t
  GetOffset(const unsigned int axis, const std::int64_t voxel) const
  {
    return (std::clamp<std::int64_t>(voxel, 0, grid.GetSize()[axis] - 1) - gray.GetBox().lower[axis]) * pitches[axis];
  }

  /** A share of 0 does not look at the other value, which need not be finite. */
  static double
  Between(const double first, const double second, const double share)
  {
    return share > 0.0 ? (1.0 - share) * first + share * second : first;
  }

  /** Trilinear; axes of one voxel drop out. */
  double
  At(const PositionType & position) const
  {
    std::int64_t below[3];
    std::int64_t above[3];
    PositionType share;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t index = MedialVoxelFloor(position[axis]);
      share[axis] = position[axis] - static_cast<double>(index);
      below[axis] = this->GetOffset(axis, index);
      above[axis] = share[axis] > 0.0 ? this->GetOffset(axis, index + 1) : below[axis];
    }
    const auto alongX = [&](const std::int64_t row) {
      return Between(static_cast<double>(values[row + below[0]]), static_cast<double>(values[row + above[0]]), share[0]);
    };
    const auto alongY = [&](const std::int64_t slice) {
      return Between(alongX(slice + below[1]), alongX(slice + above[1]), share[1]);
    };
    return sign * (Between(alongY(below[2]), alongY(above[2]), share[2]) - level);
  }

  /** Of the voxels around a position, smoothed across each axis so that steep components count as much as others
   * (Scharr). */
  PositionType
  GetGradient(const PositionType & position) const
  {
    constexpr double       smooth[3] = { 3.0 / 16, 10.0 / 16, 3.0 / 16 };
    const MedialVoxelIndex margin = grid.GetUnitMargin();
    std::int64_t           offsets[3][4];
    PositionType           share;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t floor = MedialVoxelFloor(position[axis]);
      share[axis] = position[axis] - static_cast<double>(floor);
      for (std::int64_t i = 0; i < 4; ++i)
      {
        const std::int64_t step = std::clamp(i - 1, -margin[axis], margin[axis] + (share[axis] > 0.0 ? 1 : 0));
        offsets[axis][i] = this->GetOffset(axis, floor + step);
      }
    }
    // Values between voxels, along one axis after the other.
    double alongX[4][4][3];
    double alongY[4][3][3];
    double around[3][3][3];
    for (unsigned int z = 0; z < 4; ++z)
    {
      for (unsigned int y = 0; y < 4; ++y)
      {
        const float * const row = values + (offsets[2][z] + offsets[1][y]);
        for (unsigned int x = 0; x < 3; ++x)
        {
          alongX[z][y][x] = Between(
            static_cast<double>(row[offsets[0][x]]), static_cast<double>(row[offsets[0][x + 1]]), share[0]);
        }
      }
      for (unsigned int y = 0; y < 3; ++y)
      {
        for (unsigned int x = 0; x < 3; ++x)
        {
          alongY[z][y][x] = Between(alongX[z][y][x], alongX[z][y + 1][x], share[1]);
        }
      }
    }
    for (unsigned int z = 0; z < 3; ++z)
    {
      for (unsigned int y = 0; y < 3; ++y)
      {
        for (unsigned int x = 0; x < 3; ++x)
        {
          around[z][y][x] = sign * (Between(alongY[z][y][x], alongY[z + 1][y][x], share[2]) - level);
        }
      }
    }
    PositionType gradient{ { 0.0, 0.0, 0.0 } };
    for (unsigned int i = 0; i < 3; ++i)
    {
      for (unsigned int k = 0; k < 3; ++k)
      {
        const double weight = smooth[i] * smooth[k];
        gradient[0] += weight * (around[k][i][2] - around[k][i][0]);
        gradient[1] += weight * (around[k][2][i] - around[k][0][i]);
        gradient[2] += weight * (around[2][k][i] - around[0][k][i]);
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
      if (!(inImage >= static_cast<double>(box.lower[axis]) && inImage <= static_cast<double>(box.upper[axis] - 1)))
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
    double     here = this->At(start);
    const int  direction = here < 0.0 ? 1 : -1;
    const bool reachesAll = this->Reaches(Along(start, line, (direction > 0 ? last : first) * step));
    for (int i = direction; i >= first && i <= last; i += direction)
    {
      const PositionType position = Along(start, line, i * step);
      if (!reachesAll && !this->Reaches(position))
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
