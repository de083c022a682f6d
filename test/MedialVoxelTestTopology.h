// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MedialVoxelTestTopology_h
#define MedialVoxelTestTopology_h

// Betti numbers and thinning of small volumes, from the definitions alone: every loop runs over the whole volume.

#include "itkMedialVoxelCellLink.h"
#include "itkMedialVoxelGrid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace MedialVoxelTest
{

/** A value for each voxel or cell of a box that begins at 0; 0 outside. */
class Values
{
public:
  explicit Values(const itk::MedialVoxelIndex & size, const int value = 0)
    : m_Box{ { { 0, 0, 0 } }, size }
    , m_Values(static_cast<std::size_t>(m_Box.NumberOfVoxels()), value)
  {}

  const itk::MedialVoxelBox &
  GetBox() const
  {
    return m_Box;
  }

  int
  Get(const std::int64_t x, const std::int64_t y, const std::int64_t z) const
  {
    const itk::MedialVoxelIndex index{ { x, y, z } };
    return m_Box.Contains(index) ? m_Values[m_Box.OffsetOf(index)] : 0;
  }

  int
  Get(const itk::MedialVoxelIndex & index) const
  {
    return this->Get(index[0], index[1], index[2]);
  }

  void
  Set(const itk::MedialVoxelIndex & index, const int value)
  {
    m_Values[m_Box.OffsetOf(index)] = value;
  }

  friend bool
  operator==(const Values & a, const Values & b)
  {
    return a.m_Values == b.m_Values;
  }

private:
  itk::MedialVoxelBox m_Box;
  std::vector<int>    m_Values;
};

/** Call function(index) for all of a box, x fastest. */
template <typename TFunction>
void
ForEachIndex(const itk::MedialVoxelBox & box, const TFunction & function)
{
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x)
      {
        function(itk::MedialVoxelIndex{ { x, y, z } });
      }
    }
  }
}

/** Mark all that steps of \a isIn reach from \a seed. */
inline void
FloodFaces(const itk::MedialVoxelIndex &                              seed,
           const std::function<bool(const itk::MedialVoxelIndex &)> & isIn,
           Values &                                                   marks,
           std::vector<itk::MedialVoxelIndex> &                       found)
{
  found.assign(1, seed);
  marks.Set(seed, 1);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (int step = -1; step <= 1; step += 2)
      {
        itk::MedialVoxelIndex next = found[i];
        next[axis] += step;
        if (marks.GetBox().Contains(next) && marks.Get(next) == 0 && isIn(next))
        {
          marks.Set(next, 1);
          found.push_back(next);
        }
      }
    }
  }
}

/** Parts that steps join, but for those that reach the faces of the box when \a onlyInner. */
inline int
CountFaceComponents(const itk::MedialVoxelIndex &                              size,
                    const std::function<bool(const itk::MedialVoxelIndex &)> & isIn,
                    const bool                                                 onlyInner)
{
  Values                             marks(size);
  std::vector<itk::MedialVoxelIndex> found;
  int                                number = 0;
  ForEachIndex(marks.GetBox(), [&](const itk::MedialVoxelIndex & seed) {
    if (marks.Get(seed) == 0 && isIn(seed))
    {
      FloodFaces(seed, isIn, marks, found);
      bool isInner = true;
      for (const auto & index : found)
      {
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          isInner = isInner && index[axis] > 0 && index[axis] < size[axis] - 1;
        }
      }
      number += isInner || !onlyInner ? 1 : 0;
    }
  });
  return number;
}

/** Whether a face of the complex of all voxels is in the complex of a set of cells. Cells have even places from 2 on,
 * edges one odd place, squares two, cubes three. */
class CellComplex
{
public:
  CellComplex(const Values & object, const Values & cells)
    : m_Object(object)
    , m_Cells(cells)
  {}

  itk::MedialVoxelIndex
  GetSize() const
  {
    itk::MedialVoxelIndex size = m_Object.GetBox().upper;
    for (std::int64_t & length : size)
    {
      length = 2 * length + 3;
    }
    return size;
  }

  bool
  Has(const itk::MedialVoxelIndex & place) const
  {
    // A cell at index i is at 2 i + 2, a voxel at 2 i + 1.
    itk::MedialVoxelBox corners;
    itk::MedialVoxelBox voxels;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const bool isOdd = place[axis] % 2 != 0;
      corners.lower[axis] = (place[axis] - (isOdd ? 1 : 0)) / 2 - 1;
      corners.upper[axis] = corners.lower[axis] + (isOdd ? 2 : 1);
      voxels.lower[axis] = (place[axis] - (isOdd ? 1 : 2)) / 2;
      voxels.upper[axis] = voxels.lower[axis] + (isOdd ? 1 : 2);
    }
    bool hasCorners = true;
    bool hasVoxel = false;
    ForEachIndex(corners,
                 [&](const itk::MedialVoxelIndex & cell) { hasCorners = hasCorners && m_Cells.Get(cell) != 0; });
    ForEachIndex(voxels, [&](const itk::MedialVoxelIndex & voxel) { hasVoxel = hasVoxel || m_Object.Get(voxel) != 0; });
    return hasCorners && hasVoxel;
  }

private:
  const Values & m_Object;
  const Values & m_Cells;
};

/** Parts, tunnels and cavities of the complex of a set of cells. */
inline std::array<int, 3>
FindBettiNumbers(const Values & object, const Values & cells)
{
  const CellComplex complex(object, cells);
  const auto        size = complex.GetSize();
  Values            faces(size);
  int               euler = 0;
  ForEachIndex(faces.GetBox(), [&](const itk::MedialVoxelIndex & place) {
    if (complex.Has(place))
    {
      faces.Set(place, 1);
      euler += (place[0] + place[1] + place[2]) % 2 == 0 ? 1 : -1;
    }
  });
  const int parts = CountFaceComponents(size, [&](const auto & place) { return faces.Get(place) != 0; }, false);
  const int cavities = CountFaceComponents(size, [&](const auto & place) { return faces.Get(place) == 0; }, true);
  return { { parts, parts + cavities - euler, cavities } };
}

/** The same numbers of the union of the voxels as closed cubes. */
inline std::array<int, 3>
FindBettiNumbersOfVoxels(const Values & object)
{
  const auto size = object.GetBox().upper;
  Values     faces(itk::MedialVoxelIndex{ { 2 * size[0] + 3, 2 * size[1] + 3, 2 * size[2] + 3 } });
  ForEachIndex(object.GetBox(), [&](const itk::MedialVoxelIndex & voxel) {
    if (object.Get(voxel) != 0)
    {
      const itk::MedialVoxelIndex place{ { 2 * voxel[0] + 2, 2 * voxel[1] + 2, 2 * voxel[2] + 2 } };
      ForEachIndex(
        itk::MedialVoxelBox{ place, { { place[0] + 1, place[1] + 1, place[2] + 1 } } }.Expanded({ { 1, 1, 1 } }),
        [&](const auto & face) { faces.Set(face, 1); });
    }
  });
  int euler = 0;
  ForEachIndex(faces.GetBox(), [&](const auto & place) {
    euler += faces.Get(place) == 0 ? 0 : (place[0] + place[1] + place[2]) % 2 == 0 ? -1 : 1;
  });
  const auto & all = faces.GetBox().upper;
  const int    parts = CountFaceComponents(all, [&](const auto & place) { return faces.Get(place) != 0; }, false);
  const int    cavities = CountFaceComponents(all, [&](const auto & place) { return faces.Get(place) == 0; }, true);
  return { { parts, parts + cavities - euler, cavities } };
}

inline itk::MedialVoxelGrid
GridOf(const itk::MedialVoxelIndex & size)
{
  return { size, { { 1.0, 1.0, 1.0 } } };
}

/** An object with medial cells and levels that need not fit it: topology does not depend on them. */
struct Scene
{
  explicit Scene(const itk::MedialVoxelIndex & size)
    : object(size)
    , medial(size)
    , levels(size)
  {}

  Values object;
  Values medial;
  Values levels;
};

inline std::uint32_t
CellsAround(const Values & cells, const itk::MedialVoxelIndex & cell)
{
  std::uint32_t around = 0;
  int           bit = 0;
  ForEachIndex(itk::MedialVoxelBox{ cell, { { cell[0] + 1, cell[1] + 1, cell[2] + 1 } } }.Expanded({ { 1, 1, 1 } }),
               [&](const auto & other) { around |= cells.Get(other) != 0 ? 1u << bit++ : 0u * bit++; });
  return around;
}

inline std::uint32_t
VoxelsAround(const Values & object, const itk::MedialVoxelIndex & cell)
{
  std::uint32_t around = 0;
  int           bit = 0;
  ForEachIndex(itk::MedialVoxelBox{ cell, { { cell[0] + 2, cell[1] + 2, cell[2] + 2 } } },
               [&](const auto & corner) { around |= object.Get(corner) != 0 ? 1u << bit++ : 0u * bit++; });
  return around;
}

/** The passes in loops over the whole volume, in the order of the definition. */
inline Values
ThinInLoops(const Scene & scene)
{
  const auto & size = scene.object.GetBox().upper;
  const auto   cells = GridOf(size).GetCellBox();
  Values       kept(size);
  ForEachIndex(cells, [&](const auto & cell) { kept.Set(cell, VoxelsAround(scene.object, cell) != 0 ? 1 : 0); });
  constexpr int gray[8] = { 0, 1, 3, 2, 6, 7, 5, 4 };
  for (int t = 0; t < 24; ++t)
  {
    for (const int code : gray)
    {
      int parity = code;
      for (int turn = 0; turn < t % 3; ++turn)
      {
        parity = (2 * parity) % 8 + parity / 4;
      }
      ForEachIndex(cells, [&](const auto & cell) {
        const int  level = scene.levels.Get(cell);
        const bool isAsked = cell[0] % 2 == (parity & 1) && cell[1] % 2 == ((parity >> 1) & 1) &&
                             cell[2] % 2 == (parity >> 2) && level <= t && level >= t - 7;
        if (isAsked && kept.Get(cell) != 0 && scene.medial.Get(cell) == 0 &&
            itk::MedialVoxelCellLink::IsSimple(CellsAround(kept, cell), VoxelsAround(scene.object, cell)))
        {
          kept.Set(cell, 0);
        }
      });
    }
  }
  return kept;
}

/** The voxels after components of at most \a maximumSize that do not reach a face are filled. */
inline Values
FillInLoops(const Values & object, const std::size_t maximumSize)
{
  const auto &                       size = object.GetBox().upper;
  Values                             filled = object;
  Values                             marks(size);
  std::vector<itk::MedialVoxelIndex> found;
  ForEachIndex(object.GetBox(), [&](const auto & seed) {
    if (object.Get(seed) != 0 || marks.Get(seed) != 0)
    {
      return;
    }
    FloodFaces(seed, [&](const auto & v) { return object.Get(v) == 0; }, marks, found);
    const bool isInner = std::all_of(found.begin(), found.end(), [&](const auto & v) {
      bool inner = true;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        inner = inner && (size[axis] == 1 || (v[axis] > 0 && v[axis] < size[axis] - 1));
      }
      return inner;
    });
    for (const auto & v : found)
    {
      filled.Set(v, isInner && found.size() <= maximumSize ? 1 : 0);
    }
  });
  return filled;
}

} // namespace MedialVoxelTest

#endif
