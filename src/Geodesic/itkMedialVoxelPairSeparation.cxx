// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPairSeparation.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace itk
{

namespace
{

/** Groups are cubes of 16, then 8, then 4 voxels. */
constexpr unsigned int FirstLevel = 4;
constexpr unsigned int LastLevel = 2;

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
  MedialVoxelPollCounter poll;
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    poll.Count();
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
  MedialVoxelPoll();
  MedialVoxelBox box;
  for (auto entry = first; entry != last; ++entry)
  {
    box = box.Union(entry->box);
  }
  auto joined = last;
  if (box.Extent(0) <= MedialVoxelBoxComponents::LongestRow)
  {
    workspace.m_Components.Label(boundary, box);
    joined = std::partition(first, last, [&](const Workspace::Entry & entry) {
      auto & query = queries[entry.query];
      query.isSeparated = !workspace.m_Components.AreConnected(query.a, query.b);
      return !query.isSeparated;
    });
  }
  if (level == LastLevel)
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

namespace
{

/** The points of \a boundary in \a box that a path below the threshold can use: those in the ellipsoid with the two
 * points as foci, which are nearer to each other than the threshold. */
MedialVoxelBits
PointsInEllipsoid(const MedialVoxelGrid &            grid,
                  const MedialVoxelBits &            boundary,
                  const MedialVoxelBox &             box,
                  const MedialVoxelSeparationQuery & query)
{
  const auto &          spacing = grid.GetSpacing();
  std::array<double, 3> center;
  std::array<double, 3> focus;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * static_cast<double>(query.a[axis] + query.b[axis]) * spacing[axis];
    focus[axis] = 0.5 * static_cast<double>(query.a[axis] - query.b[axis]) * spacing[axis];
  }
  // A point p from the center is inside when (p.u / major)^2 + (p.p - (p.u)^2) / minor^2 <= 1, u along the foci.
  const double length = 0.5 * query.epsilon * (1.0 + MedialVoxelResolutionBand);
  const double squaredFocus = focus[0] * focus[0] + focus[1] * focus[1] + focus[2] * focus[2];
  const double squaredMajor = length * length;
  // At least so much that nothing is lost to rounding; a wider ellipsoid holds more.
  const double squaredMinor = std::max(squaredMajor - squaredFocus, 1e-4 * squaredMajor);
  const double alongFoci = (1.0 / squaredMajor - 1.0 / squaredMinor) / squaredFocus;
  const double square = 1.0 / squaredMinor + focus[0] * focus[0] * alongFoci;

  MedialVoxelBits points(box);
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    const double wayZ = static_cast<double>(z) * spacing[2] - center[2];
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const double wayY = static_cast<double>(y) * spacing[1] - center[1];
      const double dot = wayY * focus[1] + wayZ * focus[2];
      const double half = dot * focus[0] * alongFoci;
      const double rest = dot * dot * alongFoci + (wayY * wayY + wayZ * wayZ) / squaredMinor - 1.0;
      const double discriminant = half * half - square * rest;
      // Rounding must not lose a point.
      constexpr double slack = 1e-6;
      if (discriminant < -slack * square)
      {
        continue;
      }
      const double root = std::sqrt(std::max(0.0, discriminant));
      // Of an ellipsoid that is much larger than the box, only the part in the box is a number of voxels.
      const auto xAt = [&](const double way) {
        const double x = (center[0] + way / square) / spacing[0];
        return std::clamp(x, static_cast<double>(box.lower[0] - 1), static_cast<double>(box.upper[0] + 1));
      };
      const auto lower = static_cast<std::int64_t>(std::ceil(xAt(-half - root) - slack));
      const auto upper = static_cast<std::int64_t>(std::floor(xAt(-half + root) + slack)) + 1;
      const auto inside = MedialVoxelBits::RangeMask(0, lower - box.lower[0], upper - box.lower[0]);
      const auto bits = boundary.Extract(box.lower[0], y, z) & inside & MedialVoxelBits::RangeMask(0, 0, box.Extent(0));
      const auto shift = static_cast<unsigned int>(box.lower[0] & (MedialVoxelBits::BitsPerWord - 1));
      auto * const row = points.GetRow(y, z);
      row[0] |= bits << shift;
      if (shift != 0)
      {
        row[1] |= bits >> (MedialVoxelBits::BitsPerWord - shift);
      }
    }
  }
  return points;
}

} // namespace

bool
MedialVoxelPairSeparation::IsNear(const MedialVoxelSeparationQuery & query) const
{
  const MedialVoxelDisplacement difference{
    { query.a[0] - query.b[0], query.a[1] - query.b[1], query.a[2] - query.b[2] }
  };
  return MedialVoxelDualCell(m_Grid).FreeSpaceLength(difference) < query.epsilon;
}

double
MedialVoxelPairSeparation::BoundLength(const MedialVoxelBits &            boundary,
                                       const MedialVoxelSeparationQuery & query,
                                       Workspace &                        workspace) const
{
  assert(this->IsNear(query));
  MedialVoxelPoll();
  const double         lower = query.epsilon * (1.0 - MedialVoxelResolutionBand);
  const double         upper = query.epsilon * (1.0 + MedialVoxelResolutionBand);
  const MedialVoxelBox box = MedialVoxelBoundedGeodesic::SearchBoxOf(m_Grid, query.a, query.b, query.epsilon);
  if (box.Extent(0) <= MedialVoxelPathSearch::LongestRow)
  {
    const MedialVoxelBits points = PointsInEllipsoid(m_Grid, boundary, box, query);
    workspace.m_Components.Label(points, box);
    if (!workspace.m_Components.AreConnected(query.a, query.b))
    {
      return std::numeric_limits<double>::infinity();
    }
    const double length = m_Search.FindLength(points, box, query.a, query.b, lower, upper, workspace.m_Search);
    if (length < lower || length > upper)
    {
      return length;
    }
  }
  // Rounding matters, or the box is large.
  const MedialVoxelBoundedGeodesic geodesic(m_Grid, query.epsilon);
  geodesic.Begin(boundary, box, workspace.m_Geodesic);
  return geodesic.ReachesThreshold(query.a, query.b, workspace.m_Geodesic) ? std::numeric_limits<double>::infinity()
                                                                           : std::nextafter(query.epsilon, 0.0);
}

} // end namespace itk
