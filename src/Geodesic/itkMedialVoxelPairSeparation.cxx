// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPairSeparation.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <cassert>

namespace itk
{

namespace
{

/** Groups are cubes of 8, then 4 voxels. */
constexpr unsigned int FirstLevel = 3;
constexpr unsigned int LastLevel = 2;

/** Smaller groups are worth it where components separate one pair in so many of a larger group. */
constexpr std::ptrdiff_t PairsToSeparated = 8;

/** Share of the threshold to which paths are searched: lengths beyond the threshold decide neighboring pairs. */
constexpr double LongestSearch = 1.45;

/** Searches go at least so many edges beyond the threshold: neighbors lose some of the length, and short searches cost
 * little. */
constexpr double EdgesBeyond = 8.0;

/** Number of the cube of 2^level voxels that the middle of a pair lies in. */
std::uint64_t
GroupOf(const MedialVoxelSeparationQuery & query, const unsigned int level)
{
  std::uint64_t group = 0;
  for (unsigned int axis = 3; axis-- > 0;)
  {
    group = (group << 21) | static_cast<std::uint64_t>((query.a[axis] + query.b[axis]) >> (level + 1));
  }
  return group;
}

} // namespace

std::size_t
MedialVoxelPairSeparation::Workspace::PairHash::operator()(const Pair & pair) const
{
  constexpr std::uint64_t multiplier = 0x9E3779B97F4A7C15u;
  std::uint64_t           hash = 0;
  for (const MedialVoxelIndex & point : pair)
  {
    for (const std::int64_t coordinate : point)
    {
      hash = ((hash ^ static_cast<std::uint64_t>(coordinate)) * multiplier) ^ (hash >> 29);
    }
  }
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

MedialVoxelPairSeparation::MedialVoxelPairSeparation(const MedialVoxelGrid & grid)
  : m_Grid(grid)
  , m_Search(grid)
{}

MedialVoxelBox
MedialVoxelPairSeparation::FindSeparated(const MedialVoxelBits &                   boundary,
                                         const MedialVoxelProgress &               progress,
                                         Workspace &                               workspace,
                                         std::vector<MedialVoxelSeparationQuery> & queries) const
{
  MedialVoxelBox missing;
  auto &         entries = workspace.m_Entries;
  entries.clear();
  MedialVoxelAbortChecker checker;
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    checker.Count();
    auto & query = queries[i];
    assert(this->IsNear(query));
    query.isSeparated = false;
    const MedialVoxelBox box = MedialVoxelBoundedGeodesic::SearchBoxOf(m_Grid, query.a, query.b, query.epsilon);
    if (!boundary.GetBox().Contains(box))
    {
      missing = missing.Union(box);
    }
    entries.push_back({ i, GroupOf(query, FirstLevel), box });
  }
  if (!missing.IsEmpty())
  {
    return missing;
  }
  const auto byGroup = [](const Workspace::Entry & i, const Workspace::Entry & j) { return i.group < j.group; };
  std::sort(entries.begin(), entries.end(), byGroup);
  for (auto first = entries.begin(); first != entries.end() && !progress.IsAborted();)
  {
    const auto last = std::upper_bound(first, entries.end(), *first, byGroup);
    this->JudgeGroup(boundary, first, last, FirstLevel, workspace, queries);
    first = last;
  }
  return {};
}

void
MedialVoxelPairSeparation::JudgeGroup(const MedialVoxelBits &                   boundary,
                                      const Entries                             first,
                                      const Entries                             last,
                                      const unsigned int                        level,
                                      Workspace &                               workspace,
                                      std::vector<MedialVoxelSeparationQuery> & queries) const
{
  MedialVoxelCheckAbort();
  MedialVoxelBox box;
  for (auto entry = first; entry != last; ++entry)
  {
    box = box.Union(entry->box);
  }
  auto       joined = last;
  const bool isInWords = box.Extent(0) <= MedialVoxelBoxComponents::LongestRow;
  if (isInWords)
  {
    workspace.m_Components.Label(boundary, box);
    joined = std::partition(first, last, [&](const Workspace::Entry & entry) {
      auto & query = queries[entry.query];
      query.isSeparated = !workspace.m_Components.AreConnected(query.a, query.b);
      if (query.isSeparated)
      {
        query.bounds.Tighten({ MedialVoxelBoundedGeodesic::LengthWithin(m_Grid, query.a, query.b, box) });
      }
      return !query.isSeparated;
    });
  }
  if (level == LastLevel || (isInWords && PairsToSeparated * (last - joined) < last - first))
  {
    return;
  }
  for (auto entry = first; entry != joined; ++entry)
  {
    entry->group = GroupOf(queries[entry->query], level - 1);
  }
  const auto byGroup = [](const Workspace::Entry & i, const Workspace::Entry & j) { return i.group < j.group; };
  std::sort(first, joined, byGroup);
  for (auto entry = first; entry != joined;)
  {
    const auto next = std::upper_bound(entry, joined, *entry, byGroup);
    this->JudgeGroup(boundary, entry, next, level - 1, workspace, queries);
    entry = next;
  }
}

bool
MedialVoxelPairSeparation::IsNear(const MedialVoxelSeparationQuery & query) const
{
  const MedialVoxelDisplacement difference{
    { query.a[0] - query.b[0], query.a[1] - query.b[1], query.a[2] - query.b[2] }
  };
  return MedialVoxelDualCell(m_Grid).FreeSpaceLength(difference) < query.epsilon;
}

bool
MedialVoxelPairSeparation::Reaches(const MedialVoxelBits &      boundary,
                                   MedialVoxelSeparationQuery & query,
                                   Workspace &                  workspace) const
{
  assert(this->IsNear(query));
  MedialVoxelLengthBounds & known = workspace.m_Lengths[{ { query.a, query.b } }];
  query.bounds.Tighten(known);
  if (query.bounds.FallShortOf(query.epsilon) || query.bounds.Reach(query.epsilon))
  {
    return query.bounds.Reach(query.epsilon);
  }
  const bool reaches = this->Search(boundary, query, workspace, known);
  query.bounds.Tighten(known);
  return reaches;
}

bool
MedialVoxelPairSeparation::Search(const MedialVoxelBits &            boundary,
                                  const MedialVoxelSeparationQuery & query,
                                  Workspace &                        workspace,
                                  MedialVoxelLengthBounds &          bounds) const
{
  MedialVoxelCheckAbort();
  const double further =
    std::max(LongestSearch * query.epsilon, query.epsilon + EdgesBeyond * m_Grid.GetShortestEdge());
  const MedialVoxelBox wide =
    MedialVoxelBoundedGeodesic::SearchBoxOf(m_Grid, query.a, query.b, further).Intersection(boundary.GetBox());
  if (wide.Extent(0) <= MedialVoxelPathSearch::LongestRow)
  {
    const double enough = query.epsilon * (1.0 - MedialVoxelResolutionBand);
    const double unclear = query.epsilon * (1.0 + 3.0 * MedialVoxelResolutionBand);
    const double within = MedialVoxelBoundedGeodesic::LengthWithin(m_Grid, query.a, query.b, wide);
    const double most = std::max(unclear, std::min(further, within));
    const double length = m_Search.FindLength(boundary, wide, query.a, query.b, enough, most, workspace.m_Search);
    const double longest = length * (1.0 + MedialVoxelResolutionBand);
    if (length < enough)
    {
      bounds.Tighten({ 0.0, longest });
      return false;
    }
    if (length > unclear)
    {
      bounds.Tighten({ std::min(length, most) * (1.0 - MedialVoxelResolutionBand), longest });
      return true;
    }
  }
  // Rounding matters, or the box is large.
  const MedialVoxelBox box = MedialVoxelBoundedGeodesic::SearchBoxOf(m_Grid, query.a, query.b, query.epsilon);
  const MedialVoxelBoundedGeodesic geodesic(m_Grid, query.epsilon);
  geodesic.Begin(boundary, box, workspace.m_Geodesic);
  return geodesic.ReachesThreshold(query.a, query.b, workspace.m_Geodesic);
}

} // end namespace itk
