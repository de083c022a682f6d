// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Preview.h"

#include "PreviewViews.h"

#include "itkMedialVoxelElementary.h"
#include "itkMedialVoxelParameters.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

constexpr Color ObjectColor{ 95, 95, 100 };
constexpr Color MedialColor{ 255, 45, 35 };
constexpr Color AddedColor{ 255, 200, 40 };

Color
GetColor(std::uint8_t label)
{
  return label == itk::MedialVoxelLabel::AddedForTopology ? AddedColor
         : label >= itk::MedialVoxelLabel::MedialByBound
           ? MedialColor
           : (label == itk::MedialVoxelLabel::NoObject ? PreviewBackgroundColor : ObjectColor);
}

/** A thin sheet must not vanish among the voxels that a pixel covers: any medial one colors it. */
Color
GetColor(const Slice<std::uint8_t> & slice, const CoveredArea & covered)
{
  std::uint8_t label = itk::MedialVoxelLabel::NoObject;
  ForEachCovered(covered, slice.width, [&](std::uint64_t at) { label = std::max(label, slice.values[at]); });
  return GetColor(label);
}

/** Brightness of a ray with so many medial cells: at least a third, full at the most that any ray has. */
Color
Dim(const Color & color, std::uint32_t medialCells, std::uint32_t most)
{
  using itk::MedialVoxelElementary::Logarithm;
  const double share = 0.33 + 0.67 * Logarithm(1.0 + medialCells) / Logarithm(1.0 + most);
  Color        dimmed = color;
  for (std::uint8_t & component : dimmed)
  {
    component = static_cast<std::uint8_t>(std::lround(component * share));
  }
  return dimmed;
}

void
DrawProjection(Canvas & canvas, const Survey & survey, const Rectangle & area)
{
  const Survey::Projection & pixels = survey.GetProjection();
  const auto &               size = survey.GetProjectionSize();
  std::uint32_t              most = 1;
  for (const Survey::ProjectedPixel & pixel : pixels)
  {
    most = std::max(most, pixel.medialCells);
  }
  DrawView(canvas, area, size[0], size[1], false, [&](const CoveredArea & covered) {
    const Survey::ProjectedPixel & pixel = pixels[covered.rows[0] * size[0] + covered.columns[0]];
    const Color                    color = GetColor(pixel.label);
    return color == MedialColor ? Dim(color, pixel.medialCells, most) : color;
  });
}

} // namespace

std::uint64_t
GetPreviewMemory(const VolumeGeometry & geometry)
{
  // The picture with a copy for the writer, the largest view, and the rows read for it.
  constexpr std::uint64_t bytesPerPixel = 2 * 3;
  constexpr std::uint64_t rowsPerRead = std::uint64_t{ 1 } << Survey::BlockShiftYZ;
  const PreviewLayout     layout = ArrangePreview(geometry);
  return bytesPerPixel * layout.width * layout.height + GetLargestView(geometry) + rowsPerRead * geometry.size[0];
}

Canvas
DrawPreview(const VoxelOutput & labels, const VolumeGeometry & geometry, const Survey & survey)
{
  const PreviewLayout     layout = ArrangePreview(geometry);
  const std::vector<View> views = ChooseViews(geometry, survey);
  const bool              isSolid = geometry.GetDimension() == 3;
  bool                    hasAdded = false;
  Canvas                  canvas(layout.width, layout.height);
  for (size_t i = 0; i < views.size(); ++i)
  {
    const auto slice = ReadSlice<std::uint8_t>(labels, geometry, survey, views[i]);
    hasAdded =
      hasAdded || std::find(slice.values.begin(), slice.values.end(), itk::MedialVoxelLabel::AddedForTopology) !=
                    slice.values.end();
    DrawView(canvas, layout.areas[i], slice.width, slice.height, views[i].upwards, [&](const CoveredArea & covered) {
      return GetColor(slice, covered);
    });
    if (isSolid)
    {
      DrawCaption(canvas, layout.areas[i], MakeCaption(views[i]));
    }
  }
  if (isSolid)
  {
    DrawProjection(canvas, survey, layout.areas.back());
    DrawCaption(canvas, layout.areas.back(), "Maximum along z");
  }
  const unsigned int y = layout.height - TextHeight - PreviewGap;
  unsigned int       x = DrawLegendEntry(canvas, PreviewGap, y, ObjectColor, "Object");
  x = DrawLegendEntry(canvas, x, y, MedialColor, "Medial sheet");
  x = hasAdded ? DrawLegendEntry(canvas, x, y, AddedColor, "Added for the topology") : x;
  DrawScaleBar(canvas, x, y, layout.pixelsPerUnit, geometry);
  return canvas;
}

} // end namespace medialvoxel
