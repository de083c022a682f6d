// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFeatureTransform.h"

#include <algorithm>
#include <cmath>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

/** Radius of the ball of sorted displacements, in voxels: large enough for the walls of thin parts. */
constexpr double NearbyRadius = 6.0;

/** Edge of the blocks whose centers bound the distances of their voxels. */
constexpr std::int64_t BoundBlockSize = 16;

/** Columns are searched in multiples of this number. */
constexpr std::int64_t LaneUnit = 8;

/** Relative slack that keeps rounded lengths on the safe side. */
constexpr double Slack = 1e-9;

double
MeanMetricSpacing(const MedialVoxelGrid & grid)
{
  double product = 1.0;
  int    active = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (grid.IsActive(axis))
    {
      product *= grid.GetMetricSpacing()[axis];
      ++active;
    }
  }
  return active == 0 ? 1.0 : std::pow(product, 1.0 / active);
}

/** Squared metric distance from a box to the nearest voxel outside \a known that the image has. */
double
SquaredDistanceToUnknown(const MedialVoxelGrid & grid, const MedialVoxelBox & known, const MedialVoxelBox & box)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double spacing = grid.GetMetricSpacing()[axis];
    if (known.lower[axis] > 0)
    {
      shortest = std::min(shortest, static_cast<double>(box.lower[axis] - known.lower[axis] + 1) * spacing);
    }
    if (known.upper[axis] < grid.GetSize()[axis])
    {
      shortest = std::min(shortest, static_cast<double>(known.upper[axis] - box.upper[axis] + 1) * spacing);
    }
  }
  return shortest * shortest;
}

} // namespace

void
MedialVoxelFeatures::Reset(const MedialVoxelBox & newBox)
{
  box = newBox;
  const auto size = static_cast<std::size_t>(newBox.NumberOfVoxels());
  dx.assign(size, 0);
  dy.assign(size, 0);
  dz.assign(size, 0);
}

struct MedialVoxelFeatureTransform::Tile
{
  const MedialVoxelWindow &         window;
  MedialVoxelFeatures &             features;
  std::vector<WordType> &           remaining;
  std::vector<std::int32_t> &       nearestX;
  MedialVoxelBox                    known;
  const MedialVoxelProgress * const progress;
  double                            squaredDistanceToUnknown{ 0.0 };

  /** Words of a row that hold voxels of the tile. */
  std::int64_t firstWord{ 0 };
  std::int64_t words{ 0 };

  /** Voxels that the nearby search left, and the metric length within which their sites lie. */
  MedialVoxelBox remainingBox{};
  double         reach{ 0.0 };

  double         largestSquaredLength{ 0.0 };
  MedialVoxelBox missing{};

  bool
  IsAborted() const
  {
    return progress != nullptr && progress->IsAborted();
  }

  const MedialVoxelBox &
  Box() const
  {
    return features.box;
  }

  WordType &
  Remaining(const std::int64_t word, const std::int64_t y, const std::int64_t z) const
  {
    const MedialVoxelBox & box = features.box;
    const std::int64_t     row = (z - box.lower[2]) * box.Extent(1) + (y - box.lower[1]);
    return remaining[static_cast<std::size_t>(row * words + word - firstWord)];
  }

  bool
  IsRemaining(const std::int64_t x, const std::int64_t y, const std::int64_t z) const
  {
    return ((this->Remaining(x >> 6, y, z) >> (x & 63)) & 1u) != 0;
  }

  bool
  AnyRemaining(const MedialVoxelBox & block) const
  {
    for (std::int64_t z = block.lower[2]; z < block.upper[2]; ++z)
    {
      for (std::int64_t y = block.lower[1]; y < block.upper[1]; ++y)
      {
        for (std::int64_t word = block.lower[0] >> 6; word <= (block.upper[0] - 1) >> 6; ++word)
        {
          if (this->Remaining(word, y, z) & MedialVoxelBits::RangeMask(word, block.lower[0], block.upper[0]))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  void
  Store(const std::size_t offset, const std::int64_t dx, const std::int64_t dy, const std::int64_t dz) const
  {
    features.dx[offset] = static_cast<std::int32_t>(dx);
    features.dy[offset] = static_cast<std::int32_t>(dy);
    features.dz[offset] = static_cast<std::int32_t>(dz);
  }

  void
  StoreNone(const std::size_t offset) const
  {
    this->Store(offset, MedialVoxelNoDisplacement, MedialVoxelNoDisplacement, MedialVoxelNoDisplacement);
  }
};

MedialVoxelFeatureTransform::MedialVoxelFeatureTransform(const MedialVoxelGrid & grid,
                                                         const MedialVoxelRegion region,
                                                         const double            maximumDistance)
  : m_Grid(grid)
  , m_Region(region)
  , m_MaximumDistance(maximumDistance)
  , m_Offsets(MedialVoxelSortedOffsets(grid, NearbyRadius * MeanMetricSpacing(grid)))
{}

MedialVoxelBox
MedialVoxelFeatureTransform::Compute(const MedialVoxelWindow &         window,
                                     const MedialVoxelBox &            tileBox,
                                     Workspace &                       workspace,
                                     MedialVoxelFeatures &             features,
                                     const MedialVoxelProgress * const progress) const
{
  features.Reset(tileBox);
  const MedialVoxelBox & known = window.sites->GetBox();
  Tile                   tile{ window, features, workspace.m_Remaining, workspace.m_NearestX, known, progress };
  tile.squaredDistanceToUnknown = SquaredDistanceToUnknown(m_Grid, known, tileBox);
  tile.firstWord = tileBox.lower[0] >> 6;
  tile.words = ((tileBox.upper[0] - 1) >> 6) - tile.firstWord + 1;

  this->SearchNearby(tile);
  if (!tile.remainingBox.IsEmpty())
  {
    if (!this->BoundRemaining(tile))
    {
      return tile.missing;
    }
    // Sums of three squares must stay below the value that stands for "no site".
    const bool fitsInteger = m_Grid.HasEqualSpacing() && tile.reach < 15000.0;
    if (fitsInteger)
    {
      this->SearchRemaining(tile, workspace.m_IntegerLines);
    }
    else
    {
      this->SearchRemaining(tile, workspace.m_RealLines);
    }
  }
  this->DropDistant(tile);
  return this->MissingBox(tile);
}

void
MedialVoxelFeatureTransform::SearchNearby(Tile & tile) const
{
  const MedialVoxelBox & box = tile.Box();
  const WordType         flip = (m_Region == MedialVoxelRegion::Outside) ? ~WordType{ 0 } : WordType{ 0 };
  const WordType         all = (m_Region == MedialVoxelRegion::Both) ? ~WordType{ 0 } : WordType{ 0 };
  tile.remaining.assign(static_cast<std::size_t>(tile.words * box.Extent(1) * box.Extent(2)), 0);

  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const WordType * const object = tile.window.object->GetRow(y, z) - tile.window.object->GetFirstWord();
      for (std::int64_t word = tile.firstWord; word < tile.firstWord + tile.words; ++word)
      {
        const WordType query =
          ((object[word] ^ flip) | all) & MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
        if (query == 0)
        {
          continue;
        }
        const std::int64_t x = word * MedialVoxelBits::BitsPerWord;
        const auto         firstLane =
          static_cast<std::int64_t>(tile.features.OffsetOf(box.lower[0], y, z)) + (x - box.lower[0]);
        const auto result = MedialVoxelSearchOffsets(
          m_Offsets,
          *tile.window.sites,
          x,
          y,
          z,
          query,
          { tile.features.dx.data(), tile.features.dy.data(), tile.features.dz.data(), firstLane });
        tile.largestSquaredLength = std::max(tile.largestSquaredLength, result.largestSquaredLength);
        if (result.remaining != 0)
        {
          tile.Remaining(word, y, z) = result.remaining;
          const std::int64_t first = x + MedialVoxelLowestBit(result.remaining);
          const std::int64_t last = x + MedialVoxelHighestBit(result.remaining);
          tile.remainingBox = tile.remainingBox.Union({ { { first, y, z } }, { { last + 1, y + 1, z + 1 } } });
        }
      }
    }
  }
}

bool
MedialVoxelFeatureTransform::BoundRemaining(Tile & tile) const
{
  const double           maximumLength = m_MaximumDistance / m_Grid.GetMetricUnit() * (1.0 + Slack);
  const MedialVoxelBox & range = tile.remainingBox;
  MedialVoxelBox         block;
  for (block.lower[2] = range.lower[2]; block.lower[2] < range.upper[2]; block.lower[2] += BoundBlockSize)
  {
    for (block.lower[1] = range.lower[1]; block.lower[1] < range.upper[1]; block.lower[1] += BoundBlockSize)
    {
      for (block.lower[0] = range.lower[0]; block.lower[0] < range.upper[0]; block.lower[0] += BoundBlockSize)
      {
        MedialVoxelIndex center;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          block.upper[axis] = std::min(block.lower[axis] + BoundBlockSize, range.upper[axis]);
          center[axis] = (block.lower[axis] + block.upper[axis]) / 2;
        }
        if (!tile.AnyRemaining(block))
        {
          continue;
        }
        // The center lies at or above the middle, so that the lowest corner is the farthest one.
        const double toCorner = std::sqrt(m_Grid.SquaredMetricLength(
          center[0] - block.lower[0], center[1] - block.lower[1], center[2] - block.lower[2]));
        const double squared =
          MedialVoxelSquaredDistanceToSites(m_Grid, *tile.window.sites, center, maximumLength + toCorner);
        const bool hasSite = squared < std::numeric_limits<double>::infinity();
        if (hasSite)
        {
          tile.reach = std::max(tile.reach, (std::sqrt(squared) + toCorner) * (1.0 + Slack));
        }
        else if (std::isfinite(maximumLength))
        {
          tile.reach = maximumLength;
        }
        else if (std::isfinite(tile.squaredDistanceToUnknown))
        {
          // Nothing bounds the distance, so look twice as far as the window does.
          const double known = std::sqrt(tile.squaredDistanceToUnknown);
          const double least = 2.0 * static_cast<double>(BoundBlockSize) * MeanMetricSpacing(m_Grid);
          tile.missing = tile.Box().Expanded(m_Grid.MarginForMetricLength(std::max(2.0 * known, least)));
          tile.missing = tile.missing.Intersection(m_Grid.GetVoxelBox()).Union(tile.known);
          return false;
        }
      }
    }
  }
  tile.reach = std::min(tile.reach, maximumLength);

  const MedialVoxelBox needed =
    tile.Box().Expanded(m_Grid.MarginForMetricLength(tile.reach)).Intersection(m_Grid.GetVoxelBox());
  if (!tile.known.Contains(needed))
  {
    tile.missing = needed;
    return false;
  }
  return true;
}

namespace
{

template <typename TCost>
void
FillSquares(const std::int64_t last, const double spacing, std::vector<TCost> & squares)
{
  squares.resize(static_cast<std::size_t>(last) + 1);
  for (std::int64_t step = 0; step <= last; ++step)
  {
    const double length = static_cast<double>(step) * spacing;
    squares[static_cast<std::size_t>(step)] = static_cast<TCost>(length * length);
  }
}

/** Grow without giving memory back, as a workspace serves many tiles. */
template <typename TVector>
void
Reserve(TVector & values, const std::int64_t size)
{
  if (values.size() < static_cast<std::size_t>(size))
  {
    values.resize(static_cast<std::size_t>(size));
  }
}

} // namespace

/** A group of columns of the remaining voxels, searched along x, then y, then z. */
template <typename TCost>
struct MedialVoxelFeatureTransform::ColumnGroup
{
  const MedialVoxelGrid &   grid;
  Tile &                    tile;
  Workspace::Lines<TCost> & lines;

  /** First voxel and number of the columns, and that number rounded up to what vector instructions like. */
  std::int64_t x;
  std::int64_t columns;
  std::int64_t lanes;

  /** Voxels to search for, and voxels whose sites count. */
  MedialVoxelBox   range;
  MedialVoxelBox   search;
  MedialVoxelIndex margin;

  using TraitsType = MedialVoxelOutwardTraits<TCost>;

  void
  SearchAlongX() const
  {
    const double       spacing = grid.GetMetricSpacing()[0];
    const std::int64_t rows = search.Extent(1) * search.Extent(2);
    Reserve(tile.nearestX, rows * lanes);
    Reserve(lines.costX, rows * lanes);
    for (std::int64_t row = 0; row < rows; ++row)
    {
      const std::int64_t   y = search.lower[1] + row % search.Extent(1);
      const std::int64_t   z = search.lower[2] + row / search.Extent(1);
      std::int32_t * const nearest = tile.nearestX.data() + row * lanes;
      TCost * const        cost = lines.costX.data() + row * lanes;
      MedialVoxelNearestInRow(*tile.window.sites, x, lanes, y, z, margin[0], nearest);
      for (std::int64_t lane = 0; lane < lanes; ++lane)
      {
        const double length = static_cast<double>(nearest[lane]) * spacing;
        const bool   hasSite = nearest[lane] != MedialVoxelNoDisplacement;
        cost[lane] = hasSite ? static_cast<TCost>(length * length) : TraitsType::NoSite;
      }
    }
  }

  void
  SearchAlongY() const
  {
    const std::int64_t rows = range.Extent(1) * search.Extent(2);
    Reserve(lines.costXY, rows * lanes);
    Reserve(lines.positionY, rows * lanes);
    for (std::int64_t row = 0; row < rows && !tile.IsAborted(); ++row)
    {
      MedialVoxelSearchOutward<TCost>(lines.costX.data() + row / range.Extent(1) * search.Extent(1) * lanes,
                                      lanes,
                                      search.Extent(1),
                                      lanes,
                                      range.lower[1] + row % range.Extent(1) - search.lower[1],
                                      lines.squaresY,
                                      lines.costXY.data() + row * lanes,
                                      lines.positionY.data() + row * lanes);
    }
  }

  void
  SearchAlongZ() const
  {
    Reserve(lines.cost, lanes);
    Reserve(lines.positionZ, lanes);
    for (std::int64_t y = range.lower[1]; y < range.upper[1]; ++y)
    {
      for (std::int64_t z = range.lower[2]; z < range.upper[2] && !tile.IsAborted(); ++z)
      {
        MedialVoxelSearchOutward<TCost>(lines.costXY.data() + (y - range.lower[1]) * lanes,
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
    const TCost       cost = lines.cost[static_cast<std::size_t>(lane)];
    if (!(cost < TraitsType::NoSite))
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
               tile.nearestX[static_cast<std::size_t>(nearest)],
               search.lower[1] + bestY - y,
               search.lower[2] + bestZ - z);
    tile.largestSquaredLength = std::max(tile.largestSquaredLength, static_cast<double>(cost));
  }

  /** Lengths that differ in the plane may round to the same sum, among which the smallest y has to win. */
  std::int64_t
  SmallestEqualY(const std::int64_t lane,
                 const std::int64_t centerY,
                 const std::int64_t centerZ,
                 const std::int64_t bestY,
                 const std::int64_t bestZ,
                 const TCost        cost) const
  {
    const TCost squareZ = lines.squaresZ[static_cast<std::size_t>(std::abs(bestZ - centerZ))];
    for (std::int64_t y = std::max<std::int64_t>(0, centerY - margin[1]); y < bestY; ++y)
    {
      const TCost costX = lines.costX[static_cast<std::size_t>((bestZ * search.Extent(1) + y) * lanes + lane)];
      const TCost squareY = lines.squaresY[static_cast<std::size_t>(std::abs(y - centerY))];
      if ((costX + squareY) + squareZ == cost)
      {
        return y;
      }
    }
    return bestY;
  }
};

template <typename TCost>
void
MedialVoxelFeatureTransform::SearchRemaining(Tile & tile, Workspace::Lines<TCost> & lines) const
{
  const MedialVoxelBox & range = tile.remainingBox;
  const MedialVoxelIndex margin = m_Grid.MarginForMetricLength(tile.reach);
  const MedialVoxelBox   search = range.Expanded(margin).Intersection(tile.known);
  FillSquares(margin[1], m_Grid.GetMetricSpacing()[1], lines.squaresY);
  FillSquares(margin[2], m_Grid.GetMetricSpacing()[2], lines.squaresZ);

  // Groups of nearly equal width, since a group costs the same whether its last lanes are used or not.
  const std::int64_t groups = (range.Extent(0) + MedialVoxelBits::BitsPerWord - 1) / MedialVoxelBits::BitsPerWord;
  for (std::int64_t group = 0; group < groups; ++group)
  {
    const std::int64_t       x = range.lower[0] + group * range.Extent(0) / groups;
    const std::int64_t       columns = range.lower[0] + (group + 1) * range.Extent(0) / groups - x;
    const std::int64_t       lanes = (columns + LaneUnit - 1) / LaneUnit * LaneUnit;
    const ColumnGroup<TCost> columnGroup{ m_Grid, tile, lines, x, columns, lanes, range, search, margin };
    columnGroup.SearchAlongX();
    columnGroup.SearchAlongY();
    columnGroup.SearchAlongZ();
  }
}

void
MedialVoxelFeatureTransform::DropDistant(Tile & tile) const
{
  if (!std::isfinite(m_MaximumDistance))
  {
    return;
  }
  const auto & spacing = m_Grid.GetSpacing();
  for (std::size_t offset = 0; offset < tile.features.dx.size(); ++offset)
  {
    const double x = tile.features.dx[offset] * spacing[0];
    const double y = tile.features.dy[offset] * spacing[1];
    const double z = tile.features.dz[offset] * spacing[2];
    if (tile.features.HasSite(offset) && std::sqrt((x * x + y * y) + z * z) > m_MaximumDistance)
    {
      tile.StoreNone(offset);
    }
  }
}

MedialVoxelBox
MedialVoxelFeatureTransform::MissingBox(const Tile & tile) const
{
  const double maximumLength = m_MaximumDistance / m_Grid.GetMetricUnit() * (1.0 + Slack);
  const double squared = std::min(tile.largestSquaredLength, maximumLength * maximumLength);
  if (squared < tile.squaredDistanceToUnknown)
  {
    return {};
  }
  const MedialVoxelIndex margin = m_Grid.MarginForMetricLength(std::sqrt(squared) * (1.0 + Slack));
  return tile.Box().Expanded(margin).Intersection(m_Grid.GetVoxelBox());
}

} // end namespace itk
