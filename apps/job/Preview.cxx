// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Preview.h"

#include "PreviewLayout.h"
#include "Text.h"

#include "itkMedialVoxelParameters.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace medialvoxel
{
namespace
{

constexpr Color BackgroundColor{ 0, 0, 0 };
constexpr Color ObjectColor{ 95, 95, 100 };
constexpr Color BoundColor{ 255, 255, 255 };
constexpr Color GeodesicColor{ 255, 45, 35 };
constexpr Color TextColor{ 200, 200, 205 };
constexpr Color FrameColor{ 60, 60, 65 };

/** Labels of one slice, the first axis of the picture fastest. */
struct LabelSlice
{
  std::uint64_t             width{ 0 };
  std::uint64_t             height{ 0 };
  std::vector<std::uint8_t> labels;
};

/** Two axes of the volume as a picture, cut where a third one has the given index. */
struct View
{
  unsigned int  horizontal;
  unsigned int  vertical;
  unsigned int  normal;
  std::uint64_t index;
  bool          upwards; // the vertical axis points up
};

/** Reads the labels of one column, in the blocks that may have some. Asking the system for each row would take longer
 * than copying what lies between. */
void
ReadColumn(const OutputVolume &   volume,
           const VolumeGeometry & geometry,
           const Survey &         survey,
           std::uint64_t          z,
           std::uint64_t          column,
           std::uint8_t *         labels)
{
  constexpr std::uint64_t   rowsPerBlock = std::uint64_t{ 1 } << Survey::BlockShiftYZ;
  const std::uint64_t       sizeX = geometry.size[0];
  const std::uint64_t       sizeY = geometry.size[1];
  std::vector<std::uint8_t> between((rowsPerBlock - 1) * sizeX + 1);
  for (std::uint64_t y = 0; y < sizeY; y += rowsPerBlock)
  {
    if (survey.MayHaveLabels(column, y, z))
    {
      const std::uint64_t rows = std::min(rowsPerBlock, sizeY - y);
      volume.Read((z * sizeY + y) * sizeX + column, (rows - 1) * sizeX + 1, between.data());
      for (std::uint64_t row = 0; row < rows; ++row)
      {
        labels[y + row] = between[row * sizeX];
      }
    }
  }
}

LabelSlice
ReadSlice(const OutputVolume & volume, const VolumeGeometry & geometry, const Survey & survey, const View & view)
{
  LabelSlice slice;
  slice.width = geometry.size[view.horizontal];
  slice.height = geometry.size[view.vertical];
  slice.labels.resize(slice.width * slice.height);
  const std::uint64_t sizeX = geometry.size[0];
  const std::uint64_t perSlice = sizeX * geometry.size[1];
  if (view.normal == 2)
  {
    volume.Read(view.index * perSlice, perSlice, slice.labels.data());
    return slice;
  }
  for (std::uint64_t z = 0; z < geometry.size[2]; ++z)
  {
    if (view.normal == 0)
    {
      ReadColumn(volume, geometry, survey, z, view.index, &slice.labels[z * geometry.size[1]]);
    }
    else
    {
      volume.Read(z * perSlice + view.index * sizeX, sizeX, &slice.labels[z * sizeX]);
    }
  }
  return slice;
}

/** A thin sheet must not vanish among the voxels that a pixel covers: any medial one colors it. */
Color
GetColor(const LabelSlice &                   slice,
         const std::array<std::uint64_t, 2> & columns,
         const std::array<std::uint64_t, 2> & rows)
{
  std::uint64_t bound = 0;
  std::uint64_t geodesic = 0;
  bool          isObject = false;
  for (std::uint64_t y = rows[0]; y < rows[1]; ++y)
  {
    for (std::uint64_t x = columns[0]; x < columns[1]; ++x)
    {
      const std::uint8_t label = slice.labels[y * slice.width + x];
      bound += label == itk::MedialVoxelLabel::MedialByBound ? 1 : 0;
      geodesic += label == itk::MedialVoxelLabel::MedialByGeodesic ? 1 : 0;
      isObject = isObject || label != itk::MedialVoxelLabel::NoObject;
    }
  }
  if (bound + geodesic > 0)
  {
    return geodesic >= bound ? GeodesicColor : BoundColor;
  }
  return isObject ? ObjectColor : BackgroundColor;
}

void
DrawSlice(Canvas & canvas, const LabelSlice & slice, bool upwards, const Rectangle & area)
{
  for (unsigned int row = 0; row < area.height; ++row)
  {
    const auto rows = GetCoveredVoxels(upwards ? area.height - 1 - row : row, area.height, slice.height);
    for (unsigned int column = 0; column < area.width; ++column)
    {
      const auto columns = GetCoveredVoxels(column, area.width, slice.width);
      canvas.SetPixel(area.x + column, area.y + row, GetColor(slice, columns, rows));
    }
  }
  canvas.DrawFrame(area, FrameColor);
}

/** Brightness of a ray with so many medial cells: at least a third, full at the most that any ray has. */
Color
Dim(const Color & color, std::uint32_t medialCells, std::uint32_t most)
{
  const double share = 0.33 + 0.67 * std::log1p(medialCells) / std::log1p(most);
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
  for (unsigned int row = 0; row < area.height; ++row)
  {
    const auto y = GetCoveredVoxels(row, area.height, size[1])[0];
    for (unsigned int column = 0; column < area.width; ++column)
    {
      const auto                     x = GetCoveredVoxels(column, area.width, size[0])[0];
      const Survey::ProjectedPixel & pixel = pixels[y * size[0] + x];
      Color color = pixel.label == itk::MedialVoxelLabel::NoObject ? BackgroundColor : ObjectColor;
      if (pixel.label >= itk::MedialVoxelLabel::MedialByBound)
      {
        const bool isGeodesic = pixel.label == itk::MedialVoxelLabel::MedialByGeodesic;
        color = Dim(isGeodesic ? GeodesicColor : BoundColor, pixel.medialCells, most);
      }
      canvas.SetPixel(area.x + column, area.y + row, color);
    }
  }
  canvas.DrawFrame(area, FrameColor);
}

void
DrawCaption(Canvas & canvas, const Rectangle & area, const std::string & text)
{
  canvas.DrawText(area.x, area.y - TextHeight - 3, text, TextColor);
}

/** Returns where the legend ends. */
unsigned int
DrawLegend(Canvas & canvas, unsigned int x, unsigned int y)
{
  const std::array<std::pair<Color, std::string>, 3> entries{
    { { ObjectColor, "OBJECT" }, { BoundColor, "MEDIAL BY BOUND" }, { GeodesicColor, "MEDIAL BY GEODESIC" } }
  };
  for (const auto & [color, text] : entries)
  {
    canvas.FillRectangle({ x, y, TextHeight, TextHeight }, color);
    canvas.DrawText(x + TextHeight + TextAdvance / 2, y, text, TextColor);
    x += TextHeight + (static_cast<unsigned int>(text.size()) + 2) * TextAdvance;
  }
  return x;
}

/** A bar of 1, 2 or 5 times a power of ten, in the units of the spacing, and its length behind it. */
void
DrawScaleBar(Canvas & canvas, unsigned int x, unsigned int y, double pixelsPerUnit)
{
  constexpr double longestBar = 100.0;
  double           length = std::pow(10.0, std::floor(std::log10(longestBar / pixelsPerUnit)));
  for (const double factor : { 5.0, 2.0 })
  {
    if (factor * length * pixelsPerUnit <= longestBar)
    {
      length *= factor;
      break;
    }
  }
  const auto width = static_cast<unsigned int>(std::lround(length * pixelsPerUnit));
  canvas.FillRectangle({ x, y + TextHeight / 2 - 1, width, 3 }, TextColor);
  canvas.FillRectangle({ x, y, 2, TextHeight }, TextColor);
  canvas.FillRectangle({ x + width - 2, y, 2, TextHeight }, TextColor);
  canvas.DrawText(x + width + TextAdvance, y, FormatNumber(length) + " UNITS", TextColor);
}

/** Along z with y downwards; along y and x with z upwards, as a part stands and a patient sits. */
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

} // namespace

std::uint64_t
GetPreviewBytes(const VolumeGeometry & geometry)
{
  // The picture with its copy for the writer, the largest view, and what is read for it.
  constexpr std::uint64_t bytesPerPixel = 2 * 3;
  constexpr std::uint64_t rowsPerRead = std::uint64_t{ 1 } << Survey::BlockShiftYZ;
  const PreviewLayout     layout = ArrangePreview(geometry);
  const std::uint64_t     voxels = geometry.GetNumberOfVoxels();
  const std::uint64_t     largestView =
    geometry.GetDimension() == 2 ? voxels : voxels / *std::min_element(geometry.size.begin(), geometry.size.end());
  return bytesPerPixel * layout.width * layout.height + largestView + rowsPerRead * geometry.size[0];
}

Canvas
DrawPreview(const OutputVolume & labels, const VolumeGeometry & geometry, const Survey & survey)
{
  const PreviewLayout     layout = ArrangePreview(geometry);
  const std::vector<View> views = ChooseViews(geometry, survey);
  const bool              isSolid = geometry.GetDimension() == 3;
  Canvas                  canvas(layout.width, layout.height);
  for (size_t i = 0; i < views.size(); ++i)
  {
    const View & view = views[i];
    DrawSlice(canvas, ReadSlice(labels, geometry, survey, view), view.upwards, layout.areas[i]);
    if (isSolid)
    {
      DrawCaption(canvas, layout.areas[i], std::string(1, "XYZ"[view.normal]) + " = " + std::to_string(view.index));
    }
  }
  if (isSolid)
  {
    DrawProjection(canvas, survey, layout.areas.back());
    DrawCaption(canvas, layout.areas.back(), "MAXIMUM ALONG Z");
  }
  const unsigned int y = layout.height - TextHeight - PreviewGap;
  DrawScaleBar(canvas, DrawLegend(canvas, PreviewGap, y), y, layout.pixelsPerUnit);
  return canvas;
}

} // end namespace medialvoxel
