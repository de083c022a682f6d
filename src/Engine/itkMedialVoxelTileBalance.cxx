// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileBalance.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace itk
{

namespace
{

/** Tiles for each worker in a slab of tiles that take long. */
constexpr double TilesPerWorker = 4.0;

/** Largest share of the time of a slab that one of its tiles may take. */
constexpr double ShareOfLongestTile = 0.5;

/** Share of a worker's time from which on a tile comes first. */
constexpr double ShareOfLeadingTile = 0.125;

/** For each worker, the time of short tiles at the end, as a multiple of the longest tile before them. */
constexpr double TrailingTime = 2.0;

/** Parts of tiles have no fewer rows and slices; they keep their columns, whose words belong together. */
constexpr MedialVoxelIndex SmallestPart{ { 0, 16, 4 } };

/** Where a tile lies within its slab. */
MedialVoxelIndex
GetColumn(const MedialVoxelBox & tile, const unsigned int slowestAxis)
{
  MedialVoxelIndex column = tile.lower;
  column[slowestAxis] = 0;
  return column;
}

std::vector<MedialVoxelBox>
Halve(const std::vector<MedialVoxelBox> & parts, const unsigned int axis)
{
  std::vector<MedialVoxelBox> halves;
  for (const MedialVoxelBox & part : parts)
  {
    const std::int64_t middle = part.lower[axis] + part.Extent(axis) / 2;
    halves.push_back(part);
    halves.back().upper[axis] = middle;
    halves.push_back(part);
    halves.back().lower[axis] = middle;
  }
  return halves;
}

} // namespace

void
MedialVoxelTileBalance::Record(const MedialVoxelBox & tile, const unsigned int slowestAxis, const double seconds)
{
  m_VoxelSeconds[GetColumn(tile, slowestAxis)] = seconds / static_cast<double>(tile.NumberOfVoxels());
}

auto
MedialVoxelTileBalance::Time(const std::vector<MedialVoxelBox> & tiles, const unsigned int slowestAxis) const
  -> std::vector<TimedTile>
{
  std::vector<TimedTile> timed;
  for (const MedialVoxelBox & tile : tiles)
  {
    const auto   found = m_VoxelSeconds.find(GetColumn(tile, slowestAxis));
    const double ofVoxel = found == m_VoxelSeconds.end() ? 0.0 : found->second;
    timed.push_back({ ofVoxel * static_cast<double>(tile.NumberOfVoxels()), tile });
  }
  return timed;
}

double
MedialVoxelTileBalance::SumOf(const std::vector<TimedTile> & tiles)
{
  const auto add = [](const double sum, const TimedTile & tile) { return sum + tile.seconds; };
  return std::accumulate(tiles.begin(), tiles.end(), 0.0, add);
}

double
MedialVoxelTileBalance::FindLongestTrailing(const std::vector<TimedTile> & tiles,
                                            const double                   longest,
                                            const double                   numberOfWorkers)
{
  std::vector<double> seconds;
  for (const TimedTile & tile : tiles)
  {
    seconds.push_back(tile.seconds);
  }
  std::sort(seconds.begin(), seconds.end());
  const double wanted = TrailingTime * numberOfWorkers * longest;
  double       sum = 0.0;
  double       last = 0.0;
  for (auto next = seconds.begin(); next != seconds.end() && sum < wanted; ++next)
  {
    sum += *next;
    last = *next;
  }
  return last;
}

void
MedialVoxelTileBalance::Order(std::vector<TimedTile> & tiles, const double numberOfWorkers)
{
  const auto   isLonger = [](const TimedTile & a, const TimedTile & b) { return a.seconds > b.seconds; };
  const double leading = ShareOfLeadingTile * SumOf(tiles) / numberOfWorkers;
  double       longest = 0.0;
  for (const TimedTile & tile : tiles)
  {
    longest = std::max(longest, tile.seconds <= leading ? tile.seconds : 0.0);
  }
  const double trailing = FindLongestTrailing(tiles, longest, numberOfWorkers);
  const auto   middle = std::stable_partition(
    tiles.begin(), tiles.end(), [leading](const TimedTile & tile) { return tile.seconds > leading; });
  const auto end =
    std::stable_partition(middle, tiles.end(), [trailing](const TimedTile & tile) { return tile.seconds > trailing; });
  std::stable_sort(tiles.begin(), middle, isLonger);
  std::stable_sort(end, tiles.end(), isLonger);
}

std::vector<MedialVoxelBox>
MedialVoxelTileBalance::Balance(const std::vector<MedialVoxelBox> & tiles, const Slab & slab) const
{
  const double           workers = slab.numberOfWorkers;
  std::vector<TimedTile> timed = this->Time(tiles, slab.slowestAxis);
  Order(timed, workers);
  double                      rest = SumOf(timed);
  const double                most = slab.numberOfWorkers < ManyWorkers ? 1.0 : workers;
  const double                least = TilesPerWorker * workers / static_cast<double>(tiles.size());
  std::vector<MedialVoxelBox> balanced;
  for (const TimedTile & tile : timed)
  {
    const double longest = ShareOfLongestTile * rest / workers;
    const double parts = std::max(least, longest > 0.0 ? tile.seconds / longest : 0.0);
    const auto   boxes = Split(tile.box, static_cast<std::int64_t>(std::min(parts, most)));
    balanced.insert(balanced.end(), boxes.begin(), boxes.end());
    rest -= slab.isLast ? tile.seconds : 0.0;
  }
  return balanced;
}

std::vector<MedialVoxelBox>
MedialVoxelTileBalance::Split(const MedialVoxelBox & tile, const std::int64_t number)
{
  std::vector<MedialVoxelBox> parts{ tile };
  while (2 * static_cast<std::int64_t>(parts.size()) <= number)
  {
    const MedialVoxelBox & part = parts.front();
    const unsigned int     axis = part.Extent(1) / SmallestPart[1] >= part.Extent(2) / SmallestPart[2] ? 1 : 2;
    if (part.Extent(axis) < 2 * SmallestPart[axis])
    {
      break;
    }
    parts = Halve(parts, axis);
  }
  return parts;
}

} // end namespace itk
