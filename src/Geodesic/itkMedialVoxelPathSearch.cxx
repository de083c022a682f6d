// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPathSearch.h"

#include <cassert>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

/** Rows of bits of the boundary in a box, with a zero on all sides. A point is the number of its bit. */
struct MedialVoxelPathSearch::Raster
{
  using PointType = std::int32_t;

  Raster(const MedialVoxelBits & boundary, const MedialVoxelBox & rasterBox, std::vector<std::uint64_t> & memory)
    : box(rasterBox)
    , columns(static_cast<std::int32_t>(box.Extent(0) + 2))
    , rows(static_cast<std::int32_t>(box.Extent(1) + 2))
    , words(memory)
  {
    const WordType inBox = MedialVoxelBits::RangeMask(0, 0, box.Extent(0));
    memory.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(box.Extent(2) + 2), 0);
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      std::uint64_t * const slice = memory.data() + (z - box.lower[2] + 1) * rows + 1;
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        slice[y - box.lower[1]] = (boundary.Extract(box.lower[0], y, z) & inBox) << 1;
      }
    }
  }

  std::size_t
  GetNumberOfPoints() const
  {
    return words.size() * static_cast<std::size_t>(columns);
  }

  PointType
  PointOf(const MedialVoxelIndex & index) const
  {
    const auto row = static_cast<std::int32_t>(index[2] - box.lower[2] + 1) * rows +
                     static_cast<std::int32_t>(index[1] - box.lower[1] + 1);
    return row * columns + static_cast<std::int32_t>(index[0] - box.lower[0] + 1);
  }

  /** Call \a visit(neighbor, x, y, z, mask) with the coordinates of each neighbor in the raster, and the axes that
   * change. */
  template <typename TVisit>
  void
  VisitNeighbors(const PointType point, TVisit && visit) const
  {
    const std::int32_t row = point / columns;
    const std::int32_t x = point - row * columns;
    const std::int32_t z = row / rows;
    const std::int32_t y = row - z * rows;
    for (std::int32_t side = 0; side < 9; ++side)
    {
      const std::int32_t dy = side % 3 - 1;
      const std::int32_t dz = side / 3 - 1;
      const std::int32_t neighborRow = row + dz * rows + dy;
      auto               bits = (words[static_cast<std::size_t>(neighborRow)] >> (x - 1)) & (side == 4 ? 5u : 7u);
      for (; bits != 0; bits &= bits - 1)
      {
        const std::int32_t dx = MedialVoxelLowestBit(bits) - 1;
        const unsigned int mask = (dx != 0 ? 1u : 0u) | (dy != 0 ? 2u : 0u) | (dz != 0 ? 4u : 0u);
        visit(neighborRow * columns + x + dx, x + dx, y + dy, z + dz, mask);
      }
    }
  }

  const MedialVoxelBox               box;
  const std::int32_t                 columns;
  const std::int32_t                 rows;
  const std::vector<std::uint64_t> & words;
};

MedialVoxelPathSearch::MedialVoxelPathSearch(const MedialVoxelGrid & grid)
  : m_Grid(grid)
  , m_Cell(grid)
{}

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
  auto &       nodes = workspace.m_Nodes;
  nodes.assign(raster.GetNumberOfPoints(), { std::numeric_limits<double>::infinity(), -1.0 });
  const auto      nodeOf = [&](const PointType point) -> auto & { return nodes[static_cast<std::size_t>(point)]; };
  const PointType start = raster.PointOf(a);
  const PointType target = raster.PointOf(b);
  const MedialVoxelIndex end{ { b[0] - box.lower[0] + 1, b[1] - box.lower[1] + 1, b[2] - box.lower[2] + 1 } };

  auto & queue = workspace.m_Queue;
  queue.Begin(m_Grid);
  nodeOf(start).length = 0.0;
  queue.Push(start, 0.0);
  bool       isFound = false;
  const auto visit = [&](const PointType from, const double lengthHere) {
    raster.VisitNeighbors(from,
                          [&](const PointType to, const auto x, const auto y, const auto z, const unsigned int mask) {
                            const double length = lengthHere + m_Grid.GetEdgeLength(mask);
                            auto &       node = nodeOf(to);
                            if (isFound || length >= node.length)
                            {
                              return;
                            }
                            if (node.rest < 0.0)
                            {
                              node.rest = m_Cell.FreeSpaceLength({ { end[0] - x, end[1] - y, end[2] - z } });
                            }
                            if (length + node.rest > most)
                            {
                              return;
                            }
                            node.length = length;
                            if (to != target)
                            {
                              queue.Push(to, length);
                            }
                            isFound = to == target && length < enough;
                          });
    return !isFound;
  };
  queue.Run([&](const PointType point) { return nodeOf(point).length; }, visit, [](const double) { return false; });
  return nodeOf(target).length;
}

} // end namespace itk
