// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestThickness_h
#define MedialVoxelTestThickness_h

// The thickness of walls by brute force, on top of MedialVoxelTestClassification.h.

#include "MedialVoxelTestClassification.h"
#include "MedialVoxelTestPhantoms.h"

namespace MedialVoxelTest
{
/** What the voxels around a boundary point tell of the surface there. */
struct SurfaceAround
{
  double  excess;  ///< share of object voxels, less one half
  Vector3 inwards; ///< along the normal of the surface: sum of the offsets to them in voxels, over the spacing
};

/** Of the voxels of a wall in the direction of \a across, the image being continued. Voxels behind the point that have
 * an object voxel opposite are of another wall. */
inline SurfaceAround
LookAround(const Volume & volume, const Index3 & point, const Vector3 & across)
{
  Vector3 normal{}; // in voxels
  for (int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = across[axis] * volume.spacing[axis];
  }
  const auto isObject = [&](const Index3 & offset) {
    Index3 voxel;
    for (int axis = 0; axis < 3; ++axis)
    {
      voxel[axis] = std::clamp(point[axis] + offset[axis], 0, volume.size[axis] - 1);
    }
    return volume.IsObject(voxel);
  };
  SurfaceAround around{ 0.0, {} };
  int           object = 0;
  int           all = 0;
  for (int i = 0; i < 27; ++i)
  {
    const Index3 offset{ { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 } };
    bool         counts = true;
    double       depth = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      counts = counts && (volume.size[axis] > 1 || offset[axis] == 0);
      depth += normal[axis] * offset[axis] / std::sqrt(Dot(normal, normal));
    }
    all += counts ? 1 : 0;
    const bool isOther = depth < -0.25 && isObject({ { -offset[0], -offset[1], -offset[2] } });
    if (counts && isObject(offset) && !isOther)
    {
      ++object;
      for (int axis = 0; axis < 3; ++axis)
      {
        around.inwards[axis] += offset[axis] / volume.spacing[axis];
      }
    }
  }
  around.excess = static_cast<double>(object) / all - 0.5;
  return around;
}

/** Area of the section through the center of a unit cube across a direction, from its projections: a rhombus or a
 * hexagon. */
inline double
SectionOfCube(const Vector3 & direction)
{
  Vector3 n = direction;
  std::transform(n.begin(), n.end(), n.begin(), [](double x) { return std::abs(x); });
  std::sort(n.begin(), n.end());
  const double length = std::sqrt(Dot(n, n));
  const double cut = std::max(0.0, n[0] + n[1] - n[2]);
  const double corners = cut > 0.0 ? cut * cut / (4 * n[0] * n[1]) : 0.0; // of the projection along the last axis
  return (1.0 - corners) * length / n[2];
}

struct ExpectedWall
{
  double thickness;
  double cosine; ///< of the angle between the surfaces: 1 when they face each other
};

/** The wall at a medial cell as its definition says, from the points that brute force finds. */
inline ExpectedWall
ExpectWall(const Volume &              volume,
           const std::vector<Index3> & sites,
           const std::vector<long> &   nearest,
           const Index3 &              cell)
{
  const Pair pair = ChoosePair(volume, sites, nearest, cell);
  const auto a = sites[static_cast<std::size_t>(pair.ni)];
  const auto b = sites[static_cast<std::size_t>(pair.nj)];

  std::vector<Index3> points[2];
  Vector3             sum[2] = { {}, {} };
  for (int k = 0; k < 1 << volume.Axes().size(); ++k)
  {
    const Index3 point = sites[static_cast<std::size_t>(nearest[volume.Offset(CellCorner(volume, cell, k))])];
    double       toA = 0.0;
    double       toB = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      toA += std::pow(point[axis] - a[axis], 2);
      toB += std::pow(point[axis] - b[axis], 2);
    }
    if (toA != toB)
    {
      const int side = toA < toB ? 0 : 1;
      points[side].push_back(point);
      for (int axis = 0; axis < 3; ++axis)
      {
        sum[side][axis] += point[axis];
      }
    }
  }
  Vector3 way{};
  Vector3 stretched{}; // the normal in voxels
  for (int axis = 0; axis < 3; ++axis)
  {
    way[axis] =
      (sum[1][axis] / static_cast<double>(points[1].size()) - sum[0][axis] / static_cast<double>(points[0].size())) *
      volume.spacing[axis];
    stretched[axis] = way[axis] * volume.spacing[axis];
  }
  const double distance = std::sqrt(Dot(way, way));
  double       excess = 0.0;
  Vector3      inwards[2] = { {}, {} };
  for (int side = 0; side < 2; ++side)
  {
    const double sign = side == 0 ? 1.0 : -1.0;
    for (const Index3 & point : points[side])
    {
      const auto around = LookAround(volume, point, { { sign * way[0], sign * way[1], sign * way[2] } });
      excess += around.excess / static_cast<double>(points[side].size());
      for (int axis = 0; axis < 3; ++axis)
      {
        inwards[side][axis] += around.inwards[axis];
      }
    }
  }
  const double step = std::sqrt(Dot(stretched, stretched)) / SectionOfCube(stretched) / distance;
  const double lengths = std::sqrt(Dot(inwards[0], inwards[0])) * std::sqrt(Dot(inwards[1], inwards[1]));
  double       smallest = std::numeric_limits<double>::infinity();
  for (const int axis : volume.Axes())
  {
    smallest = std::min(smallest, volume.spacing[axis] / 64);
  }
  return { std::max(smallest, distance + 3.0 * step * excess),
           lengths > 0.0 ? -Dot(inwards[0], inwards[1]) / lengths : -1.0 };
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestThickness_h
