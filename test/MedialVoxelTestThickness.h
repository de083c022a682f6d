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

/** Share of the way from \a from to \a to at which the projection of a point onto it lies. */
inline double
ShareOfWay(const Vector3 & from, const Vector3 & to, const Index3 & point)
{
  Vector3 way{};
  Vector3 place{};
  for (int axis = 0; axis < 3; ++axis)
  {
    way[axis] = to[axis] - from[axis];
    place[axis] = point[axis] - from[axis];
  }
  return Dot(way, place) / Dot(way, way);
}

/** Whether the object voxels around both points lie to the same side, by more than a tangent of 0.4; not where one has
 * object voxels on opposite sides. */
inline bool
LeanTogether(const Volume & volume, const Index3 & first, const Index3 & second)
{
  Vector3 offsets[2] = { {}, {} };
  for (const int side : { 0, 1 })
  {
    const Index3 & point = side == 0 ? first : second;
    const auto     isObject = [&](const int sign, const Index3 & offset) {
      Index3 voxel;
      for (int axis = 0; axis < 3; ++axis)
      {
        voxel[axis] = std::clamp(point[axis] + sign * offset[axis], 0, volume.size[axis] - 1);
      }
      return volume.IsObject(voxel);
    };
    for (int i = 0; i < 27; ++i)
    {
      const Index3 offset{ { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 } };
      bool         counts = true;
      for (int axis = 0; axis < 3; ++axis)
      {
        counts = counts && (volume.size[axis] > 1 || offset[axis] == 0);
      }
      if (counts && isObject(1, offset))
      {
        if (isObject(-1, offset))
        {
          return false;
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          offsets[side][axis] += offset[axis];
        }
      }
    }
  }
  Vector3 together{};
  Vector3 apart{};
  for (int axis = 0; axis < 3; ++axis)
  {
    together[axis] = offsets[0][axis] + offsets[1][axis];
    apart[axis] = offsets[0][axis] - offsets[1][axis];
  }
  return std::sqrt(Dot(together, together)) > 0.4 * std::sqrt(Dot(apart, apart)) + 1e-12;
}

/** The side that each corner of a cell has its point on, 2 for none; \a corners are the boundary points of these. */
inline std::vector<int>
ExpectSides(const Volume & volume, const std::vector<Index3> & corners, const Index3 & a, const Index3 & b)
{
  const auto toVector = [](const Index3 & v) {
    return Vector3{ { static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]) } };
  };
  Vector3 means[2] = { {}, {} };
  double  numbers[2] = { 0.0, 0.0 };
  for (const Index3 & point : corners)
  {
    const double share = ShareOfWay(toVector(a), toVector(b), point);
    if (share <= 0.25 || share >= 0.75)
    {
      const int side = share <= 0.25 ? 0 : 1;
      numbers[side] += 1.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        means[side][axis] += point[axis];
      }
    }
  }
  double squaredLength = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    means[0][axis] /= numbers[0];
    means[1][axis] /= numbers[1];
    squaredLength += std::pow(means[1][axis] - means[0][axis], 2);
  }
  const double     ends = std::clamp(0.5 - 1.5 / std::sqrt(squaredLength), 0.0, 0.15);
  std::vector<int> sides;
  for (const Index3 & point : corners)
  {
    const double fromMiddle = ShareOfWay(means[0], means[1], point) - 0.5;
    sides.push_back(std::abs(fromMiddle) <= ends + 1e-12 ? 2 : (fromMiddle < 0 ? 0 : 1));
  }

  // Of the axes of the cell, the first one along which most corners are on opposite sides.
  const auto pairsAlong = [&](const std::size_t bit) {
    int number = 0;
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      number += sides[k] != 2 && sides[k ^ bit] == 1 - sides[k] ? 1 : 0;
    }
    return number;
  };
  std::size_t through = 1;
  for (const std::size_t bit : { 2, 4 })
  {
    through = bit < corners.size() && pairsAlong(bit) > pairsAlong(through) ? bit : through;
  }
  const auto takeIfBothLeft = [&](const std::vector<int> & fewer) {
    const auto has = [&](const int side) { return std::count(fewer.begin(), fewer.end(), side) > 0; };
    sides = has(0) && has(1) ? fewer : sides;
  };
  std::vector<int> fewer = sides;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    fewer[k] = sides[k ^ through] == 2 ? 2 : sides[k];
  }
  takeIfBothLeft(fewer);
  if (Dot(toVector({ { b[0] - a[0], b[1] - a[1], b[2] - a[2] } }),
          toVector({ { b[0] - a[0], b[1] - a[1], b[2] - a[2] } })) <= 12.0)
  {
    fewer = sides;
    bool isPairLeft = false;
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      if (sides[k] != 2 && sides[k ^ through] == 1 - sides[k])
      {
        const bool leans = LeanTogether(volume, corners[k], corners[k ^ through]);
        fewer[k] = leans ? 2 : fewer[k];
        isPairLeft = isPairLeft || !leans;
      }
    }
    sides = isPairLeft ? fewer : sides;
  }
  return sides;
}

/** What the points of both sides of a wall tell. */
struct ExpectedSides
{
  Vector3 way;        ///< from the mean of the points of one side to that of the other
  double  excess;     ///< of object voxels around the points, mean of each side
  Vector3 inwards[2]; ///< sums over the points of each side
};

inline ExpectedSides
MeasureSides(const Volume & volume, const std::vector<Index3> & corners, const std::vector<int> & sideOf)
{
  std::vector<Index3> points[2];
  Vector3             sum[2] = { {}, {} };
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    if (sideOf[k] != 2)
    {
      points[sideOf[k]].push_back(corners[k]);
      for (int axis = 0; axis < 3; ++axis)
      {
        sum[sideOf[k]][axis] += corners[k][axis];
      }
    }
  }
  ExpectedSides sides{};
  for (int axis = 0; axis < 3; ++axis)
  {
    sides.way[axis] =
      (sum[1][axis] / static_cast<double>(points[1].size()) - sum[0][axis] / static_cast<double>(points[0].size())) *
      volume.spacing[axis];
  }
  for (int side = 0; side < 2; ++side)
  {
    const double sign = side == 0 ? 1.0 : -1.0;
    for (const Index3 & point : points[side])
    {
      const Vector3 across{ { sign * sides.way[0], sign * sides.way[1], sign * sides.way[2] } };
      const auto    around = LookAround(volume, point, across);
      sides.excess += around.excess / static_cast<double>(points[side].size());
      for (int axis = 0; axis < 3; ++axis)
      {
        sides.inwards[side][axis] += around.inwards[axis];
      }
    }
  }
  return sides;
}

/** The wall at a medial cell as its definition says, from the points that brute force finds. */
inline ExpectedWall
ExpectWall(const Volume &              volume,
           const std::vector<Index3> & sites,
           const std::vector<long> &   nearest,
           const Index3 &              cell)
{
  const Pair          pair = ChoosePair(volume, sites, nearest, cell);
  const auto          a = sites[static_cast<std::size_t>(pair.ni)];
  const auto          b = sites[static_cast<std::size_t>(pair.nj)];
  std::vector<Index3> corners;
  std::vector<int>    nearerSideOf;
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
    corners.push_back(point);
    nearerSideOf.push_back(toA == toB ? 2 : (toA < toB ? 0 : 1));
  }
  const ExpectedSides sides = MeasureSides(volume, corners, ExpectSides(volume, corners, a, b));
  const ExpectedSides nearer = MeasureSides(volume, corners, nearerSideOf);
  Vector3             stretched{}; // the normal in voxels
  double              smallest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    stretched[axis] = sides.way[axis] * volume.spacing[axis];
  }
  for (const int axis : volume.Axes())
  {
    smallest = std::min(smallest, volume.spacing[axis] / 64);
  }
  const double distance = std::sqrt(Dot(sides.way, sides.way));
  const double step = std::sqrt(Dot(stretched, stretched)) / SectionOfCube(stretched) / distance;
  const double lengths =
    std::sqrt(Dot(nearer.inwards[0], nearer.inwards[0]) * Dot(nearer.inwards[1], nearer.inwards[1]));
  return { std::max(smallest, distance + 3.0 * step * sides.excess),
           lengths > 0.0 ? -Dot(nearer.inwards[0], nearer.inwards[1]) / lengths : -1.0 };
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestThickness_h
