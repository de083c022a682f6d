// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Preview.h"

#include "PreviewCanvas.h"

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

constexpr double   LongestSide = 1600.0;
constexpr double   LargestVoxel = 8.0; // pixels
constexpr unsigned Gap = 14;

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

/** Labels read at a time to pick those of one column. */
constexpr std::uint64_t BytesPerRead = std::uint64_t{ 1 } << 20;

/** Reads the label of one column in the rows of a slice that have labels. Asking the system for each row would take
 * longer than copying what lies between. */
void
ReadColumn(const OutputVolume &   volume,
           const VolumeGeometry & geometry,
           const SliceScores &    scores,
           std::uint64_t          z,
           std::uint64_t          column,
           std::uint8_t *         labels)
{
  const std::uint64_t       sizeX = geometry.size[0];
  const std::uint64_t       sizeY = geometry.size[1];
  const std::uint64_t       rowsPerRead = std::clamp<std::uint64_t>(BytesPerRead / sizeX, 1, sizeY);
  std::vector<std::uint8_t> rows(rowsPerRead * sizeX);
  for (std::uint64_t y = 0; y < sizeY; ++y)
  {
    std::uint64_t count = 0;
    while (count < std::min(rowsPerRead, sizeY - y) && scores.HasLabels(y + count, z))
    {
      ++count;
    }
    if (count == 0)
    {
      continue;
    }
    volume.Read((z * sizeY + y) * sizeX, count * sizeX, rows.data());
    for (std::uint64_t row = 0; row < count; ++row)
    {
      labels[y + row] = rows[row * sizeX + column];
    }
    y += count - 1;
  }
}

/** Rows without labels are not read, unless the view consists of rows that follow each other. */
LabelSlice
ReadSlice(const OutputVolume & volume, const VolumeGeometry & geometry, const SliceScores & scores, const View & view)
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
      ReadColumn(volume, geometry, scores, z, view.index, &slice.labels[z * geometry.size[1]]);
    }
    else if (scores.HasLabels(view.index, z))
    {
      volume.Read(z * perSlice + view.index * sizeX, sizeX, &slice.labels[z * sizeX]);
    }
  }
  return slice;
}

/** First and last + 1 of the voxels that a pixel covers, at least the one at its middle. */
std::array<std::uint64_t, 2>
GetCovered(unsigned int pixel, unsigned int numberOfPixels, std::uint64_t numberOfVoxels)
{
  const double scale = static_cast<double>(numberOfVoxels) / numberOfPixels;
  if (scale <= 1.0)
  {
    const auto middle = static_cast<std::uint64_t>((pixel + 0.5) * scale);
    return { middle, middle + 1 };
  }
  const auto first = static_cast<std::uint64_t>(pixel * scale);
  const auto end = static_cast<std::uint64_t>((pixel + 1) * scale);
  return { first, std::min(std::max(end, first + 1), numberOfVoxels) };
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
    const auto rows = GetCovered(upwards ? area.height - 1 - row : row, area.height, slice.height);
    for (unsigned int column = 0; column < area.width; ++column)
    {
      const auto columns = GetCovered(column, area.width, slice.width);
      canvas.SetPixel(area.x + column, area.y + row, GetColor(slice, columns, rows));
    }
  }
  canvas.DrawFrame(area, FrameColor);
}

constexpr unsigned CaptionHeight = TextHeight + 6;
constexpr unsigned LegendHeight = TextHeight;
constexpr unsigned LegendWidth = 44 * TextAdvance;

/** Where the views lie in the picture, and how large it is. */
struct Layout
{
  std::vector<Rectangle> areas;
  unsigned int           width{ 0 };
  unsigned int           height{ 0 };
};

/** The view along z at the left; those along y and x below each other at its right when they are low, otherwise below
 * it and at the right of that. Sizes are those of the axes in pixels. */
Layout
ArrangeViews(const std::vector<unsigned int> & sizes)
{
  const unsigned int left = Gap;
  const unsigned int top = Gap + CaptionHeight;
  Layout             layout;
  layout.areas.push_back({ left, top, sizes[0], sizes[1] });
  if (sizes.size() == 3)
  {
    const unsigned int right = left + sizes[0] + Gap;
    const bool         sideBySide = sizes[2] < sizes[1];
    const unsigned int below = top + (sideBySide ? sizes[2] : sizes[1]) + Gap + CaptionHeight;
    layout.areas.push_back({ sideBySide ? right : left, sideBySide ? top : below, sizes[0], sizes[2] });
    layout.areas.push_back({ right, below, sizes[1], sizes[2] });
  }
  for (const Rectangle & area : layout.areas)
  {
    layout.width = std::max(layout.width, area.x + area.width + Gap);
    layout.height = std::max(layout.height, area.y + area.height + Gap);
  }
  layout.width = std::max(layout.width, LegendWidth + 2 * Gap);
  layout.height += LegendHeight + Gap;
  return layout;
}

/** Pixels along each axis: one scale for all of them, whole pixels per voxel where they fit. */
std::vector<unsigned int>
GetSizes(const VolumeGeometry & geometry)
{
  const double smallest = *std::min_element(geometry.spacing.begin(), geometry.spacing.end());
  const auto   scale = [&](double pixelsPerVoxel) {
    std::vector<unsigned int> sizes;
    for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
    {
      const double voxels = static_cast<double>(geometry.size[axis]) * geometry.spacing[axis] / smallest;
      sizes.push_back(static_cast<unsigned int>(std::clamp(std::round(voxels * pixelsPerVoxel), 1.0, LongestSide)));
    }
    return sizes;
  };
  double pixelsPerVoxel = LargestVoxel;
  while (pixelsPerVoxel > 1.0)
  {
    const Layout layout = ArrangeViews(scale(pixelsPerVoxel));
    if (std::max(layout.width, layout.height) <= LongestSide)
    {
      return scale(pixelsPerVoxel);
    }
    pixelsPerVoxel -= 1.0;
  }
  double longest = 0.0;
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    longest = std::max(longest, static_cast<double>(geometry.size[axis]) * geometry.spacing[axis] / smallest);
  }
  // Two views lie beside each other at most.
  return scale(std::min(1.0, 0.5 * LongestSide / longest));
}

void
DrawView(Canvas &               canvas,
         const OutputVolume &   labels,
         const VolumeGeometry & geometry,
         const SliceScores &    scores,
         const View &           view,
         const Rectangle &      area)
{
  DrawSlice(canvas, ReadSlice(labels, geometry, scores, view), view.upwards, area);
  if (geometry.GetDimension() == 3)
  {
    const std::string caption = std::string(1, "XYZ"[view.normal]) + " = " + std::to_string(view.index);
    canvas.DrawText(area.x, area.y - TextHeight - 3, caption, TextColor);
  }
}

void
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
}

/** Along z with y downwards; along y and x with z upwards, as a part stands and a patient sits. */
std::vector<View>
ChooseViews(const VolumeGeometry & geometry, const SliceScores & scores)
{
  if (geometry.GetDimension() == 2)
  {
    return { { 0, 1, 2, 0, false } };
  }
  return { { 0, 1, 2, scores.GetBestSlice(2), false },
           { 0, 2, 1, scores.GetBestSlice(1), true },
           { 1, 2, 0, scores.GetBestSlice(0), true } };
}

bool
IsMedial(std::uint8_t label)
{
  return label >= itk::MedialVoxelLabel::MedialByBound;
}

} // namespace

/** A row of labels and its predecessors along y and z, null at the first ones. */
struct SliceScores::Rows
{
  const std::uint8_t * row;
  const std::uint8_t * previousAlongY;
  const std::uint8_t * previousAlongZ;
};

SliceScores::SliceScores(const VolumeGeometry & geometry)
  : m_Geometry(geometry)
{
  for (const std::uint64_t size : geometry.size)
  {
    m_Scores.emplace_back(size, 0);
    m_Counts.emplace_back(size, 0);
  }
  m_HasLabels.resize(geometry.GetNumberOfVoxels() / geometry.size.front(), false);
}

void
SliceScores::Add(std::uint64_t firstSlice, std::uint64_t numberOfSlices, const std::uint8_t * labels)
{
  if (m_Geometry.GetDimension() == 2)
  {
    return;
  }
  const std::uint64_t  rowLength = m_Geometry.size[0];
  const std::uint64_t  sliceLength = m_Geometry.GetVoxelsPerSlice();
  const std::uint8_t * previousSlice = m_LastSlice.empty() ? nullptr : m_LastSlice.data();
  for (std::uint64_t z = firstSlice; z < firstSlice + numberOfSlices; ++z)
  {
    for (std::uint64_t y = 0; y < m_Geometry.size[1]; ++y)
    {
      const std::uint64_t offset = y * rowLength;
      this->AddRow({ labels + offset,
                     y > 0 ? labels + offset - rowLength : nullptr,
                     previousSlice ? previousSlice + offset : nullptr },
                   y,
                   z);
    }
    previousSlice = labels;
    labels += sliceLength;
  }
  m_LastSlice.assign(labels - sliceLength, labels);
}

void
SliceScores::AddEmpty()
{
  // The slice after one without labels is like the first one.
  m_LastSlice.clear();
}

/** Medial labels are the ones with the second bit set; blocks of cells without are passed over at once. */
void
SliceScores::AddRow(const Rows & rows, std::uint64_t y, std::uint64_t z)
{
  static_assert((itk::MedialVoxelLabel::MedialByBound & 2) != 0 && (itk::MedialVoxelLabel::MedialByGeodesic & 2) != 0 &&
                (itk::MedialVoxelLabel::NonMedial & 2) == 0);
  constexpr std::uint64_t cellsPerBlock = 64;
  const std::uint64_t     rowLength = m_Geometry.size[0];
  std::uint8_t            anyOfRow = 0;
  for (std::uint64_t begin = 0; begin < rowLength; begin += cellsPerBlock)
  {
    const std::uint64_t end = std::min(begin + cellsPerBlock, rowLength);
    std::uint8_t        any = 0;
    for (std::uint64_t x = begin; x < end; ++x)
    {
      any |= rows.row[x];
    }
    anyOfRow |= any;
    if ((any & 2) != 0)
    {
      this->AddCells(rows, begin, end, y, z);
    }
  }
  m_HasLabels[z * m_Geometry.size[1] + y] = anyOfRow != 0;
}

void
SliceScores::AddCells(const Rows & rows, std::uint64_t begin, std::uint64_t end, std::uint64_t y, std::uint64_t z)
{
  constexpr std::int64_t weight = 3;
  for (std::uint64_t x = begin; x < end; ++x)
  {
    if (!IsMedial(rows.row[x]))
    {
      continue;
    }
    const std::int64_t edgeAlongX = x == 0 || !IsMedial(rows.row[x - 1]);
    const std::int64_t edgeAlongY = !rows.previousAlongY || !IsMedial(rows.previousAlongY[x]);
    const std::int64_t edgeAlongZ = !rows.previousAlongZ || !IsMedial(rows.previousAlongZ[x]);
    m_Scores[0][x] += weight * (edgeAlongY + edgeAlongZ) - 1;
    m_Scores[1][y] += weight * (edgeAlongX + edgeAlongZ) - 1;
    m_Scores[2][z] += weight * (edgeAlongX + edgeAlongY) - 1;
    ++m_Counts[0][x];
    ++m_Counts[1][y];
    ++m_Counts[2][z];
  }
}

std::uint64_t
SliceScores::GetBestSlice(unsigned int axis) const
{
  // Near the faces of the image, outside of which nothing is known, the sheets are not typical.
  const std::uint64_t size = m_Scores[axis].size();
  const std::uint64_t margin = size / 20;
  std::uint64_t       best = size / 2;
  for (std::uint64_t index = margin; index < size - margin; ++index)
  {
    const bool isFirst = m_Counts[axis][best] == 0;
    if (m_Counts[axis][index] > 0 && (isFirst || m_Scores[axis][index] > m_Scores[axis][best]))
    {
      best = index;
    }
  }
  return best;
}

std::uint64_t
GetPreviewBytes(const VolumeGeometry & geometry)
{
  // The picture with its copy for the writer, the slice before the next one, one view, what is read for it, and a bit
  // for each row.
  constexpr std::uint64_t bytesPerPixel = 2 * 3;
  constexpr std::uint64_t bitsPerByte = 8;
  const Layout            layout = ArrangeViews(GetSizes(geometry));
  const std::uint64_t     voxels = geometry.GetNumberOfVoxels();
  const std::uint64_t     largestView =
    geometry.GetDimension() == 2 ? voxels : voxels / *std::min_element(geometry.size.begin(), geometry.size.end());
  return bytesPerPixel * layout.width * layout.height + geometry.GetVoxelsPerSlice() + largestView +
         std::min(voxels, std::max(BytesPerRead, geometry.size[0])) + voxels / geometry.size[0] / bitsPerByte;
}

void
WritePreview(const OutputVolume &   labels,
             const VolumeGeometry & geometry,
             const SliceScores &    scores,
             OutputFile &           file)
{
  const Layout            layout = ArrangeViews(GetSizes(geometry));
  const std::vector<View> views = ChooseViews(geometry, scores);
  Canvas                  canvas(layout.width, layout.height);
  for (size_t i = 0; i < views.size(); ++i)
  {
    DrawView(canvas, labels, geometry, scores, views[i], layout.areas[i]);
  }
  DrawLegend(canvas, Gap, layout.height - LegendHeight - Gap);
  canvas.WritePng(file);
}

} // end namespace medialvoxel
