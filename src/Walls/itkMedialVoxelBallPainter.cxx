// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBallPainter.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelIndex;
using Box = MedialVoxelBox;

constexpr std::int64_t BitsPerWord = 64;

/** A ball takes as long as so many short steps. */
constexpr std::uint32_t StepsOfBall = 64;

std::size_t
ToSize(const std::int64_t number)
{
  return static_cast<std::size_t>(number);
}

} // namespace

/** A tile, and the voxels whose balls may reach it. */
struct MedialVoxelBallPainter::Tile
{
  Box                         box;
  Box                         centers;
  const MedialVoxelBits &     object;
  const MedialVoxelFeatures & features;
  Workspace &                 workspace;
  Box                         padded; // the centers, and one more to each side, whose rank is 0
};

MedialVoxelBallPainter::MedialVoxelBallPainter(const MedialVoxelGrid & grid, const double maximumRadius)
  : m_Grid(grid)
  , m_Ranks(grid, maximumRadius)
{}

void
MedialVoxelBallPainter::Paint(const Box &                 box,
                              const MedialVoxelBits &     object,
                              const MedialVoxelFeatures & features,
                              Workspace &                 workspace,
                              std::vector<float> &        diameters) const
{
  workspace.m_Open.Open(box, object, diameters);
  const Tile tile{ box,       this->GetCenterBox(box),
                   object,    features,
                   workspace, this->GetCenterBox(box).Expanded({ { 1, 1, 1 } }) };
  this->RankBalls(tile);
  this->SortBalls(tile);
  this->PaintBalls(tile);
}

void
MedialVoxelBallPainter::RankBalls(const Tile & tile) const
{
  std::vector<std::uint32_t> & ranks = tile.workspace.m_Ranks;
  ranks.assign(ToSize(tile.padded.NumberOfVoxels()), 0);
  for (std::int64_t z = tile.centers.lower[2]; z < tile.centers.upper[2]; ++z)
  {
    for (std::int64_t y = tile.centers.lower[1]; y < tile.centers.upper[1]; ++y)
    {
      const std::size_t     first = tile.features.OffsetOf(tile.centers.lower[0], y, z);
      std::uint32_t * const row = ranks.data() + tile.padded.OffsetOf({ { tile.centers.lower[0], y, z } });
      for (std::int64_t x = tile.centers.lower[0]; x < tile.centers.upper[0]; x += BitsPerWord)
      {
        std::uint64_t bits = tile.object.Extract(x, y, z) & MedialVoxelBits::RangeMask(0, 0, tile.centers.upper[0] - x);
        for (; bits != 0; bits &= bits - 1)
        {
          const auto column = ToSize(x - tile.centers.lower[0] + MedialVoxelLowestBit(bits));
          row[column] = m_Ranks.GetRank(tile.features, first + column);
        }
      }
    }
    MedialVoxelCheckAbort();
  }
}

auto
MedialVoxelBallPainter::ListNeighbors(const Box & padded) const -> std::vector<Neighbor>
{
  std::vector<Neighbor> neighbors;
  for (int z = -1; z <= 1; ++z)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int x = -1; x <= 1; ++x)
      {
        const auto axes = static_cast<unsigned int>((x & 1) | (y & 1) << 1 | (z & 1) << 2);
        if (axes != 0)
        {
          neighbors.push_back({ axes, (z * padded.Extent(1) + y) * padded.Extent(0) + x });
        }
      }
    }
  }
  // Most balls are in the ball of a neighbor that shares a face.
  std::stable_sort(neighbors.begin(), neighbors.end(), [](const Neighbor & a, const Neighbor & b) {
    return MedialVoxelPopulationCount(a.axes) < MedialVoxelPopulationCount(b.axes);
  });
  return neighbors;
}

/** Whether all voxels of a ball are in that of a neighbor. */
bool
MedialVoxelBallPainter::IsInBallOfNeighbor(const std::uint32_t * const   ball,
                                           const std::vector<Neighbor> & neighbors) const
{
  return std::any_of(neighbors.begin(), neighbors.end(), [&](const Neighbor & neighbor) {
    const std::uint32_t other = ball[neighbor.step];
    return other > *ball && m_Ranks.IsInBall(*ball, neighbor.axes, other);
  });
}

/** Whether the neighbors of a ball of the largest radius cover it except for its center. */
bool
MedialVoxelBallPainter::IsAmongLargest(const std::uint32_t * const ball, const std::vector<Neighbor> & neighbors) const
{
  return std::all_of(neighbors.begin(), neighbors.end(), [&](const Neighbor & neighbor) {
    const bool isOnAxis = neighbor.axes == 1 || neighbor.axes == 2 || neighbor.axes == 4;
    return !isOnAxis || !m_Grid.IsActive(neighbor.axes >> 1) || ball[neighbor.step] == *ball;
  });
}

/** The balls that reach the tile and are not in the ball of a neighbor, the largest first. */
void
MedialVoxelBallPainter::SortBalls(const Tile & tile) const
{
  const std::vector<std::uint32_t> & ranks = tile.workspace.m_Ranks;
  const std::vector<Neighbor>        neighbors = this->ListNeighbors(tile.padded);
  std::vector<std::uint32_t> &       kept = tile.workspace.m_Kept;
  const auto                         cap = m_Ranks.GetLast();
  const float                        diameter = 2.0f * m_Ranks.GetRadius(cap);
  const auto                         toTile = [&tile](const std::int64_t at, const unsigned int axis) {
    return std::max<std::int64_t>({ tile.box.lower[axis] - at, at - tile.box.upper[axis] + 1, 0 });
  };
  kept.clear();
  Index center;
  for (center[2] = tile.centers.lower[2]; center[2] < tile.centers.upper[2]; ++center[2])
  {
    for (center[1] = tile.centers.lower[1]; center[1] < tile.centers.upper[1]; ++center[1])
    {
      const std::int64_t y = toTile(center[1], 1);
      const std::int64_t z = toTile(center[2], 2);
      center[0] = tile.centers.lower[0];
      std::size_t place = tile.padded.OffsetOf(center);
      for (; center[0] < tile.centers.upper[0]; ++center[0], ++place)
      {
        const std::uint32_t rank = ranks[place];
        if (rank == 0 || !(m_Grid.SquaredMetricLength(toTile(center[0], 0), y, z) < m_Ranks.GetSquare(rank)))
        {
          continue;
        }
        if (rank == cap && this->IsAmongLargest(&ranks[place], neighbors))
        {
          if (tile.box.Contains(center))
          {
            tile.workspace.m_Open.CloseRange(center[1], center[2], { center[0], center[0] + 1 }, diameter);
          }
        }
        else if (!this->IsInBallOfNeighbor(&ranks[place], neighbors))
        {
          kept.push_back(static_cast<std::uint32_t>(place));
        }
      }
    }
    MedialVoxelCheckAbort();
  }
  this->OrderByRank(tile.workspace);
}

/** The kept balls, the largest first. */
void
MedialVoxelBallPainter::OrderByRank(Workspace & workspace) const
{
  std::vector<std::uint32_t> & begins = workspace.m_Begins;
  const std::uint32_t          last = m_Ranks.GetLast();
  begins.assign(last + 2, 0);
  for (const std::uint32_t ball : workspace.m_Kept)
  {
    ++begins[last + 1 - workspace.m_Ranks[ball]];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  workspace.m_Order.resize(workspace.m_Kept.size());
  for (const std::uint32_t ball : workspace.m_Kept)
  {
    workspace.m_Order[begins[last - workspace.m_Ranks[ball]]++] = ball;
  }
}

void
MedialVoxelBallPainter::PaintBalls(const Tile & tile) const
{
  Workspace &             workspace = tile.workspace;
  MedialVoxelAbortChecker checker;
  const std::int64_t      columns = tile.padded.Extent(0);
  const std::int64_t      rows = tile.padded.Extent(1);
  std::uint32_t           spansOf = 0;
  for (const std::uint32_t ball : workspace.m_Order)
  {
    const std::uint32_t rank = workspace.m_Ranks[ball];
    if (rank != spansOf)
    {
      if (workspace.m_Open.IsDone())
      {
        return;
      }
      this->FindSpans(rank, workspace);
      spansOf = rank;
    }
    checker.Count(StepsOfBall);
    this->PaintBall(tile,
                    { { tile.padded.lower[0] + ball % columns,
                        tile.padded.lower[1] + ball / columns % rows,
                        tile.padded.lower[2] + ball / (columns * rows) } },
                    2.0f * m_Ranks.GetRadius(rank));
  }
}

/** For rows by their absolute distances from the center: voxels to each side that are covered, or -1. */
void
MedialVoxelBallPainter::FindSpans(const std::uint32_t rank, Workspace & workspace) const
{
  const double  square = m_Ranks.GetSquare(rank);
  const Index & margin = this->GetMargin();
  Index &       reach = workspace.m_Reach;
  reach = { { 0, 0, 0 } };
  workspace.m_Spans.assign(ToSize((margin[1] + 1) * (margin[2] + 1)), -1);
  std::int32_t * row = workspace.m_Spans.data();
  for (std::int64_t z = 0; z <= margin[2]; ++z, row += margin[1] + 1)
  {
    std::int64_t width = margin[0];
    for (std::int64_t y = 0; y <= margin[1] && width >= 0; ++y)
    {
      while (width >= 0 && !(m_Grid.SquaredMetricLength(width, y, z) < square))
      {
        --width;
      }
      row[y] = static_cast<std::int32_t>(width);
      if (width >= 0)
      {
        reach = { { std::max(reach[0], width), std::max(reach[1], y), z } };
      }
    }
  }
}

void
MedialVoxelBallPainter::PaintBall(const Tile & tile, const Index & center, const float diameter) const
{
  Workspace & workspace = tile.workspace;
  const Box   ball = Box{ center, { { center[0] + 1, center[1] + 1, center[2] + 1 } } }.Expanded(workspace.m_Reach);
  workspace.m_Open.CloseBall(ball, diameter, [&](const std::int64_t y, const std::int64_t z) {
    const std::int32_t * const row = workspace.m_Spans.data() + std::abs(z - center[2]) * (this->GetMargin()[1] + 1);
    const std::int64_t         width = row[std::abs(y - center[1])];
    return MedialVoxelOpenVoxels::RowRange{ center[0] - width, width < 0 ? center[0] : center[0] + width + 1 };
  });
}

} // end namespace itk
