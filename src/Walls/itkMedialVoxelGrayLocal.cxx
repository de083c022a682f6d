// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayLocal.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Index = MedialVoxelIndex;
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

double
MedialVoxelGrayLocal::GetValue(const MedialVoxelGray & gray, const Index & voxel) const
{
  Index inside = voxel;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    inside[axis] = std::clamp<std::int64_t>(voxel[axis], 0, m_Grid.GetSize()[axis] - 1);
  }
  return (static_cast<double>(gray.Get(inside)) - m_Background) * m_Scale;
}

void
MedialVoxelGrayLocal::FindSamples(const MedialVoxelGray & gray,
                                  const Vector &          place,
                                  const Vector &          direction,
                                  const double            reach,
                                  std::vector<Sample> &   samples) const
{
  samples.clear();
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
  const auto   begin = static_cast<std::int64_t>(std::ceil(place[steepest] - slices));
  const auto   end = static_cast<std::int64_t>(std::floor(place[steepest] + slices));
  Index        voxel{};
  Vector       d{};
  for (voxel[steepest] = begin; voxel[steepest] <= end; ++voxel[steepest])
  {
    d[steepest] = static_cast<double>(voxel[steepest]) - place[steepest];
    const double times = d[steepest] / direction[steepest];
    const double centerU = place[u] + times * direction[u];
    const double centerV = place[v] + times * direction[v];
    const auto   endU = static_cast<std::int64_t>(std::floor(centerU + extentU));
    const auto   endV = static_cast<std::int64_t>(std::floor(centerV + extentV));
    for (voxel[v] = static_cast<std::int64_t>(std::ceil(centerV - extentV)); voxel[v] <= endV; ++voxel[v])
    {
      d[v] = static_cast<double>(voxel[v]) - place[v];
      for (voxel[u] = static_cast<std::int64_t>(std::ceil(centerU - extentU)); voxel[u] <= endU; ++voxel[u])
      {
        d[u] = static_cast<double>(voxel[u]) - place[u];
        const double along = MedialVoxelDot(d, direction);
        const double weight = 1.0 - (MedialVoxelDot(d, d) - along * along) * inverse;
        if (weight > 0.0 && std::abs(along) <= reach)
        {
          samples.push_back({ along, weight, this->GetValue(gray, voxel) });
        }
      }
    }
  }
}

} // end namespace itk
