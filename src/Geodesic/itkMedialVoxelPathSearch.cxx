// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPathSearch.h"

#include "itkMedialVoxelProgress.h"

namespace itk
{

using WordType = MedialVoxelBits::WordType;

MedialVoxelPathSearch::MedialVoxelPathSearch(const MedialVoxelGrid & grid)
  : m_Grid(grid)
  , m_Cell(grid)
  // A little narrower than the shortest edge, so that rounding does not leave both ends of an edge in one bucket.
  , m_BucketsPerLength(1.0 / (grid.GetShortestEdge() * (1.0 - 1e-9)))
  , m_NumberOfBuckets(static_cast<std::size_t>(grid.GetLongestEdge() * m_BucketsPerLength) + 2)
{}

MedialVoxelPathSearch::Raster
MedialVoxelPathSearch::Rasterize(const MedialVoxelBits &      boundary,
                                 const MedialVoxelBox &       box,
                                 std::vector<std::uint64_t> & words)
{
  const Raster   raster{ static_cast<std::int32_t>(box.Extent(0) + 2),
                       static_cast<std::int32_t>(box.Extent(1) + 2),
                       static_cast<std::int32_t>(box.Extent(2) + 2) };
  const WordType inBox = MedialVoxelBits::RangeMask(0, 0, box.Extent(0));
  words.assign(static_cast<std::size_t>(raster.rows) * static_cast<std::size_t>(raster.slices), 0);
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    std::uint64_t * const slice = words.data() + (z - box.lower[2] + 1) * raster.rows + 1;
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      slice[y - box.lower[1]] = (boundary.Extract(box.lower[0], y, z) & inBox) << 1;
    }
  }
  return raster;
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
  const auto & words = workspace.m_Rows;
  const Raster raster = Rasterize(boundary, box, workspace.m_Rows);
  auto &       nodes = workspace.m_Nodes;
  nodes.assign(words.size() * static_cast<std::size_t>(raster.columns),
               { std::numeric_limits<double>::infinity(), -1.0 });
  const auto nodeOf = [&](const MedialVoxelIndex & index) {
    const auto row = static_cast<std::int32_t>(index[2] - box.lower[2] + 1) * raster.rows +
                     static_cast<std::int32_t>(index[1] - box.lower[1] + 1);
    return row * raster.columns + static_cast<std::int32_t>(index[0] - box.lower[0] + 1);
  };
  const std::int32_t     target = nodeOf(b);
  const MedialVoxelIndex end{ { b[0] - box.lower[0] + 1, b[1] - box.lower[1] + 1, b[2] - box.lower[2] + 1 } };

  auto & buckets = workspace.m_Buckets;
  buckets.resize(m_NumberOfBuckets);
  for (auto & bucket : buckets)
  {
    bucket.clear();
  }
  const auto bucketOf = [&](const double length) { return static_cast<std::size_t>(length * m_BucketsPerLength); };
  nodes[static_cast<std::size_t>(nodeOf(a))].length = 0.0;
  buckets[0].push_back(nodeOf(a));
  MedialVoxelPollCounter poll;
  std::size_t            waiting = 1;
  for (std::size_t front = 0; waiting > 0; ++front)
  {
    auto & bucket = buckets[front % m_NumberOfBuckets];
    for (const std::int32_t from : bucket)
    {
      poll.Count();
      const double lengthHere = nodes[static_cast<std::size_t>(from)].length;
      if (bucketOf(lengthHere) != front)
      {
        continue;
      }
      const std::int32_t row = from / raster.columns;
      const std::int32_t x = from - row * raster.columns;
      const std::int32_t z = row / raster.rows;
      const std::int32_t y = row - z * raster.rows;
      for (std::int32_t side = 0; side < 9; ++side)
      {
        const std::int32_t dy = side % 3 - 1;
        const std::int32_t dz = side / 3 - 1;
        const std::int32_t neighborRow = row + dz * raster.rows + dy;
        auto               bits = (words[static_cast<std::size_t>(neighborRow)] >> (x - 1)) & (side == 4 ? 5u : 7u);
        for (; bits != 0; bits &= bits - 1)
        {
          const std::int32_t dx = MedialVoxelLowestBit(bits) - 1;
          const unsigned int mask = (dx != 0 ? 1u : 0u) | (dy != 0 ? 2u : 0u) | (dz != 0 ? 4u : 0u);
          const double       length = lengthHere + m_Grid.GetEdgeLength(mask);
          const std::int32_t next = neighborRow * raster.columns + x + dx;
          auto &             node = nodes[static_cast<std::size_t>(next)];
          if (length >= node.length)
          {
            continue;
          }
          if (node.rest < 0.0)
          {
            node.rest = m_Cell.FreeSpaceLength({ { end[0] - x - dx, end[1] - y - dy, end[2] - z - dz } });
          }
          if (length + node.rest > most)
          {
            continue;
          }
          node.length = length;
          if (next != target)
          {
            buckets[bucketOf(length) % m_NumberOfBuckets].push_back(next);
            ++waiting;
          }
          else if (length < enough)
          {
            return length;
          }
        }
      }
    }
    waiting -= bucket.size();
    bucket.clear();
  }
  return nodes[static_cast<std::size_t>(target)].length;
}

} // end namespace itk
