// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayLocal.h"

#include "itkMedialVoxelLanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;

/** Voxels of a row of a slice of a cylinder, of which at most 7 are in it, and those that are computed side by side. */
constexpr std::size_t VoxelsOfRow = 8;
constexpr std::size_t VoxelsOfHalf = 4;
using Half = MedialVoxelLanesOf<double, VoxelsOfHalf>;
using RoundedHalf = MedialVoxelLanesOf<float, VoxelsOfHalf>;

struct Line
{
  const float *               values;
  MedialVoxelBox              box; // of the values
  const MedialVoxelGrid &     grid;
  std::array<std::int64_t, 3> pitches;
  Vector                      place;
  Vector                      direction;
  double                      reach;
  double                      background;
  double                      scale;

  /** The offset of a voxel along an axis, which beyond a face of the image is that of the outermost voxel. */
  std::int64_t
  GetOffset(const unsigned int axis, const std::int64_t voxel) const
  {
    return (std::clamp<std::int64_t>(voxel, box.lower[axis], box.upper[axis] - 1) - box.lower[axis]) * pitches[axis];
  }
};

using Values = std::array<float, VoxelsOfRow>;

MEDIALVOXEL_INLINE Half
MakeSteps(const std::size_t first)
{
  Half steps;
  for (std::size_t i = 0; i < VoxelsOfHalf; ++i)
  {
    steps[i] = static_cast<double>(first + i);
  }
  return steps;
}

MEDIALVOXEL_INLINE void
Store(const Half & half, float * const to)
{
  const auto rounded = MedialVoxelConvert<RoundedHalf>(half);
  std::memcpy(to, &rounded, sizeof(rounded));
}

/** The voxels near a line. */
MEDIALVOXEL_INLINE void
PutSamples(const Line & line, MedialVoxelGrayLocal::Samples & samples)
{
  constexpr double radius = MedialVoxelGrayLocal::Radius;
  const Vector &   place = line.place;
  const Vector &   direction = line.direction;
  unsigned int     steepest = 0;
  for (unsigned int axis = 1; axis < 3; ++axis)
  {
    steepest = std::abs(direction[axis]) > std::abs(direction[steepest]) ? axis : steepest;
  }
  const unsigned int u = (steepest + 1) % 3;
  const unsigned int v = (steepest + 2) % 3;
  const double       steep = std::abs(direction[steepest]);
  const double       slices = line.reach * steep + radius * std::sqrt(std::max(0.0, 1.0 - steep * steep));
  // Extents of the slice of a cylinder.
  const auto extentOf = [&](const unsigned int axis) {
    return line.grid.IsActive(axis) ? radius * std::sqrt(steep * steep + direction[axis] * direction[axis]) / steep
                                    : 0.0;
  };
  const double              extentU = extentOf(u);
  const double              extentV = extentOf(v);
  const double              inverse = 1.0 / (radius * radius);
  const auto                begin = MedialVoxelCeil(place[steepest] - slices);
  const auto                end = MedialVoxelFloor(place[steepest] + slices);
  const std::array<Half, 2> steps{ { MakeSteps(0), MakeSteps(VoxelsOfHalf) } };
  samples.Clear();
  for (std::int64_t w = begin; w <= end; ++w)
  {
    const double toSlice = static_cast<double>(w) - place[steepest];
    const double times = toSlice / direction[steepest];
    const double centerU = place[u] + times * direction[u];
    const double centerV = place[v] + times * direction[v];
    const auto   beginU = MedialVoxelCeil(centerU - extentU);
    const auto   numberU = static_cast<double>(MedialVoxelFloor(centerU + extentU) - beginU + 1);
    const auto   endV = MedialVoxelFloor(centerV + extentV);
    const bool   isInside =
      beginU >= line.box.lower[u] && beginU + static_cast<std::int64_t>(VoxelsOfRow) <= line.box.upper[u];
    for (auto k = MedialVoxelCeil(centerV - extentV); k <= endV; ++k)
    {
      const double        toRow = static_cast<double>(k) - place[v];
      const float * const row = line.values + (line.GetOffset(steepest, w) + line.GetOffset(v, k));
      const double        alongRow = toSlice * direction[steepest] + toRow * direction[v];
      const double        squaredRow = toSlice * toSlice + toRow * toRow;
      Values              values;
      const std::int64_t  first = (beginU - line.box.lower[u]) * line.pitches[u];
      for (std::size_t i = 0; i < VoxelsOfRow; ++i)
      {
        const auto step = static_cast<std::int64_t>(i);
        values[i] = row[isInside ? first + step * line.pitches[u] : line.GetOffset(u, beginU + step)];
      }
      Values alongs;
      Values weights;
      for (std::size_t h = 0; h < steps.size(); ++h)
      {
        const Half toVoxels = (steps[h] + static_cast<double>(beginU)) - place[u];
        const Half along = alongRow + toVoxels * direction[u];
        const Half distance = MedialVoxelSelect(along < 0.0, -along, along);
        Half       weight = 1.0 - ((squaredRow + toVoxels * toVoxels) - along * along) * inverse;
        weight = MedialVoxelSelect(distance <= line.reach, weight, Half{});
        weight = MedialVoxelSelect(steps[h] < numberU, weight, Half{});
        float * const part = values.data() + h * VoxelsOfHalf;
        Store((MedialVoxelConvert<Half>(MedialVoxelLoad<RoundedHalf>(part)) - line.background) * line.scale, part);
        Store(along, alongs.data() + h * VoxelsOfHalf);
        Store(weight, weights.data() + h * VoxelsOfHalf);
      }
      samples.PutRow(alongs, weights, values);
    }
  }
}

} // namespace

double
MedialVoxelGrayLocal::GetEffectiveNumber(const unsigned int numberOfActiveAxes)
{
  // The weight is 1 - r^2 / R^2, over a disc or over the line across.
  return numberOfActiveAxes == 3 ? 0.75 * 3.14159265358979323846 * Radius * Radius : 5.0 / 3.0 * Radius;
}

MedialVoxelGrayLocal::MedialVoxelGrayLocal(const MedialVoxelGrid & grid, const double background, const double material)
  : m_Grid(grid)
  , m_Background(background)
  , m_Scale(1.0 / (material - background))
{}

void
MedialVoxelGrayLocal::Samples::Normalize(const double background, const double material)
{
  for (std::size_t i = 0; i < m_Number; ++i)
  {
    m_Value[i] = static_cast<float>((static_cast<double>(m_Value[i]) - background) / (material - background));
  }
}

void
MedialVoxelGrayLocal::FindSamples(const MedialVoxelGray & gray,
                                  const Vector &          place,
                                  const Vector &          direction,
                                  const double            reach,
                                  Samples &               samples) const
{
  const MedialVoxelBox &            box = gray.GetBox();
  const std::array<std::int64_t, 3> pitches{ { 1, box.Extent(0), box.Extent(0) * box.Extent(1) } };
  MedialVoxelKernel<PutSamples>::Run(
    { gray.GetRow(box.lower[1], box.lower[2]), box, m_Grid, pitches, place, direction, reach, m_Background, m_Scale },
    samples);
}

} // end namespace itk
