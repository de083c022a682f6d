// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestPores_h
#define MedialVoxelTestPores_h

// Pores and dust by brute force: components of the whole volume.

#include "MedialVoxelTestPhantoms.h"

#include <random>

namespace MedialVoxelTest
{
/** The component of a voxel: neighbors are all voxels around it. */
struct Component
{
  std::vector<std::size_t> voxels;
  bool                     touchesFace;
};

inline Component
ComponentOf(const Volume & volume, std::size_t first, std::vector<unsigned char> & seen)
{
  Component component{ { first }, false };
  seen[first] = 1;
  for (std::size_t k = 0; k < component.voxels.size(); ++k)
  {
    const Index3 v = volume.IndexAt(component.voxels[k]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool isFirstOrLast = v[axis] == 0 || v[axis] == volume.size[axis] - 1;
      component.touchesFace = component.touchesFace || (volume.size[axis] > 1 && isFirstOrLast);
    }
    for (int move = 0; move < 27; ++move)
    {
      const Index3 n{ { v[0] + move % 3 - 1, v[1] + move / 3 % 3 - 1, v[2] + move / 9 - 1 } };
      if (volume.Contains(n) && !seen[volume.Offset(n)] && volume.IsObject(n) == volume.IsObject(v))
      {
        seen[volume.Offset(n)] = 1;
        component.voxels.push_back(volume.Offset(n));
      }
    }
  }
  return component;
}

/** Background components of at most so many voxels become object, then object components of at most so many become
 * background, but for those that touch a face of the volume. A volume of one voxel stays. */
inline Volume
WithoutPores(const Volume & volume, std::size_t most)
{
  Volume result = volume;
  for (const unsigned char kind : { 0, 1 })
  {
    const Volume               before = result;
    std::vector<unsigned char> seen(before.object.size(), before.object.size() == 1 ? 1 : 0);
    for (std::size_t i = 0; i < before.object.size(); ++i)
    {
      if (seen[i] || before.object[i] != kind)
      {
        continue;
      }
      const Component component = ComponentOf(before, i, seen);
      if (component.voxels.size() <= most && !component.touchesFace)
      {
        for (const std::size_t voxel : component.voxels)
        {
          result.object[voxel] = 1 - kind;
        }
      }
    }
  }
  return result;
}

/** Voxels that are object in one volume and not in another. */
inline std::size_t
VoxelsOnlyIn(const Volume & volume, const Volume & other)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    count += volume.object[i] && !other.object[i] ? 1 : 0;
  }
  return count;
}

/** Boxes with crooked lines of about `length` voxels in both kinds, and with grains inside pores. */
inline Volume
VolumeWithPores(const Index3 & size, const Vector3 & spacing, int length, unsigned int seed)
{
  std::mt19937 generator(seed);
  const auto   below = [&generator](int limit) { return static_cast<int>(generator() % static_cast<unsigned>(limit)); };
  Volume       volume = RandomBoxes(size, spacing, 8, seed + 1);
  const auto   voxels = static_cast<int>(volume.object.size());
  for (int line = 0; line < 2 + voxels / (8 * length); ++line)
  {
    Index3     v = volume.IndexAt(static_cast<std::size_t>(below(voxels)));
    const bool kind = volume.IsObject(v);
    const int  steps = 1 + below(length + 2);
    for (int step = 0; step < steps; ++step)
    {
      volume.Set(v, !kind);
      for (int axis = 0; axis < 3; ++axis)
      {
        v[axis] = std::min(std::max(v[axis] + below(3) - 1, 0), volume.size[axis] - 1);
      }
    }
  }
  for (int nest = 0; nest < 2 + voxels / 400; ++nest)
  {
    const Index3 center = volume.IndexAt(static_cast<std::size_t>(below(voxels)));
    const bool   kind = volume.IsObject(center);
    for (int move = 0; move < 125; ++move)
    {
      const Index3 way{ { move % 5 - 2, move / 5 % 5 - 2, move / 25 - 2 } };
      const Index3 n{ { center[0] + way[0], center[1] + way[1], center[2] + way[2] } };
      const int    ring = std::max(std::abs(way[0]), std::max(std::abs(way[1]), std::abs(way[2])));
      if (volume.Contains(n))
      {
        volume.Set(n, (ring == 1) != kind);
      }
    }
  }
  return volume;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestPores_h
