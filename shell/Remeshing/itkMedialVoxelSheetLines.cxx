// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetLines.h"

#include "itkMedialVoxelSheetSides.h"

#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

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

} // namespace

MedialVoxelSheetLines
MedialVoxelFindLines(const MedialVoxelSheet & sheet, const std::vector<bool> & isShared)
{
  MedialVoxelSheetLines                   result;
  const std::vector<MedialVoxelSheetSide> sides = MedialVoxelSortSides(sheet.triangles);
  std::vector<Index>                      parents(sheet.triangles.size());
  std::iota(parents.begin(), parents.end(), Index{ 0 });
  double length = 0.0;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && sides[first] == sides[last])
    {
      ++last;
    }
    const MedialVoxelSheetSide & side = sides[first];
    length += MedialVoxelNorm(MedialVoxelSubtract(sheet.points[side.low], sheet.points[side.high])) *
              static_cast<double>(last - first);
    if (last - first == 2)
    {
      // The root is the lowest number, so that walls are in the order of their first triangles.
      const Index a = RootOf(parents, side.triangle);
      const Index b = RootOf(parents, sides[first + 1].triangle);
      parents[std::max(a, b)] = std::min(a, b);
    }
    else if (isShared.empty() || !isShared[side.low] || !isShared[side.high])
    {
      // The owner of a rim, for the time being.
      const Index owner = last - first == 1 ? side.triangle : MedialVoxelSheetLines::Junction;
      result.lines.push_back({ { { side.low, side.high } }, owner });
    }
  }
  result.meanSide = sides.empty() ? 0.0 : length / static_cast<double>(sides.size());
  result.wallOf.resize(parents.size());
  for (Index triangle = 0; triangle < parents.size(); ++triangle)
  {
    const Index root = RootOf(parents, triangle);
    result.wallOf[triangle] = root == triangle ? result.numberOfWalls++ : result.wallOf[root];
  }
  for (MedialVoxelSheetLines::Line & line : result.lines)
  {
    line.wall = line.wall == MedialVoxelSheetLines::Junction ? line.wall : result.wallOf[line.wall];
  }
  return result;
}

} // end namespace itk
