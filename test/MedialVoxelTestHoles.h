// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestHoles_h
#define MedialVoxelTestHoles_h

// What noise really does to the walls of a part: holes through them, and pits into them.

#include "MedialVoxelTestWalls.h"

#include <set>

namespace MedialVoxelTest
{
/** Whether background joins, inside a ball, what is apart around the part itself: the two sides of a wall. */
inline bool
IsPierced(const Part & part, const Volume & volume, const Vector3 & place, double radius)
{
  const int     reach = static_cast<int>(std::ceil(radius));
  const Vector3 center = CenterOf(part);
  Index3        first;
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = static_cast<int>(std::lround(place[axis] + center[axis])) - reach;
  }
  const int side = 2 * reach + 1;
  Volume    around({ { side, side, side } }, UnitSpacing);
  Volume    background = around;
  for (std::size_t i = 0; i < around.object.size(); ++i)
  {
    const Index3  step = around.IndexAt(i);
    const Index3  v{ { first[0] + step[0], first[1] + step[1], first[2] + step[2] } };
    const Vector3 p = PositionIn(part, { { double(v[0]), double(v[1]), double(v[2]) } });
    const Vector3 way{ { p[0] - place[0], p[1] - place[1], p[2] - place[2] } };
    const bool    isInBall = Dot(way, way) <= radius * radius && volume.Contains(v);
    around.object[i] = isInBall && part.surface(p) >= 0.0 ? 1 : 0;
    background.object[i] = isInBall && !volume.IsObject(v) ? 1 : 0;
  }
  std::vector<int>           sideOf(around.object.size(), 0);
  std::vector<unsigned char> seen(around.object.size(), 0);
  for (std::size_t i = 0, number = 1; i < sideOf.size(); ++i)
  {
    if (around.object[i] && !seen[i])
    {
      for (const std::size_t voxel : ComponentOf(around, i, seen).voxels)
      {
        sideOf[voxel] = static_cast<int>(number);
      }
      ++number;
    }
  }
  std::fill(seen.begin(), seen.end(), 0);
  for (std::size_t i = 0; i < sideOf.size(); ++i)
  {
    if (background.object[i] && !seen[i])
    {
      std::set<int> sides;
      for (const std::size_t voxel : ComponentOf(background, i, seen).voxels)
      {
        sides.insert(sideOf[voxel]);
      }
      sides.erase(0);
      if (sides.size() > 1)
      {
        return true;
      }
    }
  }
  return false;
}

/** The volume with object wherever the part is deeper than one and a half voxels. */
inline Volume
WithoutPits(const Part & part, Volume volume)
{
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    const Index3 v = volume.IndexAt(i);
    if (part.surface(PositionIn(part, { { double(v[0]), double(v[1]), double(v[2]) } })) < -1.5)
    {
      volume.object[i] = 1;
    }
  }
  return volume;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestHoles_h
