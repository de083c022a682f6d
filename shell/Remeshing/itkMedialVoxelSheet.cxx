// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheet.h"

#include <algorithm>
#include <utility>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

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

} // end namespace itk
