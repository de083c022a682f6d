// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFineSheet.h"

#include "itkMedialVoxelSheetSides.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <queue>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

/** How much sizes may fall along a length. */
constexpr double SizeSlope = 0.5;

constexpr Index NoTriangle = ~Index{ 0 };

Index
RootOf(std::vector<Index> & parents, Index number)
{
  while (parents[number] != number)
  {
    parents[number] = parents[parents[number]];
    number = parents[number];
  }
  return number;
}

bool
IsKnown(const float thickness)
{
  return thickness > 0.0F && std::isfinite(thickness);
}

double
GetDistance(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  return MedialVoxelNorm(MedialVoxelSubtract(a, b));
}

} // namespace

void
MedialVoxelSheet::AddQuad(const std::array<Index, 4> & corners)
{
  const double first = GetDistance(points[corners[0]], points[corners[2]]);
  const double second = GetDistance(points[corners[1]], points[corners[3]]);
  const auto   start = second < first ? 1u : 0u;
  for (const unsigned int k : { start, start + 2 })
  {
    triangles.push_back({ { corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4] } });
  }
}

void
MedialVoxelSheet::RemoveDuplicates()
{
  using Entry = std::pair<std::array<Index, 3>, Index>;
  std::vector<Entry> entries;
  entries.reserve(triangles.size());
  for (Index number = 0; number < triangles.size(); ++number)
  {
    entries.emplace_back(triangles[number], number);
    std::sort(entries.back().first.begin(), entries.back().first.end());
  }
  std::sort(entries.begin(), entries.end());
  const auto isSame = [](const Entry & a, const Entry & b) { return a.first == b.first; };
  entries.erase(std::unique(entries.begin(), entries.end(), isSame), entries.end());
  std::sort(entries.begin(), entries.end(), [](const Entry & a, const Entry & b) { return a.second < b.second; });
  std::vector<std::array<Index, 3>> kept;
  kept.reserve(entries.size());
  for (const Entry & entry : entries)
  {
    kept.push_back(triangles[entry.second]);
  }
  triangles.swap(kept);
}

MedialVoxelFineSheet::MedialVoxelFineSheet(MedialVoxelSheet sheet, std::vector<bool> isShared)
  : m_Sheet(std::move(sheet))
  , m_IsShared(std::move(isShared))
{
  assert(m_IsShared.empty() || m_IsShared.size() == m_Sheet.points.size());
  this->FindWallsAndLines();
  m_Walls = std::make_unique<MedialVoxelSheetTree>(m_Sheet.points, m_Sheet.triangles, m_WallOf);
}

void
MedialVoxelFineSheet::FindWallsAndLines()
{
  const std::vector<MedialVoxelSheetSide> sides = MedialVoxelSortSides(m_Sheet.triangles);
  std::vector<Index>                      parents(m_Sheet.triangles.size());
  std::iota(parents.begin(), parents.end(), Index{ 0 });
  std::vector<MedialVoxelSheetTree::Triangle> lines;
  std::vector<Index>                          owners; // of rims; none of junctions
  double                                      length = 0.0;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && sides[first] == sides[last])
    {
      ++last;
    }
    const MedialVoxelSheetSide & side = sides[first];
    length += GetDistance(m_Sheet.points[side.low], m_Sheet.points[side.high]) * static_cast<double>(last - first);
    if (last - first == 2)
    {
      // The root is the lowest number, so that walls are in the order of their first triangles.
      const Index a = RootOf(parents, side.triangle);
      const Index b = RootOf(parents, sides[first + 1].triangle);
      parents[std::max(a, b)] = std::min(a, b);
      continue;
    }
    if (this->IsShared(side.low) && this->IsShared(side.high))
    {
      continue;
    }
    lines.push_back({ { side.low, side.high, side.high } });
    owners.push_back(last - first == 1 ? side.triangle : NoTriangle);
    if (last - first > 2)
    {
      m_Junctions.push_back({ { side.low, side.high } });
    }
  }
  m_MeanSide = sides.empty() ? 0.0 : length / static_cast<double>(sides.size());

  m_WallOf.resize(parents.size());
  Index walls = 0;
  for (Index triangle = 0; triangle < parents.size(); ++triangle)
  {
    const Index root = RootOf(parents, triangle);
    m_WallOf[triangle] = root == triangle ? walls++ : m_WallOf[root];
  }
  std::vector<Index> groups;
  for (const Index owner : owners)
  {
    groups.push_back(owner == NoTriangle ? 0 : 1 + m_WallOf[owner]);
  }
  m_Lines = std::make_unique<MedialVoxelSheetTree>(m_Sheet.points, lines, groups);
}

void
MedialVoxelFineSheet::SetSizes(const double least, const bool atThickness, const double shareOfThickness)
{
  m_ShareOfThickness = static_cast<float>(shareOfThickness);
  m_Sizes.assign(m_Sheet.points.size(), static_cast<float>(least));
  std::vector<Index> raised;
  if (atThickness)
  {
    raised.resize(m_Sheet.points.size());
    std::iota(raised.begin(), raised.end(), Index{ 0 });
  }
  else
  {
    for (const auto & side : m_Junctions)
    {
      raised.insert(raised.end(), side.begin(), side.end());
    }
  }
  this->RaiseSizes(raised);
}

void
MedialVoxelFineSheet::RaiseSizes(const std::vector<Index> & points)
{
  for (const Index point : points)
  {
    if (IsKnown(m_Sheet.thickness[point]))
    {
      m_Sizes[point] = std::max(m_Sizes[point], m_ShareOfThickness * m_Sheet.thickness[point]);
    }
  }
  this->SpreadSizes();
}

/** Largest first, along the sides: a size falls by SizeSlope at most. */
void
MedialVoxelFineSheet::SpreadSizes()
{
  std::vector<Index> starts(m_Sheet.points.size() + 1, 0);
  for (const auto & triangle : m_Sheet.triangles)
  {
    for (const Index point : triangle)
    {
      ++starts[point + 1];
    }
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Index> trianglesOf(starts.back());
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (Index triangle = 0; triangle < m_Sheet.triangles.size(); ++triangle)
  {
    for (const Index point : m_Sheet.triangles[triangle])
    {
      trianglesOf[next[point]++] = triangle;
    }
  }
  using Entry = std::pair<float, Index>;
  std::vector<Entry> content;
  for (Index point = 0; point < m_Sizes.size(); ++point)
  {
    content.emplace_back(m_Sizes[point], point);
  }
  std::priority_queue<Entry> queue(std::less<Entry>(), std::move(content));
  while (!queue.empty())
  {
    const auto [size, point] = queue.top();
    queue.pop();
    for (Index k = starts[point]; size == m_Sizes[point] && k < starts[point + 1]; ++k)
    {
      for (const Index other : m_Sheet.triangles[trianglesOf[k]])
      {
        const auto spread =
          static_cast<float>(size - SizeSlope * GetDistance(m_Sheet.points[point], m_Sheet.points[other]));
        if (spread > m_Sizes[other])
        {
          m_Sizes[other] = spread;
          queue.emplace(spread, other);
        }
      }
    }
  }
}

Index
MedialVoxelFineSheet::GetNearestPoint(const Index triangle, const Point & place) const
{
  const auto & corners = m_Sheet.triangles[triangle];
  return *std::min_element(corners.begin(), corners.end(), [&](const Index a, const Index b) {
    return GetDistance(m_Sheet.points[a], place) < GetDistance(m_Sheet.points[b], place);
  });
}

double
MedialVoxelFineSheet::GetThickness(const Index triangle, const Point & place) const
{
  double sum = 0.0;
  double weights = 0.0;
  for (const Index corner : m_Sheet.triangles[triangle])
  {
    if (IsKnown(m_Sheet.thickness[corner]))
    {
      // By the distance: the same as linear at the corners, and defined where some are unknown.
      const double weight = 1.0 / (GetDistance(m_Sheet.points[corner], place) + 1e-6 * m_MeanSide);
      sum += weight * m_Sheet.thickness[corner];
      weights += weight;
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

} // end namespace itk
