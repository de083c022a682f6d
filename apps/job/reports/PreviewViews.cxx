// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PreviewViews.h"

#include "Text.h"

#include <cmath>

namespace medialvoxel
{

std::vector<View>
ChooseViews(const VolumeGeometry & geometry, const Survey & survey)
{
  if (geometry.GetDimension() == 2)
  {
    return { { 0, 1, 2, 0, false } };
  }
  return { { 0, 1, 2, survey.GetBestSlice(2), false },
           { 0, 2, 1, survey.GetBestSlice(1), true },
           { 1, 2, 0, survey.GetBestSlice(0), true } };
}

std::uint64_t
GetLargestView(const VolumeGeometry & geometry)
{
  const std::uint64_t voxels = geometry.GetNumberOfVoxels();
  return geometry.GetDimension() == 2 ? voxels : voxels / *std::min_element(geometry.size.begin(), geometry.size.end());
}

std::string
MakeCaption(const View & view)
{
  return std::string(1, "xyz"[view.normal]) + " = " + std::to_string(view.index);
}

void
DrawCaption(Canvas & canvas, const Rectangle & area, const std::string & text)
{
  canvas.DrawText(area.x, area.y - TextHeight - TextDepth - 2, text, PreviewTextColor);
}

unsigned int
DrawLegendEntry(Canvas & canvas, unsigned int x, unsigned int y, const Color & color, const std::string & text)
{
  canvas.FillRectangle({ x, y, TextHeight, TextHeight }, color);
  canvas.DrawText(x + TextHeight + TextAdvance / 2, y, text, PreviewTextColor);
  return x + TextHeight + GetTextWidth(text) + 2 * TextAdvance;
}

void
DrawScaleBar(Canvas & canvas, unsigned int x, unsigned int y, double pixelsPerUnit, const VolumeGeometry & geometry)
{
  constexpr double longestBar = 100.0;
  double           length = GetPowerOfTenUpTo(longestBar / pixelsPerUnit);
  for (const double factor : { 5.0, 2.0 })
  {
    if (factor * length * pixelsPerUnit <= longestBar)
    {
      length *= factor;
      break;
    }
  }
  const auto width = static_cast<unsigned int>(std::lround(length * pixelsPerUnit));
  canvas.FillRectangle({ x, y + TextHeight / 2 - 1, width, 3 }, PreviewTextColor);
  canvas.FillRectangle({ x, y, 2, TextHeight }, PreviewTextColor);
  canvas.FillRectangle({ x + width - 2, y, 2, TextHeight }, PreviewTextColor);
  canvas.DrawText(x + width + TextAdvance, y, FormatNumber(length) + " " + geometry.DescribeUnit(), PreviewTextColor);
}

} // end namespace medialvoxel
