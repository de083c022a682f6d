// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFeatureTransformPrivate.h"

#include "itkMedialVoxelElementary.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

namespace
{

/** Radii of the balls of sorted displacements, in voxels: the larger one is large enough for the walls of thin parts,
 * the smaller one separates thin parts from thick ones. */
constexpr double NearRadius = 3.0;
constexpr double FarRadius = 6.0;

/** Share of the voxels that the smaller ball may leave before the larger one is tried. */
constexpr std::uint64_t ThinPart = 8;

/** Longest displacement of a tile, in voxels, from which the next one is taken for thick. */
constexpr std::int64_t ThickReach = 16;

/** Edge of the blocks whose centers bound the distances of their voxels. */
constexpr std::int64_t BoundBlockSize = 16;

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
  return active == 0 ? 1.0 : MedialVoxelElementary::Power(product, 1.0 / active);
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

MedialVoxelFeatureTransform::MedialVoxelFeatureTransform(const MedialVoxelGrid & grid,
                                                         const MedialVoxelRegion region,
                                                         const double            maximumDistance)
  : m_Grid(grid)
  , m_Region(region)
  , m_MaximumDistance(maximumDistance)
{
  auto         offsets = MedialVoxelSortedOffsets(grid, FarRadius * MeanMetricSpacing(grid));
  const double radius = NearRadius * MeanMetricSpacing(grid);
  const auto   firstFar = std::find_if(offsets.begin(), offsets.end(), [&](const MedialVoxelOffset & offset) {
    return offset.squaredLength > radius * radius;
  });
  m_FarOffsets = MedialVoxelOffsetTable({ firstFar, offsets.end() });
  offsets.erase(firstFar, offsets.end());
  m_NearOffsets = MedialVoxelOffsetTable(std::move(offsets));
}

double
MedialVoxelFeatureTransform::MaximumMetricLength() const
{
  return m_MaximumDistance / m_Grid.GetMetricUnit() * (1.0 + RelativeSlack);
}

MedialVoxelBox
MedialVoxelFeatureTransform::Compute(const MedialVoxelWindow &         window,
                                     const MedialVoxelBox &            tileBox,
                                     Workspace &                       workspace,
                                     MedialVoxelFeatures &             features,
                                     const MedialVoxelProgress * const progress) const
{
  // One voxel beyond, nothing is final; two beyond would look like a distance.
  const MedialVoxelBox & known = window.sites->GetBox();
  if (!known.Expanded({ { 1, 1, 1 } }).Contains(tileBox) || !window.object->GetBox().Contains(tileBox))
  {
    return known.Union(tileBox);
  }
  features.Reset(tileBox);
  Tile tile{ window, features, workspace.m_Remaining, known, progress };
  tile.squaredDistanceToUnknown = SquaredDistanceToUnknown(m_Grid, known, tileBox);
  tile.firstWord = tileBox.lower[0] >> 6;
  tile.words = ((tileBox.upper[0] - 1) >> 6) - tile.firstWord + 1;
  tile.remaining.resize(static_cast<std::size_t>(tile.words * tileBox.Extent(1) * tileBox.Extent(2)));

  // A wrong guess costs time, but changes no result.
  const bool isThick = m_Grid.HasEqualSpacing() && workspace.m_Slices.reach >= ThickReach;
  for (std::int64_t z = tileBox.lower[2]; z < tileBox.upper[2]; ++z)
  {
    MedialVoxelCheckAbort();
    const std::uint64_t voxels = this->FindQueries(tile, z);
    if (voxels != 0 && !isThick)
    {
      this->SearchNearby(tile, z, voxels);
    }
  }
  tile.FindRemainingBox();
  if (!known.Contains(tile.remainingBox))
  {
    return known.Union(tileBox);
  }
  const bool isLeft = !tile.remainingBox.IsEmpty();
  if (isLeft && !(m_Grid.HasEqualSpacing() && this->SearchSlices(tile, workspace.m_Slices)))
  {
    if (this->BoundRemaining(tile))
    {
      this->SearchColumns(tile, workspace.m_Lines);
    }
  }
  if (!tile.missing.IsEmpty())
  {
    return tile.missing;
  }
  this->DropDistant(tile);
  return this->MissingBox(tile);
}

/** Let all requested voxels of a slice remain; returns their number. */
std::uint64_t
MedialVoxelFeatureTransform::FindQueries(Tile & tile, const std::int64_t z) const
{
  const MedialVoxelBox & box = tile.Box();
  const WordType         flip = (m_Region == MedialVoxelRegion::Outside) ? ~WordType{ 0 } : WordType{ 0 };
  const WordType         all = (m_Region == MedialVoxelRegion::Both) ? ~WordType{ 0 } : WordType{ 0 };
  std::uint64_t          voxels = 0;
  for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
  {
    const auto rowOf = [y, z](const MedialVoxelBits & bits) { return bits.GetRow(y, z) - bits.GetFirstWord(); };
    const WordType * const object = rowOf(*tile.window.object);
    const WordType * const asked = tile.window.asked == nullptr ? nullptr : rowOf(*tile.window.asked);
    for (std::int64_t word = tile.firstWord; word < tile.firstWord + tile.words; ++word)
    {
      const WordType query = ((object[word] ^ flip) | all) & (asked == nullptr ? ~WordType{ 0 } : asked[word]) &
                             MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
      tile.Remaining(word, y, z) = query;
      if (query != 0)
      {
        const std::int64_t first = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(query);
        const int          number = MedialVoxelHighestBit(query) - MedialVoxelLowestBit(query) + 1;
        tile.features.MarkWritten(tile.features.OffsetOf(first, y, z), static_cast<std::size_t>(number));
      }
      voxels += static_cast<std::uint64_t>(MedialVoxelPopulationCount(query));
    }
  }
  return voxels;
}

/** Search the voxels of a slice by sorted displacements, as far as that finds most of them. */
void
MedialVoxelFeatureTransform::SearchNearby(Tile & tile, const std::int64_t z, const std::uint64_t voxels) const
{
  const std::uint64_t left = this->SearchTable(tile, z, m_NearOffsets);
  if (!m_Grid.HasEqualSpacing() || left * ThinPart < voxels)
  {
    this->SearchTable(tile, z, m_FarOffsets);
  }
}

/** Search the remaining voxels of a slice for sites at the displacements of \a table; returns how many remain. A word
 * begins with a remaining voxel, because it takes as long for few voxels as for many. */
std::uint64_t
MedialVoxelFeatureTransform::SearchTable(Tile & tile, const std::int64_t z, const MedialVoxelOffsetTable & table) const
{
  const MedialVoxelBox &  box = tile.Box();
  const std::int64_t      end = tile.words * MedialVoxelBits::BitsPerWord;
  const std::int64_t      firstBit = tile.firstWord * MedialVoxelBits::BitsPerWord;
  std::uint64_t           left = 0;
  MedialVoxelAbortChecker checker;
  for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
  {
    const MedialVoxelRemainingRow row{ &tile.Remaining(tile.firstWord, y, z), tile.words };
    for (std::int64_t bit = row.Next(0); bit < end; bit = row.Next(bit + MedialVoxelBits::BitsPerWord))
    {
      checker.Count(MedialVoxelBits::BitsPerWord);
      const WordType     query = row.Extract(bit);
      const std::int64_t x = firstBit + bit;
      const auto firstLane = static_cast<std::int64_t>(tile.features.OffsetOf(box.lower[0], y, z)) + (x - box.lower[0]);
      const auto result = MedialVoxelSearchOffsets(
        table,
        *tile.window.sites,
        x,
        y,
        z,
        query,
        { tile.features.dx.data(), tile.features.dy.data(), tile.features.dz.data(), firstLane });
      tile.largestSquaredLength = std::max(tile.largestSquaredLength, result.largestSquaredLength);
      row.Clear(bit, query & ~result.remaining);
      left += static_cast<std::uint64_t>(MedialVoxelPopulationCount(result.remaining));
    }
  }
  return left;
}

bool
MedialVoxelFeatureTransform::BoundRemaining(Tile & tile) const
{
  const double           maximumLength = this->MaximumMetricLength();
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
        MedialVoxelCheckAbort();
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
          tile.reach = std::max(tile.reach, (std::sqrt(squared) + toCorner) * (1.0 + RelativeSlack));
        }
        else if (std::isfinite(maximumLength))
        {
          tile.reach = maximumLength;
        }
        else if (std::isfinite(tile.squaredDistanceToUnknown))
        {
          this->AskForMore(tile);
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

/** Nothing bounds the distance, so look twice as far as the window does. */
void
MedialVoxelFeatureTransform::AskForMore(Tile & tile) const
{
  const double known = std::sqrt(tile.squaredDistanceToUnknown);
  const double least = 2.0 * static_cast<double>(BoundBlockSize) * MeanMetricSpacing(m_Grid);
  tile.missing = tile.Box().Expanded(m_Grid.MarginForMetricLength(std::max(2.0 * known, least)));
  tile.missing = tile.missing.Intersection(m_Grid.GetVoxelBox()).Union(tile.known);
}

/** Take note of the longest displacement of a slice; false when the window has to grow for it. */
bool
MedialVoxelFeatureTransform::Accept(Tile & tile, const double squaredLength, const std::int64_t z) const
{
  const double length = std::min(std::sqrt(squaredLength), this->MaximumMetricLength());
  if (!std::isfinite(length) && !std::isfinite(tile.squaredDistanceToUnknown))
  {
    return true; // there is no site at all
  }
  if (!std::isfinite(length))
  {
    this->AskForMore(tile);
    return false;
  }
  tile.largestSquaredLength = std::max(tile.largestSquaredLength, length * length);
  if (length * length < tile.squaredDistanceToUnknown)
  {
    return true;
  }
  // From slice to slice the distance grows by at most one.
  const auto   slices = static_cast<double>(tile.remainingBox.upper[2] - 1 - z);
  const double soFar = std::sqrt(tile.largestSquaredLength) * (1.0 + RelativeSlack);
  const double longest = std::min(soFar + slices, this->MaximumMetricLength());
  tile.missing = tile.Box().Expanded(m_Grid.MarginForMetricLength(longest)).Intersection(m_Grid.GetVoxelBox());
  return false;
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
  const double maximumLength = this->MaximumMetricLength();
  const double squared = std::min(tile.largestSquaredLength, maximumLength * maximumLength);
  if (squared < tile.squaredDistanceToUnknown)
  {
    return {};
  }
  const MedialVoxelIndex margin = m_Grid.MarginForMetricLength(std::sqrt(squared) * (1.0 + RelativeSlack));
  return tile.Box().Expanded(margin).Intersection(m_Grid.GetVoxelBox());
}

} // end namespace itk
