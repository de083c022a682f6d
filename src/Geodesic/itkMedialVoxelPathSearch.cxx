// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPathSearch.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

/** The one that leads from a point to itself. */
constexpr unsigned int NoDirection = 13;

/** Buckets of this share of the shortest edge keep most points from being visited twice. */
constexpr double BucketsToEdge = 0.5;

/** Steps along an axis in a direction. */
constexpr int
StepOf(const unsigned int direction, const unsigned int axis)
{
  const unsigned int along = axis == 0 ? direction : (axis == 1 ? direction / 3 : direction / 9);
  return static_cast<int>(along % 3) - 1;
}

/** The smallest number of bits that holds the numbers below \a count. */
unsigned int
BitsFor(const std::int64_t count)
{
  unsigned int bits = 0;
  while ((std::int64_t{ 1 } << bits) < count)
  {
    ++bits;
  }
  return bits;
}

} // namespace

/** Rows of bits of the boundary in a box, with a zero on all sides. A point is the number of its bit, and rows and
 * slices are powers of two apart. */
struct MedialVoxelPathSearch::Raster
{
  using PointType = std::int32_t;

  Raster(const MedialVoxelBits & boundary, const MedialVoxelBox & rasterBox, std::vector<std::uint64_t> & memory)
    : box(rasterBox)
    , columnBits(BitsFor(box.Extent(0) + 2))
    , rowBits(BitsFor(box.Extent(1) + 2))
    , words(memory)
  {
    const WordType inBox = MedialVoxelBits::RangeMask(0, 0, box.Extent(0));
    memory.assign(static_cast<std::size_t>(box.Extent(2) + 2) << rowBits, 0);
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      std::uint64_t * const slice = memory.data() + ((z - box.lower[2] + 1) << rowBits) + 1;
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        slice[y - box.lower[1]] = (boundary.Extract(box.lower[0], y, z) & inBox) << 1;
      }
    }
  }

  std::size_t
  GetNumberOfPoints() const
  {
    return words.size() << columnBits;
  }

  PointType
  PointOf(const MedialVoxelIndex & index) const
  {
    const std::int64_t row = ((index[2] - box.lower[2] + 1) << rowBits) + (index[1] - box.lower[1] + 1);
    return static_cast<PointType>((row << columnBits) + (index[0] - box.lower[0] + 1));
  }

  /** Coordinates in the raster. */
  std::array<std::int32_t, 3>
  CoordinatesOf(const PointType point) const
  {
    const std::int32_t row = point >> columnBits;
    return { { point & ((1 << columnBits) - 1), row & ((1 << rowBits) - 1), row >> rowBits } };
  }

  /** Directions in which a point has neighbors, as bits. */
  std::uint32_t
  NeighborsOf(const PointType point) const
  {
    const std::int32_t    x = point & ((1 << columnBits) - 1);
    const std::uint64_t * rows = words.data() + (point >> columnBits) - (1 << rowBits) - 1;
    std::uint32_t         neighbors = 0;
    for (unsigned int slice = 0; slice < 3; ++slice)
    {
      for (unsigned int row = 0; row < 3; ++row)
      {
        neighbors |= static_cast<std::uint32_t>((rows[row] >> (x - 1)) & 7u) << (9 * slice + 3 * row);
      }
      rows += std::ptrdiff_t{ 1 } << rowBits;
    }
    return neighbors & ~(std::uint32_t{ 1 } << NoDirection);
  }

  /** Offset from a point to its neighbor, for each direction. */
  std::array<PointType, NumberOfDirections>
  GetSteps() const
  {
    std::array<PointType, NumberOfDirections> steps{};
    for (unsigned int direction = 0; direction < NumberOfDirections; ++direction)
    {
      const int rows = StepOf(direction, 2) * (1 << rowBits) + StepOf(direction, 1);
      steps[direction] = rows * (1 << columnBits) + StepOf(direction, 0);
    }
    return steps;
  }

  const MedialVoxelBox               box;
  const unsigned int                 columnBits;
  const unsigned int                 rowBits;
  const std::vector<std::uint64_t> & words;
};

MedialVoxelPathSearch::MedialVoxelPathSearch(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{
  for (unsigned int mask = 0; mask < m_EdgeLengths.size(); ++mask)
  {
    m_EdgeLengths[mask] = grid.GetEdgeLength(mask);
  }
  for (unsigned int direction = 0; direction < m_LengthsOfDirections.size(); ++direction)
  {
    unsigned int mask = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      mask |= StepOf(direction, axis) != 0 ? 1u << axis : 0u;
    }
    m_LengthsOfDirections[direction] = m_EdgeLengths[mask];
  }
}

/** The free-space length, of MedialVoxelDualCell, but for rounding. */
double
MedialVoxelPathSearch::FreeSpaceLength(const std::array<std::int32_t, 3> & a,
                                       const std::array<std::int32_t, 3> & b) const
{
  // Steps above the bit of their axis.
  std::int32_t       first = (std::abs(a[0] - b[0]) << 3) | 1;
  std::int32_t       second = (std::abs(a[1] - b[1]) << 3) | 2;
  std::int32_t       third = (std::abs(a[2] - b[2]) << 3) | 4;
  const std::int32_t larger = std::max(first, second);
  const std::int32_t smaller = std::min(first, second);
  first = std::max(larger, third);
  const std::int32_t rest = std::min(larger, third);
  second = std::max(smaller, rest);
  third = std::min(smaller, rest);
  const auto longest = static_cast<std::size_t>(first & 7);
  const auto both = static_cast<std::size_t>((first | second) & 7 & ~(third & 7));
  return ((first >> 3) - (second >> 3)) * m_EdgeLengths[longest] +
         ((second >> 3) - (third >> 3)) * m_EdgeLengths[both] + (third >> 3) * m_EdgeLengths[7];
}

double
MedialVoxelPathSearch::FindLength(const MedialVoxelBits &  boundary,
                                  const MedialVoxelBox &   box,
                                  const MedialVoxelIndex & a,
                                  const MedialVoxelIndex & b,
                                  const double             enough,
                                  const double             most,
                                  Workspace &              workspace) const
{
  assert(boundary.GetBox().Contains(box) && box.Contains(a) && box.Contains(b));
  assert(box.Extent(0) <= LongestRow);
  using PointType = Raster::PointType;
  const Raster raster(boundary, box, workspace.m_Rows);
  const auto   number = workspace.BeginSearch(raster.GetNumberOfPoints());
  const auto   nodeOf = [&](const PointType point) -> auto & {
    return workspace.m_Nodes[static_cast<std::size_t>(point)];
  };
  const PointType start = raster.PointOf(a);
  const PointType target = raster.PointOf(b);
  const auto      end = raster.CoordinatesOf(target);

  auto &       queue = workspace.m_Queue;
  const double straight = this->FreeSpaceLength(raster.CoordinatesOf(start), end);
  queue.Begin(straight, BucketsToEdge * m_Grid.GetShortestEdge());
  nodeOf(start) = { 0.0, straight, number };
  queue.Push({ start, 0.0 }, straight);
  double                  found = std::numeric_limits<double>::infinity();
  double                  limit = most;
  MedialVoxelAbortChecker checker;
  const auto              steps = raster.GetSteps();
  const auto              visit = [&](const PointType from, const double lengthHere) {
    // One loop over all directions: processors predict its end better than the ends of nine short ones.
    for (std::uint32_t rest = raster.NeighborsOf(from); rest != 0; rest &= rest - 1)
    {
      const auto      direction = static_cast<std::size_t>(MedialVoxelLowestBit(rest));
      const PointType to = from + steps[direction];
      const double    length = lengthHere + m_LengthsOfDirections[direction];
      auto &          node = nodeOf(to);
      if (node.search != number)
      {
        node = { std::numeric_limits<double>::infinity(),
                 this->FreeSpaceLength(raster.CoordinatesOf(to), end),
                 number };
      }
      if (length >= node.length || length + node.rest > limit)
      {
        continue;
      }
      node.length = length;
      if (to == target)
      {
        found = limit = length;
      }
      else
      {
        queue.Push({ to, length }, length + node.rest);
      }
    }
  };
  while (found >= enough)
  {
    checker.Count();
    const auto entry = queue.Pop();
    if (!entry)
    {
      break;
    }
    const auto & node = nodeOf(entry->point);
    if (entry->length <= node.length && entry->length + node.rest <= limit)
    {
      visit(entry->point, entry->length);
    }
  }
  return found;
}

} // end namespace itk
