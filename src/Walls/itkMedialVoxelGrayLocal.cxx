// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayLocal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;

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
  samples.Clear();
  unsigned int steepest = 0;
  for (unsigned int axis = 1; axis < 3; ++axis)
  {
    steepest = std::abs(direction[axis]) > std::abs(direction[steepest]) ? axis : steepest;
  }
  const unsigned int u = (steepest + 1) % 3;
  const unsigned int v = (steepest + 2) % 3;
  const double       steep = std::abs(direction[steepest]);
  const double       slices = reach * steep + Radius * std::sqrt(std::max(0.0, 1.0 - steep * steep));
  // Extents of the slice of a cylinder.
  const auto extentOf = [&](const unsigned int axis) {
    return m_Grid.IsActive(axis) ? Radius * std::sqrt(steep * steep + direction[axis] * direction[axis]) / steep : 0.0;
  };
  const double extentU = extentOf(u);
  const double extentV = extentOf(v);
  const double inverse = 1.0 / (Radius * Radius);
  const auto   begin = MedialVoxelCeil(place[steepest] - slices);
  const auto   end = MedialVoxelFloor(place[steepest] + slices);
  const MedialVoxelBox &            box = gray.GetBox();
  const float * const               values = gray.GetRow(box.lower[1], box.lower[2]);
  const std::array<std::int64_t, 3> pitches{ { 1, box.Extent(0), box.Extent(0) * box.Extent(1) } };
  // The offset of a voxel along an axis, which beyond a face of the image is that of the outermost voxel.
  const auto offsetOf = [&](const unsigned int axis, const std::int64_t voxel) {
    return (std::clamp<std::int64_t>(voxel, 0, m_Grid.GetSize()[axis] - 1) - box.lower[axis]) * pitches[axis];
  };
  Vector d{};
  for (std::int64_t w = begin; w <= end; ++w)
  {
    d[steepest] = static_cast<double>(w) - place[steepest];
    const double times = d[steepest] / direction[steepest];
    const double centerU = place[u] + times * direction[u];
    const double centerV = place[v] + times * direction[v];
    const auto   beginU = MedialVoxelCeil(centerU - extentU);
    const auto   endU = MedialVoxelFloor(centerU + extentU);
    const auto   endV = MedialVoxelFloor(centerV + extentV);
    for (auto k = MedialVoxelCeil(centerV - extentV); k <= endV; ++k)
    {
      d[v] = static_cast<double>(k) - place[v];
      const float * const row = values + (offsetOf(steepest, w) + offsetOf(v, k));
      const double        alongRow = d[steepest] * direction[steepest] + d[v] * direction[v];
      const double        squaredRow = d[steepest] * d[steepest] + d[v] * d[v];
      samples.Reserve(static_cast<std::size_t>(std::max<std::int64_t>(0, endU - beginU + 1)) + 1);
      const bool isInside = beginU >= 0 && endU < m_Grid.GetSize()[u];
      for (std::int64_t i = beginU; i <= endU; ++i)
      {
        const std::int64_t offset = isInside ? (i - box.lower[u]) * pitches[u] : offsetOf(u, i);
        d[u] = static_cast<double>(i) - place[u];
        const double along = alongRow + d[u] * direction[u];
        const double weight = 1.0 - ((squaredRow + d[u] * d[u]) - along * along) * inverse;
        const double value = (static_cast<double>(row[offset]) - m_Background) * m_Scale;
        samples.Put(along, weight, value, weight > 0.0 && std::abs(along) <= reach);
      }
    }
  }
}

} // end namespace itk
