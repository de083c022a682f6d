// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFeatureTransformPrivate.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

/** Columns are searched in multiples of this number, and at most so many at once. */
constexpr std::int64_t LaneUnit = 8;
constexpr std::int64_t MostLanes = 64;

/** Bytes of intermediate results above which fewer columns are searched at once. */
constexpr std::int64_t SufficientLineMemory = std::int64_t{ 8 } << 20;

/** Bytes of intermediate results of one column. */
std::int64_t
BytesPerLane(const std::int64_t rows, const std::int64_t searchedRows, const std::int64_t searchedSlices)
{
  constexpr auto bytesXY = static_cast<std::int64_t>(sizeof(double) + sizeof(std::int64_t));
  return searchedRows * searchedSlices * static_cast<std::int64_t>(sizeof(std::int32_t)) +
         searchedRows * static_cast<std::int64_t>(sizeof(double)) + rows * searchedSlices * bytesXY;
}

/** Columns to search at once. */
std::int64_t
ChooseLanes(const std::int64_t rows, const std::int64_t searchedRows, const std::int64_t searchedSlices)
{
  const std::int64_t fitting = SufficientLineMemory / BytesPerLane(rows, searchedRows, searchedSlices);
  return std::clamp(fitting / LaneUnit * LaneUnit, LaneUnit, MostLanes);
}

void
FillSquares(const std::int64_t last, const double spacing, std::vector<double> & squares)
{
  squares.resize(static_cast<std::size_t>(last) + 1);
  for (std::int64_t step = 0; step <= last; ++step)
  {
    const double length = static_cast<double>(step) * spacing;
    squares[static_cast<std::size_t>(step)] = length * length;
  }
}

} // namespace

/** A group of columns of the remaining voxels, searched along x, then y, then z. */
struct MedialVoxelFeatureTransform::ColumnGroup
{
  const MedialVoxelGrid & grid;
  Tile &                  tile;
  Workspace::Lines &      lines;

  /** First voxel and number of the columns, and that number rounded up to whole vectors. */
  std::int64_t x;
  std::int64_t columns;
  std::int64_t lanes;

  /** Voxels to search for, and voxels whose sites count. */
  MedialVoxelBox   range;
  MedialVoxelBox   search;
  MedialVoxelIndex margin;

  /** Passes along x and y, one slice after the other, because only the current slice needs its costs along x. */
  void
  SearchSlices() const
  {
    MedialVoxelReserve(lines.nearestX, search.Extent(1) * search.Extent(2) * lanes);
    MedialVoxelReserve(lines.costX, search.Extent(1) * lanes);
    MedialVoxelReserve(lines.costXY, range.Extent(1) * search.Extent(2) * lanes);
    MedialVoxelReserve(lines.positionY, range.Extent(1) * search.Extent(2) * lanes);
    for (std::int64_t slice = 0; slice < search.Extent(2) && !tile.IsAborted(); ++slice)
    {
      MedialVoxelCheckAbort();
      this->SearchAlongX(slice);
      this->SearchAlongY(slice);
    }
  }

  double
  CostX(const std::int32_t displacement) const
  {
    const double length = static_cast<double>(displacement) * grid.GetMetricSpacing()[0];
    return displacement == MedialVoxelNoDisplacement ? MedialVoxelNoCost : length * length;
  }

  void
  SearchAlongX(const std::int64_t slice) const
  {
    for (std::int64_t row = 0; row < search.Extent(1); ++row)
    {
      std::int32_t * const nearest = lines.nearestX.data() + (slice * search.Extent(1) + row) * lanes;
      double * const       cost = lines.costX.data() + row * lanes;
      MedialVoxelNearestInRow(
        *tile.window.sites, x, lanes, search.lower[1] + row, search.lower[2] + slice, margin[0], nearest);
      std::transform(
        nearest, nearest + lanes, cost, [this](const std::int32_t displacement) { return this->CostX(displacement); });
    }
  }

  void
  SearchAlongY(const std::int64_t slice) const
  {
    for (std::int64_t row = 0; row < range.Extent(1); ++row)
    {
      const std::int64_t at = (slice * range.Extent(1) + row) * lanes;
      MedialVoxelSearchOutward(lines.costX.data(),
                               lanes,
                               search.Extent(1),
                               lanes,
                               range.lower[1] + row - search.lower[1],
                               lines.squaresY,
                               lines.costXY.data() + at,
                               lines.positionY.data() + at);
    }
  }

  void
  SearchAlongZ() const
  {
    MedialVoxelReserve(lines.cost, lanes);
    MedialVoxelReserve(lines.positionZ, lanes);
    for (std::int64_t y = range.lower[1]; y < range.upper[1]; ++y)
    {
      MedialVoxelCheckAbort();
      for (std::int64_t z = range.lower[2]; z < range.upper[2] && !tile.IsAborted(); ++z)
      {
        MedialVoxelSearchOutward(lines.costXY.data() + (y - range.lower[1]) * lanes,
                                 range.Extent(1) * lanes,
                                 search.Extent(2),
                                 lanes,
                                 z - search.lower[2],
                                 lines.squaresZ,
                                 lines.cost.data(),
                                 lines.positionZ.data());
        for (std::int64_t lane = 0; lane < columns; ++lane)
        {
          if (tile.IsRemaining(x + lane, y, z))
          {
            this->Store(lane, y, z);
          }
        }
      }
    }
  }

  void
  Store(const std::int64_t lane, const std::int64_t y, const std::int64_t z) const
  {
    const std::size_t offset = tile.features.OffsetOf(x + lane, y, z);
    const double      cost = lines.cost[static_cast<std::size_t>(lane)];
    if (!(cost < MedialVoxelNoCost))
    {
      tile.StoreNone(offset);
      return;
    }
    const std::int64_t bestZ = lines.positionZ[static_cast<std::size_t>(lane)];
    const std::int64_t row = bestZ * range.Extent(1) + y - range.lower[1];
    std::int64_t       bestY = lines.positionY[static_cast<std::size_t>(row * lanes + lane)];
    if (!grid.HasEqualSpacing())
    {
      bestY = this->SmallestEqualY(lane, y - search.lower[1], z - search.lower[2], bestY, bestZ, cost);
    }
    const std::int64_t nearest = (bestZ * search.Extent(1) + bestY) * lanes + lane;
    tile.Store(offset,
               lines.nearestX[static_cast<std::size_t>(nearest)],
               search.lower[1] + bestY - y,
               search.lower[2] + bestZ - z);
    tile.largestSquaredLength = std::max(tile.largestSquaredLength, cost);
  }

  /** Lengths that differ in the plane may round to the same sum, among which the smallest y has to win. */
  std::int64_t
  SmallestEqualY(const std::int64_t lane,
                 const std::int64_t centerY,
                 const std::int64_t centerZ,
                 const std::int64_t bestY,
                 const std::int64_t bestZ,
                 const double       cost) const
  {
    const double squareZ = lines.squaresZ[static_cast<std::size_t>(std::abs(bestZ - centerZ))];
    for (std::int64_t y = std::max<std::int64_t>(0, centerY - margin[1]); y < bestY; ++y)
    {
      const double costX =
        this->CostX(lines.nearestX[static_cast<std::size_t>((bestZ * search.Extent(1) + y) * lanes + lane)]);
      const double squareY = lines.squaresY[static_cast<std::size_t>(std::abs(y - centerY))];
      if ((costX + squareY) + squareZ == cost)
      {
        return y;
      }
    }
    return bestY;
  }
};

void
MedialVoxelFeatureTransform::SearchColumns(Tile & tile, Workspace::Lines & lines) const
{
  const MedialVoxelBox & range = tile.remainingBox;
  const MedialVoxelIndex margin = m_Grid.MarginForMetricLength(tile.reach);
  const MedialVoxelBox   search = range.Expanded(margin).Intersection(tile.known);
  FillSquares(margin[1], m_Grid.GetMetricSpacing()[1], lines.squaresY);
  FillSquares(margin[2], m_Grid.GetMetricSpacing()[2], lines.squaresZ);

  // Groups of nearly equal width, since a group costs the same whether its last lanes are used or not.
  const std::int64_t widest = ChooseLanes(range.Extent(1), search.Extent(1), search.Extent(2));
  const std::int64_t groups = (range.Extent(0) + widest - 1) / widest;
  for (std::int64_t group = 0; group < groups; ++group)
  {
    const std::int64_t x = range.lower[0] + group * range.Extent(0) / groups;
    const std::int64_t columns = range.lower[0] + (group + 1) * range.Extent(0) / groups - x;
    const std::int64_t lanes = (columns + LaneUnit - 1) / LaneUnit * LaneUnit;
    const ColumnGroup  columnGroup{ m_Grid, tile, lines, x, columns, lanes, range, search, margin };
    columnGroup.SearchSlices();
    columnGroup.SearchAlongZ();
  }
}

std::uint64_t
MedialVoxelFeatureTransform::GetBytes(const MedialVoxelGrid &  grid,
                                      const MedialVoxelIndex & tileSize,
                                      const MedialVoxelIndex & searchedSize)
{
  const auto columns = static_cast<std::uint64_t>(ChooseLanes(tileSize[1], searchedSize[1], searchedSize[2]) *
                                                  BytesPerLane(tileSize[1], searchedSize[1], searchedSize[2]));
  const auto slices = GetBytes(tileSize, searchedSize);
  const bool isWithinReach =
    *std::max_element(searchedSize.begin(), searchedSize.end()) <= MedialVoxelSiteKey::LongestReach;
  return !grid.HasEqualSpacing() ? columns : (isWithinReach ? slices : columns + slices);
}

} // end namespace itk
