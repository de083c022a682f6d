// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetSizes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

/** How much sizes may fall along a length. */
constexpr double SizeSlope = 0.5;

double
GetDistance(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  return MedialVoxelNorm(MedialVoxelSubtract(a, b));
}

} // namespace

MedialVoxelSheetSizes::MedialVoxelSheetSizes(const MedialVoxelSheet &       sheet,
                                             const MedialVoxelSheetLines &  lines,
                                             const MedialVoxelElementSize & size)
  : m_Sheet(&sheet)
  , m_Sizes(sheet.points.size(), static_cast<float>(size.least))
  , m_ShareOfThickness(static_cast<float>(size.shareOfThickness))
{
  std::vector<Index> raised;
  if (size.atThickness)
  {
    raised.resize(sheet.points.size());
    std::iota(raised.begin(), raised.end(), Index{ 0 });
  }
  for (const MedialVoxelSheetLines::Line & line : lines.lines)
  {
    if (!size.atThickness && line.wall == MedialVoxelSheetLines::Junction)
    {
      raised.insert(raised.end(), line.points.begin(), line.points.end());
    }
  }
  this->Raise(raised);
}

void
MedialVoxelSheetSizes::Raise(const std::vector<Index> & points)
{
  for (const Index point : points)
  {
    if (MedialVoxelIsKnown(m_Sheet->thickness[point]))
    {
      m_Sizes[point] = std::max(m_Sizes[point], m_ShareOfThickness * m_Sheet->thickness[point]);
    }
  }
  this->Spread();
}

/** Largest first, along the sides: a size falls by SizeSlope at most. */
void
MedialVoxelSheetSizes::Spread()
{
  std::vector<Index> starts(m_Sheet->points.size() + 1, 0);
  for (const auto & triangle : m_Sheet->triangles)
  {
    for (const Index point : triangle)
    {
      ++starts[point + 1];
    }
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Index> trianglesOf(starts.back());
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (Index triangle = 0; triangle < m_Sheet->triangles.size(); ++triangle)
  {
    for (const Index point : m_Sheet->triangles[triangle])
    {
      trianglesOf[next[point]++] = triangle;
    }
  }
  // Calls raise(other, size) for each point that a point would raise.
  const auto forEachLower = [&](const Index point, const auto & raise) {
    for (Index k = starts[point]; k < starts[point + 1]; ++k)
    {
      for (const Index other : m_Sheet->triangles[trianglesOf[k]])
      {
        if (m_Sizes[other] < m_Sizes[point])
        {
          const auto spread = static_cast<float>(
            m_Sizes[point] - SizeSlope * GetDistance(m_Sheet->points[point], m_Sheet->points[other]));
          if (spread > m_Sizes[other])
          {
            raise(other, spread);
          }
        }
      }
    }
  };
  using Entry = std::pair<float, Index>;
  std::vector<Entry> content;
  for (Index point = 0; point < m_Sizes.size(); ++point)
  {
    bool isHigh = false;
    forEachLower(point, [&](Index, float) { isHigh = true; });
    if (isHigh)
    {
      content.emplace_back(m_Sizes[point], point);
    }
  }
  std::priority_queue<Entry> queue(std::less<Entry>(), std::move(content));
  while (!queue.empty())
  {
    const auto [size, point] = queue.top();
    queue.pop();
    if (size == m_Sizes[point])
    {
      forEachLower(point, [&](const Index other, const float spread) {
        m_Sizes[other] = spread;
        queue.emplace(spread, other);
      });
    }
  }
}

} // end namespace itk
