// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallsLeftOut.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelSheetSides.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

/** Lengths of the outlines of walls that are not kept: of sides that are not of two triangles. */
std::vector<double>
MeasureOutlines(const MedialVoxelSheet & sheet, const std::vector<Index> & wallOf, const std::vector<bool> & isKept)
{
  std::vector<bool> isOfOne(sheet.points.size());
  for (Index triangle = 0; triangle < sheet.triangles.size(); ++triangle)
  {
    for (const Index point : sheet.triangles[triangle])
    {
      isOfOne[point] = isOfOne[point] || !isKept[wallOf[triangle]];
    }
  }
  std::vector<Index>                numbers; // of triangles at them
  std::vector<std::array<Index, 3>> triangles;
  for (Index triangle = 0; triangle < sheet.triangles.size(); ++triangle)
  {
    const auto & corners = sheet.triangles[triangle];
    if (std::any_of(corners.begin(), corners.end(), [&](const Index point) { return isOfOne[point]; }))
    {
      numbers.push_back(triangle);
      triangles.push_back(corners);
    }
  }
  const std::vector<MedialVoxelSheetSide> sides = MedialVoxelSortSides(triangles);
  std::vector<double>                     lengths(isKept.size());
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && sides[first] == sides[last])
    {
      ++last;
    }
    for (std::size_t k = first; last - first != 2 && k < last; ++k)
    {
      lengths[wallOf[numbers[sides[k].triangle]]] +=
        MedialVoxelNorm(MedialVoxelSubtract(sheet.points[sides[k].low], sheet.points[sides[k].high]));
    }
  }
  return lengths;
}

} // namespace

std::vector<MedialVoxelWallLeftOut>
MedialVoxelListWallsLeftOut(const MedialVoxelSheet &   sheet,
                            const std::vector<Index> & wallOf,
                            const std::vector<bool> &  isKept,
                            const double               least)
{
  if (std::find(isKept.begin(), isKept.end(), false) == isKept.end())
  {
    return {};
  }
  const std::vector<double>           outlines = MeasureOutlines(sheet, wallOf, isKept);
  std::vector<MedialVoxelWallLeftOut> walls(isKept.size());
  for (Index triangle = 0; triangle < sheet.triangles.size(); ++triangle)
  {
    if (isKept[wallOf[triangle]])
    {
      continue;
    }
    MedialVoxelWallLeftOut & wall = walls[wallOf[triangle]];
    const auto &             corners = sheet.triangles[triangle];
    const auto               at = [&](const unsigned int k) { return sheet.points[corners[k]]; };
    const double             area = MedialVoxelNorm(MedialVoxelTriangleNormal({ { at(0), at(1), at(2) } })) / 2.0;
    wall.area += area;
    for (unsigned int k = 0; k < 3; ++k)
    {
      wall.place = MedialVoxelAddScaled(wall.place, at(k), area / 3.0);
      const double thickness = sheet.thickness[corners[k]];
      wall.elementSize += std::isfinite(thickness) ? std::max(least, thickness) * area / 3.0 : least * area / 3.0;
    }
  }
  std::vector<MedialVoxelWallLeftOut> result;
  for (std::size_t number = 0; number < walls.size(); ++number)
  {
    MedialVoxelWallLeftOut & wall = walls[number];
    if (!isKept[number])
    {
      const double scale = wall.area > 0.0 ? 1.0 / wall.area : 0.0;
      wall.place = MedialVoxelAddScaled({}, wall.place, scale);
      wall.elementSize *= scale;
      wall.width = outlines[number] > 0.0 ? 2.0 * wall.area / outlines[number] : 0.0;
      result.push_back(wall);
    }
  }
  std::stable_sort(result.begin(), result.end(), [](const auto & a, const auto & b) { return a.area > b.area; });
  return result;
}

void
MedialVoxelAddWallsLeftOut(const std::vector<MedialVoxelWallLeftOut> & further,
                           std::vector<MedialVoxelWallLeftOut> &       walls)
{
  walls.insert(walls.end(), further.begin(), further.end());
  std::stable_sort(walls.begin(), walls.end(), [](const auto & a, const auto & b) { return a.area > b.area; });
}

} // end namespace itk
