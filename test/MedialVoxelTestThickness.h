// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestThickness_h
#define MedialVoxelTestThickness_h

// The thickness of walls by brute force, on top of MedialVoxelTestClassification.h.

#include "MedialVoxelTestClassification.h"
#include "MedialVoxelTestPhantoms.h"

namespace MedialVoxelTest
{
/** Share of object voxels around a point, the image being continued, less one half. */
inline double
ObjectExcess(const Volume & volume, const Index3 & point)
{
  int object = 0;
  int all = 0;
  for (int z = -1; z <= 1; ++z)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int x = -1; x <= 1; ++x)
      {
        Index3 voxel{ { point[0] + x, point[1] + y, point[2] + z } };
        bool   counts = true;
        for (int axis = 0; axis < 3; ++axis)
        {
          counts = counts && (volume.size[axis] > 1 || voxel[axis] == point[axis]);
          voxel[axis] = std::clamp(voxel[axis], 0, volume.size[axis] - 1);
        }
        object += counts && volume.IsObject(voxel) ? 1 : 0;
        all += counts ? 1 : 0;
      }
    }
  }
  return static_cast<double>(object) / all - 0.5;
}

/** The thickness at a medial cell as its definition says, from the points that brute force finds. */
inline double
ExpectedThickness(const Volume &              volume,
                  const std::vector<Index3> & sites,
                  const std::vector<long> &   nearest,
                  const Index3 &              cell)
{
  const Pair pair = ChoosePair(volume, sites, nearest, cell);
  const auto a = sites[static_cast<std::size_t>(pair.ni)];
  const auto b = sites[static_cast<std::size_t>(pair.nj)];
  Vector3    sum[2] = { {}, {} };
  double     number[2] = { 0.0, 0.0 };
  double     excess[2] = { 0.0, 0.0 };
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
      number[side] += 1.0;
      excess[side] += ObjectExcess(volume, point);
      for (int axis = 0; axis < 3; ++axis)
      {
        sum[side][axis] += point[axis];
      }
    }
  }
  Vector3 way{};
  for (int axis = 0; axis < 3; ++axis)
  {
    way[axis] = (sum[1][axis] / number[1] - sum[0][axis] / number[0]) * volume.spacing[axis];
  }
  const double distance = std::sqrt(Dot(way, way));
  double       steepest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    steepest = std::max(steepest, std::abs(way[axis]) / distance * volume.spacing[axis]);
  }
  return std::max(0.0, distance + 3.0 * steepest * (excess[0] / number[0] + excess[1] / number[1]));
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestThickness_h
