// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestSurfaceObjects_h
#define MedialVoxelTestSurfaceObjects_h

// Objects whose mid-surface is known, and where their sheets may end or meet.

#include "MedialVoxelTestSurface.h"
#include "MedialVoxelTestWalls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace MedialVoxelTest
{
inline bool
Nowhere(const Vector3 &)
{
  return false;
}

inline bool
Everywhere(const Vector3 &)
{
  return true;
}

/** The axes of a plate that is turned about all axes of the image. */
struct Frame
{
  Vector3                center;
  std::array<Vector3, 3> axes{
    { { { 0.6544, -0.5868, 0.4769 } }, { { 0.7469, 0.6255, -0.2255 } }, { { -0.1660, 0.5038, 0.8477 } } }
  };

  Vector3
  ToLocal(const Vector3 & point) const
  {
    const Vector3 r{ { point[0] - center[0], point[1] - center[1], point[2] - center[2] } };
    return { { Dot(axes[0], r), Dot(axes[1], r), Dot(axes[2], r) } };
  }

  Vector3
  ToLocal(const Index3 & voxel) const
  {
    return this->ToLocal(Vector3{ { double(voxel[0]), double(voxel[1]), double(voxel[2]) } });
  }
};

inline constexpr double HalfWidth = 22.0;
inline constexpr double HalfThickness = 2.0;
inline constexpr Frame  TurnedFrame{ { { 32.6, 32.8, 32.3 } } };
inline constexpr Index3 TurnedSize{ { 66, 66, 66 } };

/** A square plate 4 voxels thick. */
inline Volume
TurnedPlate()
{
  return MakeVolume(TurnedSize, UnitSpacing, [](const Index3 & v) {
    const Vector3 p = TurnedFrame.ToLocal(v);
    return std::max(std::abs(p[0]), std::abs(p[1])) <= HalfWidth && std::abs(p[2]) <= HalfThickness;
  });
}

/** The sheet begins half a thickness from the sides of the plate; within three voxels of that it may end. */
inline bool
IsRimOfPlate(const Vector3 & point)
{
  const Vector3 p = TurnedFrame.ToLocal(point);
  return std::max(std::abs(p[0]), std::abs(p[1])) > HalfWidth - HalfThickness - 3.0;
}

inline double
DistanceToPlate(const Vector3 & point)
{
  return std::abs(TurnedFrame.ToLocal(point)[2]);
}

/** A rib on a plate. */
inline Volume
TurnedTee(double halfPlate, double halfRib)
{
  return MakeVolume(TurnedSize, UnitSpacing, [=](const Index3 & v) {
    const Vector3 p = TurnedFrame.ToLocal(v);
    const bool    inPlate = std::abs(p[0]) <= HalfWidth && std::abs(p[2] + 8.0) <= halfPlate;
    const bool    inRib = std::abs(p[0]) <= halfRib && p[2] >= -8.0 && p[2] <= 18.0;
    return std::abs(p[1]) <= HalfWidth && (inPlate || inRib);
  });
}

inline double
DistanceToTeeAxis(const Vector3 & point)
{
  const Vector3 p = TurnedFrame.ToLocal(point);
  return std::hypot(p[0], p[2] + 8.0);
}

inline bool
IsJunctionOfTee(const Vector3 & point)
{
  return DistanceToTeeAxis(point) < 3.0;
}

inline bool
IsRimOfTee(const Vector3 & point)
{
  const Vector3 p = TurnedFrame.ToLocal(point);
  return std::max(std::abs(p[0]), std::abs(p[1])) > HalfWidth - HalfThickness - 3.0 ||
         p[2] > 18.0 - HalfThickness - 3.0;
}

inline double
DistanceToTee(const Vector3 & point)
{
  const Vector3 p = TurnedFrame.ToLocal(point);
  const double  toPlate = std::abs(p[2] + 8.0);
  return p[2] > -8.0 ? std::min(toPlate, std::abs(p[0])) : toPlate;
}

inline constexpr Vector3 ShellCenter{ { 29.4, 29.7, 29.5 } };

inline double
DistanceToShell(const Vector3 & point)
{
  const Vector3 r{ { point[0] - ShellCenter[0], point[1] - ShellCenter[1], point[2] - ShellCenter[2] } };
  return std::abs(std::sqrt(Dot(r, r)) - 24.0);
}

/** The gyroid function for a period of 64 voxels. */
inline double
Gyroid(const Vector3 & p)
{
  constexpr double k = 2.0 * 3.14159265358979323846 / 64.0;
  return std::sin(k * p[0]) * std::cos(k * p[1]) + std::sin(k * p[1]) * std::cos(k * p[2]) +
         std::sin(k * p[2]) * std::cos(k * p[0]);
}

inline double
DistanceToGyroid(const Vector3 & p)
{
  constexpr double step = 1e-4;
  Vector3          gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    Vector3 lower = p;
    Vector3 upper = p;
    lower[axis] -= step;
    upper[axis] += step;
    gradient[axis] = (Gyroid(upper) - Gyroid(lower)) / (2.0 * step);
  }
  return std::abs(Gyroid(p)) / std::sqrt(Dot(gradient, gradient));
}

/** A tenth of the voxels next to the surface changes sides. */
inline Volume
Flipped(Volume volume, unsigned int seed)
{
  std::mt19937 generator(seed);
  FlipSurface(volume, [&generator]() { return generator() / 4294967296.0; });
  return volume;
}

inline constexpr int GyroidSize = 84;

inline Volume
GyroidWall()
{
  return MakeVolume({ { GyroidSize, GyroidSize, GyroidSize } }, UnitSpacing, [](const Index3 & v) {
    return std::abs(Gyroid({ { double(v[0]), double(v[1]), double(v[2]) } })) < 0.4;
  });
}

inline bool
IsAtFaceOfGyroid(const Vector3 & point)
{
  return std::any_of(point.begin(), point.end(), [](double c) { return c < 3.0 || c > GyroidSize - 4.0; });
}

inline Volume
Shell()
{
  return SphericalShell({ { 60, 60, 60 } }, ShellCenter, 24.0, 4.0);
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestSurfaceObjects_h
