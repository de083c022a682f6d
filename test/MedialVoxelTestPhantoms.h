// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestPhantoms_h
#define MedialVoxelTestPhantoms_h

// Small synthetic volumes with known shape; every one is a function of its
// arguments alone.

#include "MedialVoxelTestOracles.h"

#include <functional>
#include <random>
#include <string>

namespace MedialVoxelTest
{
/** A volume whose object voxels are those for which `isObject` holds. */
inline Volume
MakeVolume(const Index3 & size, const Vector3 & spacing, const std::function<bool(const Index3 &)> & isObject)
{
  Volume volume(size, spacing);
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    volume.object[i] = isObject(volume.IndexAt(i)) ? 1 : 0;
  }
  return volume;
}

inline double
Dot(const Vector3 & a, const Vector3 & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Every voxel is object with the given probability; the same sequence on every
 * platform. */
inline Volume
RandomVolume(const Index3 & size, const Vector3 & spacing, double density, unsigned int seed)
{
  std::mt19937 generator(seed);
  const auto   limit = density * 4294967296.0;
  return MakeVolume(size, spacing, [&](const Index3 &) { return generator() < limit; });
}

/** Random boxes of object and of background in turn: walls, corners, cavities
 * and many ties. */
inline Volume
RandomBoxes(const Index3 & size, const Vector3 & spacing, int boxes, unsigned int seed)
{
  std::mt19937 generator(seed);
  Volume       volume(size, spacing);
  for (int i = 0; i < boxes; ++i)
  {
    Index3 low;
    Index3 high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = static_cast<int>(generator() % size[axis]);
      high[axis] = low[axis] + 1 + static_cast<int>(generator() % (size[axis] / 2 + 1));
    }
    for (std::size_t k = 0; k < volume.object.size(); ++k)
    {
      const Index3 v = volume.IndexAt(k);
      if (v[0] >= low[0] && v[1] >= low[1] && v[2] >= low[2] && v[0] < high[0] && v[1] < high[1] && v[2] < high[2])
      {
        volume.object[k] = i % 3 == 2 ? 0 : 1;
      }
    }
  }
  return volume;
}

/** Object everywhere except on the lattice of voxels whose coordinates are all
 * multiples of `step`: many ties. */
inline Volume
LatticeOfHoles(const Index3 & size, const Vector3 & spacing, int step)
{
  return MakeVolume(
    size, spacing, [step](const Index3 & v) { return v[0] % step != 0 || v[1] % step != 0 || v[2] % step != 0; });
}

/** A plate of `thickness` voxels across the whole image, its first layer at
 * `first` along `axis`. */
inline Volume
AxisPlate(const Index3 & size, const Vector3 & spacing, int axis, int first, int thickness)
{
  return MakeVolume(size, spacing, [=](const Index3 & v) { return v[axis] >= first && v[axis] < first + thickness; });
}

/** Voxel centers within thickness / 2 of the plane through `center` with this
 * normal (voxel units). */
inline Volume
TiltedPlate(const Index3 & size, const Vector3 & center, const Vector3 & normal, double thickness)
{
  const double length = std::sqrt(Dot(normal, normal));
  return MakeVolume(size, UnitSpacing, [=](const Index3 & v) {
    const Vector3 r{ { v[0] - center[0], v[1] - center[1], v[2] - center[2] } };
    return std::abs(Dot(r, normal)) / length <= thickness / 2;
  });
}

/** Voxel centers within thickness / 2 of the sphere of this radius (voxel
 * units). */
inline Volume
SphericalShell(const Index3 & size, const Vector3 & center, double radius, double thickness)
{
  return MakeVolume(size, UnitSpacing, [=](const Index3 & v) {
    const Vector3 r{ { v[0] - center[0], v[1] - center[1], v[2] - center[2] } };
    return std::abs(std::sqrt(Dot(r, r)) - radius) <= thickness / 2;
  });
}

/** Voxel centers within the radius: thick solids of one curvature (voxel
 * units). */
inline Volume
Ball(const Index3 & size, const Vector3 & spacing, const Vector3 & center, double radius)
{
  return MakeVolume(size, spacing, [=](const Index3 & v) {
    const Vector3 r{ { v[0] - center[0], v[1] - center[1], v[2] - center[2] } };
    return Dot(r, r) <= radius * radius;
  });
}

/** A T: a flange of `thickness` layers from z = base, and a web of equal
 * thickness above its middle, along y. */
inline Volume
TeeJunction(const Index3 & size, int base, int thickness)
{
  const int web = (size[0] - thickness) / 2;
  return MakeVolume(size, UnitSpacing, [=](const Index3 & v) {
    const bool inFlange = v[2] >= base && v[2] < base + thickness;
    const bool inWeb = v[2] >= base + thickness && v[0] >= web && v[0] < web + thickness;
    return inFlange || inWeb;
  });
}

/** An L: two plates of equal thickness that meet at a right angle, along y. */
inline Volume
EllJunction(const Index3 & size, int base, int thickness)
{
  return MakeVolume(size, UnitSpacing, [=](const Index3 & v) {
    const bool inFloor = v[2] >= base && v[2] < base + thickness && v[0] >= base;
    const bool inWall = v[0] >= base && v[0] < base + thickness && v[2] >= base;
    return inFloor || inWall;
  });
}

/** The mirror image along `axis`. */
inline Volume
Mirrored(const Volume & volume, int axis)
{
  return MakeVolume(volume.size, volume.spacing, [&](const Index3 & v) {
    Index3 m = v;
    m[axis] = volume.size[axis] - 1 - v[axis];
    return volume.IsObject(m);
  });
}

/** The volume whose axis i is axis order[i] of the given one. */
inline Volume
Permuted(const Volume & volume, const Index3 & order)
{
  const Index3  size{ { volume.size[order[0]], volume.size[order[1]], volume.size[order[2]] } };
  const Vector3 spacing{ { volume.spacing[order[0]], volume.spacing[order[1]], volume.spacing[order[2]] } };
  return MakeVolume(size, spacing, [&](const Index3 & v) {
    Index3 source;
    for (int axis = 0; axis < 3; ++axis)
    {
      source[order[axis]] = v[axis];
    }
    return volume.IsObject(source);
  });
}

/** The three volumes whose labels are pinned in Fixtures.sha256. */
inline Volume
Fixture(const std::string & name)
{
  if (name == "plane")
  {
    return RandomBoxes({ { 97, 83, 1 } }, UnitSpacing, 25, 301);
  }
  if (name == "isotropic")
  {
    return RandomBoxes({ { 70, 25, 21 } }, UnitSpacing, 25, 302);
  }
  if (name == "anisotropic")
  {
    return RandomBoxes({ { 33, 31, 27 } }, { { 0.9570312, 0.9570312, 1.5 } }, 25, 303);
  }
  throw std::invalid_argument("unknown fixture '" + name + "', known: plane, isotropic, anisotropic");
}

/** Object and background exchanged. */
inline Volume
Complement(const Volume & volume)
{
  return MakeVolume(volume.size, volume.spacing, [&](const Index3 & v) { return !volume.IsObject(v); });
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestPhantoms_h
