// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ThicknessPreview.h"

#include "ColorMap.h"
#include "ColorRange.h"
#include "PreviewViews.h"
#include "Text.h"

#include "itkMedialVoxelParameters.h"

namespace medialvoxel
{
namespace
{

constexpr Color ObjectColor{ 70, 70, 74 };

/** Lengths as colors. */
class Scale
{
public:
  explicit Scale(const ColorRange & range)
    : m_Range(range)
  {}

  Color
  GetColor(double length) const
  {
    return GetMapColor((length - m_Range.low) / (m_Range.high - m_Range.low));
  }

  /** Draws a bar with the lengths of its ends, whose unit the scale bar behind it tells; returns where it ends. */
  unsigned int
  Draw(Canvas & canvas, unsigned int x, unsigned int y) const
  {
    constexpr unsigned int width = 128;
    const auto             write = [&](const std::string & text) {
      canvas.DrawText(x, y, text, PreviewTextColor);
      x += GetTextWidth(text) + TextAdvance;
    };
    write(FormatShort(m_Range.low));
    for (unsigned int i = 0; i < width; ++i)
    {
      canvas.FillRectangle({ x + i, y, 1, TextHeight }, GetMapColor(i / (width - 1.0)));
    }
    x += width + TextAdvance;
    write(FormatShort(m_Range.high));
    return x + TextAdvance;
  }

private:
  ColorRange m_Range;
};

void
DrawSlice(Canvas &                    canvas,
          const Rectangle &           area,
          bool                        upwards,
          const Slice<std::uint8_t> & labels,
          const Slice<float> &        thicknesses,
          const Scale &               scale)
{
  DrawView(canvas, area, labels.width, labels.height, upwards, [&](const CoveredArea & covered) {
    std::uint8_t label = 0;
    float        thickest = 0.0F;
    ForEachCovered(covered, labels.width, [&](std::uint64_t at) {
      label = std::max(label, labels.values[at]);
      thickest = std::max(thickest, thicknesses.values[at]);
    });
    if (thickest > 0.0F)
    {
      return scale.GetColor(static_cast<double>(thickest));
    }
    return label == itk::MedialVoxelLabel::NoObject ? PreviewBackgroundColor : ObjectColor;
  });
}

void
DrawProjection(Canvas & canvas, const Survey & survey, const Rectangle & area, const Scale & scale)
{
  const auto & size = survey.GetProjectionSize();
  DrawView(canvas, area, size[0], size[1], false, [&](const CoveredArea & covered) {
    const Survey::ProjectedPixel & pixel = survey.GetProjection()[covered.rows[0] * size[0] + covered.columns[0]];
    if (pixel.thickest > 0)
    {
      return scale.GetColor(pixel.thickest * survey.GetSums().GetAreas().GetBinWidth());
    }
    return pixel.label == itk::MedialVoxelLabel::NoObject ? PreviewBackgroundColor : ObjectColor;
  });
}

} // namespace

std::uint64_t
GetThicknessPreviewMemory(const VolumeGeometry & geometry)
{
  // Both pictures, a third one with a copy for the writer, the largest view, and the rows read for it.
  constexpr std::uint64_t bytesPerPixel = 6 * 3;
  constexpr std::uint64_t rowsPerRead = std::uint64_t{ 1 } << Survey::BlockShiftYZ;
  const PreviewLayout     layout = ArrangePreview(geometry);
  return bytesPerPixel * layout.width * layout.height +
         sizeof(float) * (GetLargestView(geometry) + rowsPerRead * geometry.size[0]);
}

Canvas
DrawThicknessPreview(const VoxelOutput &    labels,
                     const VoxelOutput &    thicknesses,
                     const VolumeGeometry & geometry,
                     const Survey &         survey,
                     const ColorRange &     colors)
{
  const PreviewLayout     layout = ArrangePreview(geometry);
  const std::vector<View> views = ChooseViews(geometry, survey);
  const bool              isSolid = geometry.GetDimension() == 3;
  const Scale             scale(colors);
  Canvas                  canvas(layout.width, layout.height);
  for (size_t i = 0; i < views.size(); ++i)
  {
    DrawSlice(canvas,
              layout.areas[i],
              views[i].upwards,
              ReadSlice<std::uint8_t>(labels, geometry, survey, views[i]),
              ReadSlice<float>(thicknesses, geometry, survey, views[i]),
              scale);
    if (isSolid)
    {
      DrawCaption(canvas, layout.areas[i], MakeCaption(views[i]));
    }
  }
  if (isSolid)
  {
    DrawProjection(canvas, survey, layout.areas.back(), scale);
    DrawCaption(canvas, layout.areas.back(), "Thickest along z");
  }
  const unsigned int y = layout.height - TextHeight - PreviewGap;
  const unsigned int x = DrawLegendEntry(canvas, PreviewGap, y, ObjectColor, "Object");
  DrawScaleBar(canvas, scale.Draw(canvas, x, y), y, layout.pixelsPerUnit, geometry);
  return canvas;
}

} // end namespace medialvoxel
