// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPreviewViews_h
#define medialvoxelPreviewViews_h

#include "VoxelOutput.h"
#include "PreviewCanvas.h"
#include "PreviewLayout.h"
#include "Survey.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace medialvoxel
{

constexpr Color PreviewBackgroundColor{ 0, 0, 0 };
constexpr Color PreviewTextColor{ 200, 200, 205 };
constexpr Color PreviewFrameColor{ 60, 60, 65 };

/** Two axes of the volume as a picture, cut where a third one has the given index. */
struct View
{
  unsigned int  horizontal;
  unsigned int  vertical;
  unsigned int  normal;
  std::uint64_t index;
  bool          upwards; ///< the vertical axis points up
};

/** The slices that show most of the sheets: along z with y downwards; along y and x with z upwards, as a part stands
 * and a patient sits. A volume of two dimensions is one view. */
std::vector<View>
ChooseViews(const VolumeGeometry & geometry, const Survey & survey);

/** Voxels of the largest slice that a view can show. */
std::uint64_t
GetLargestView(const VolumeGeometry & geometry);

/** Values of one slice, the first axis of the picture fastest. */
template <typename TValue>
struct Slice
{
  std::uint64_t       width{ 0 };
  std::uint64_t       height{ 0 };
  std::vector<TValue> values;
};

/** Reads one column, in the blocks that may have labels. A call of the system for each row would take longer than
 * copying the rows between. */
template <typename TValue>
void
ReadColumn(const VoxelOutput &    volume,
           const VolumeGeometry & geometry,
           const Survey &         survey,
           std::uint64_t          z,
           std::uint64_t          column,
           TValue *               values)
{
  constexpr std::uint64_t rowsPerBlock = std::uint64_t{ 1 } << Survey::BlockShiftYZ;
  const std::uint64_t     sizeX = geometry.size[0];
  const std::uint64_t     sizeY = geometry.size[1];
  std::vector<TValue>     between((rowsPerBlock - 1) * sizeX + 1);
  for (std::uint64_t y = 0; y < sizeY; y += rowsPerBlock)
  {
    if (survey.MayHaveLabels(column, y, z))
    {
      const std::uint64_t rows = std::min(rowsPerBlock, sizeY - y);
      volume.Read((z * sizeY + y) * sizeX + column, (rows - 1) * sizeX + 1, between.data());
      for (std::uint64_t row = 0; row < rows; ++row)
      {
        values[y + row] = between[row * sizeX];
      }
    }
  }
}

template <typename TValue>
Slice<TValue>
ReadSlice(const VoxelOutput & volume, const VolumeGeometry & geometry, const Survey & survey, const View & view)
{
  Slice<TValue> slice;
  slice.width = geometry.size[view.horizontal];
  slice.height = geometry.size[view.vertical];
  slice.values.resize(slice.width * slice.height);
  if (volume.ReadPlane(view.normal, view.index, slice.values.data()))
  {
    return slice;
  }
  const std::uint64_t sizeX = geometry.size[0];
  const std::uint64_t perSlice = sizeX * geometry.size[1];
  if (view.normal == 2)
  {
    volume.Read(view.index * perSlice, perSlice, slice.values.data());
    return slice;
  }
  for (std::uint64_t z = 0; z < geometry.size[2]; ++z)
  {
    itk::MedialVoxelCheckAbort();
    if (view.normal == 0)
    {
      ReadColumn(volume, geometry, survey, z, view.index, &slice.values[z * geometry.size[1]]);
    }
    else
    {
      volume.Read(z * perSlice + view.index * sizeX, sizeX, &slice.values[z * sizeX]);
    }
  }
  return slice;
}

/** First and end of the values that a pixel covers, along both axes of a picture. */
struct CoveredArea
{
  std::array<std::uint64_t, 2> columns;
  std::array<std::uint64_t, 2> rows;
};

/** Fills an area with getColor(covered) of a picture of this many values, and draws a frame around it. */
template <typename TColor>
void
DrawView(Canvas &          canvas,
         const Rectangle & area,
         std::uint64_t     width,
         std::uint64_t     height,
         bool              upwards,
         TColor &&         getColor)
{
  using Range = std::array<std::uint64_t, 2>;
  std::vector<Range> columns(area.width);
  for (unsigned int column = 0; column < area.width; ++column)
  {
    columns[column] = GetCoveredVoxels(column, area.width, width);
  }
  std::vector<Color> colors(area.width);
  Range              last{};
  for (unsigned int row = 0; row < area.height; ++row)
  {
    itk::MedialVoxelCheckAbort();
    const Range rows = GetCoveredVoxels(upwards ? area.height - 1 - row : row, area.height, height);
    for (unsigned int column = 0; column < area.width; ++column)
    {
      // Pixels side by side often cover the same.
      if (rows != last)
      {
        const bool isSame = column > 0 && columns[column] == columns[column - 1];
        colors[column] = isSame ? colors[column - 1] : getColor(CoveredArea{ columns[column], rows });
      }
      canvas.SetPixel(area.x + column, area.y + row, colors[column]);
    }
    last = rows;
  }
  canvas.DrawFrame(area, PreviewFrameColor);
}

/** Calls function(offset) for the covered values of a picture. */
template <typename TFunction>
void
ForEachCovered(const CoveredArea & covered, std::uint64_t width, TFunction && function)
{
  for (std::uint64_t y = covered.rows[0]; y < covered.rows[1]; ++y)
  {
    for (std::uint64_t x = covered.columns[0]; x < covered.columns[1]; ++x)
    {
      function(y * width + x);
    }
  }
}

/** The axis that a view is across, and where. */
std::string
MakeCaption(const View & view);

/** Text above an area. */
void
DrawCaption(Canvas & canvas, const Rectangle & area, const std::string & text);

/** A colored square with a text behind it. Returns where the next one begins. */
unsigned int
DrawLegendEntry(Canvas & canvas, unsigned int x, unsigned int y, const Color & color, const std::string & text);

/** A bar of 1, 2 or 5 times a power of ten, in the units of the spacing, and its length behind it. */
void
DrawScaleBar(Canvas & canvas, unsigned int x, unsigned int y, double pixelsPerUnit, const VolumeGeometry & geometry);

} // end namespace medialvoxel

#endif
