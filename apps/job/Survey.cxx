// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Survey.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

using WordType = itk::MedialVoxelBits::WordType;

constexpr unsigned int BinsPerVoxel = 64;

double
GetBinWidth(const itk::MedialVoxelGrid & grid)
{
  double smallest = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double spacing = grid.GetSpacing()[axis];
    if (grid.IsActive(axis) && (smallest == 0.0 || spacing < smallest))
    {
      smallest = spacing;
    }
  }
  return (smallest > 0.0 ? smallest : 1.0) / BinsPerVoxel;
}

unsigned int
GetStepFor(std::uint64_t voxels, std::uint64_t fullyMeasuredVoxels)
{
  unsigned int step = 1;
  while (voxels / step > fullyMeasuredVoxels && step < 64)
  {
    step *= 2;
  }
  return step;
}

/** Which cells of a row are measured: x = this number, modulo the step, in a different place in each row so that no
 * wall is missed whatever its direction. */
std::uint64_t
GetPhase(const itk::MedialVoxelIndex & cell, unsigned int step)
{
  std::uint64_t mixed = static_cast<std::uint64_t>(cell[1]) * 0x9E3779B97F4A7C15u;
  mixed ^= static_cast<std::uint64_t>(cell[2]) * 0xC2B2AE3D27D4EB4Fu;
  return (mixed ^ (mixed >> 29)) * 0x165667B19E3779F9u >> 40 & (step - 1);
}

/** Bits of the cells of a row that are measured. */
WordType
GetMeasuredCells(const itk::MedialVoxelCellRow & row, unsigned int step)
{
  WordType medial = row.byBound | row.byGeodesic;
  if (step > 1 && medial != 0)
  {
    WordType            pattern = 0;
    const std::uint64_t shift = (GetPhase(row.first, step) - static_cast<std::uint64_t>(row.first[0])) & (step - 1);
    for (unsigned int bit = static_cast<unsigned int>(shift); bit < 64; bit += step)
    {
      pattern |= WordType{ 1 } << bit;
    }
    medial &= pattern;
  }
  return medial;
}

template <typename TFunction>
void
ForEachBit(WordType bits, TFunction && function)
{
  for (; bits != 0; bits &= bits - 1)
  {
    function(itk::MedialVoxelLowestBit(bits));
  }
}

std::array<unsigned int, 2>
GetProjectionSizeFor(const VolumeGeometry & geometry)
{
  if (geometry.GetDimension() != 3)
  {
    return { 0, 0 };
  }
  const Rectangle area = ArrangePreview(geometry).areas.back();
  return { static_cast<unsigned int>(std::min<std::uint64_t>(area.width, geometry.size[0])),
           static_cast<unsigned int>(std::min<std::uint64_t>(area.height, geometry.size[1])) };
}

std::uint64_t
GetNumberOfBlocks(const VolumeGeometry & geometry)
{
  std::uint64_t blocks = 1;
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    blocks *= (geometry.size[axis] >> (axis == 0 ? Survey::BlockShiftX : Survey::BlockShiftYZ)) + 1;
  }
  return blocks;
}

} // namespace

/** What one tile adds. Columns run along the last axis; those of a word of cells are bits, the first one bit 0. */
struct Survey::TileSums
{
  struct ColumnWord
  {
    itk::MedialVoxelCellRow seen; // any of the cells of a column
    std::uint32_t           medialCells[64];
  };
  std::vector<std::size_t>              bins;
  std::array<std::vector<SliceSums>, 3> slices;
  std::vector<ColumnWord>               columns;
};

Survey::Survey(const VolumeGeometry & geometry, const itk::MedialVoxelGrid & grid, const SurveySettings & settings)
  : m_Grid(grid)
  , m_Kernel(grid)
  , m_Settings(settings)
  , m_Step(GetStepFor(geometry.GetNumberOfVoxels(), settings.fullyMeasuredVoxels))
  , m_Pending(GetBinWidth(grid))
  , m_Total(GetBinWidth(grid))
{
  m_Settings.picture = settings.picture && geometry.GetDimension() == 3;
  if (!m_Settings.picture)
  {
    return;
  }
  m_ProjectionSize = GetProjectionSizeFor(geometry);
  for (unsigned int axis = 0; axis < 2; ++axis)
  {
    m_PixelOf[axis].resize(geometry.size[axis]);
    for (unsigned int pixel = 0; pixel < m_ProjectionSize[axis]; ++pixel)
    {
      const auto covered = GetCoveredVoxels(pixel, m_ProjectionSize[axis], geometry.size[axis]);
      std::fill(m_PixelOf[axis].begin() + static_cast<std::ptrdiff_t>(covered[0]),
                m_PixelOf[axis].begin() + static_cast<std::ptrdiff_t>(covered[1]),
                pixel);
    }
  }
  m_Blocks.resize(GetNumberOfBlocks(geometry), false);
  this->Resize(m_Pending);
  this->Resize(m_Total);
}

void
Survey::Resize(Sums & sums) const
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    sums.slices[axis].assign(static_cast<std::size_t>(m_Grid.GetSize()[axis]), {});
  }
  sums.projection.assign(std::size_t{ m_ProjectionSize[0] } * m_ProjectionSize[1], {});
}

void
Survey::Begin()
{
  m_Pending.thickness.Clear();
  if (m_Settings.picture)
  {
    this->Resize(m_Pending);
  }
}

itk::MedialVoxelBox
Survey::Observe(const itk::MedialVoxelClassifiedTile & tile)
{
  const itk::MedialVoxelBox & box = tile.box;
  const std::int64_t          firstWord = box.lower[0] >> 6;
  const std::int64_t          wordsPerRow = ((box.upper[0] - 1) >> 6) - firstWord + 1;
  TileSums                    sums;
  if (m_Settings.picture)
  {
    sums.columns.resize(static_cast<std::size_t>(wordsPerRow * box.Extent(1)));
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sums.slices[axis].resize(static_cast<std::size_t>(box.Extent(axis)));
    }
  }
  for (const itk::MedialVoxelCellRow & row : tile.rows)
  {
    this->MeasureRow(tile, row, sums);
    if (m_Settings.picture)
    {
      const std::int64_t     word = (row.first[0] >> 6) - firstWord;
      TileSums::ColumnWord & columns =
        sums.columns[static_cast<std::size_t>((row.first[1] - box.lower[1]) * wordsPerRow + word)];
      columns.seen.first = row.first;
      columns.seen.candidates |= row.candidates;
      columns.seen.byBound |= row.byBound;
      columns.seen.byGeodesic |= row.byGeodesic;
      ForEachBit(row.byBound | row.byGeodesic, [&](int x) { ++columns.medialCells[x]; });
    }
  }

  const std::lock_guard<std::mutex> lock(m_Mutex);
  for (const std::size_t bin : sums.bins)
  {
    m_Pending.thickness.Add(bin);
  }
  if (m_Settings.picture)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (std::size_t i = 0; i < sums.slices[axis].size(); ++i)
      {
        SliceSums & slice = m_Pending.slices[axis][static_cast<std::size_t>(box.lower[axis]) + i];
        slice.score += sums.slices[axis][i].score;
        slice.cells += sums.slices[axis][i].cells;
      }
    }
    this->AddProjection(sums);
    std::for_each(tile.rows.begin(), tile.rows.end(), [this](const auto & row) { this->MarkBlock(row); });
  }
  return {};
}

/** Thickness of the walls at the measured cells of a row, and what they count for the slices. */
void
Survey::MeasureRow(const itk::MedialVoxelClassifiedTile & tile,
                   const itk::MedialVoxelCellRow &        row,
                   TileSums &                             sums) const
{
  ForEachBit(GetMeasuredCells(row, m_Step), [&](int x) {
    const itk::MedialVoxelIndex cell{ { row.first[0] + x, row.first[1], row.first[2] } };
    itk::MedialVoxelWallPoints  wall;
    if (!tile.classifier.GetWallPoints(tile.features, cell, wall))
    {
      return;
    }
    if (m_Settings.thickness)
    {
      sums.bins.push_back(m_Pending.thickness.GetBin(m_Kernel.Measure(*tile.window.object, wall)));
    }
    if (m_Settings.picture)
    {
      unsigned int across = 0;
      double       longest = -1.0;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double length = std::abs(static_cast<double>(wall.b[axis] - wall.a[axis])) * m_Grid.GetSpacing()[axis];
        across = length > longest ? axis : across;
        longest = std::max(longest, length);
      }
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        SliceSums & slice = sums.slices[axis][static_cast<std::size_t>(cell[axis] - tile.box.lower[axis])];
        slice.score += axis == across ? -1 : 2;
        ++slice.cells;
      }
    }
  });
}

void
Survey::AddProjection(const TileSums & sums)
{
  for (const TileSums::ColumnWord & columns : sums.columns)
  {
    const itk::MedialVoxelCellRow & seen = columns.seen;
    const unsigned int              row = m_PixelOf[1][static_cast<std::size_t>(seen.first[1])];
    ForEachBit(seen.candidates, [&](int x) {
      const WordType     bit = WordType{ 1 } << x;
      const std::uint8_t label = (seen.byGeodesic & bit) != 0 ? itk::MedialVoxelLabel::MedialByGeodesic
                                 : (seen.byBound & bit) != 0  ? itk::MedialVoxelLabel::MedialByBound
                                                              : itk::MedialVoxelLabel::NonMedial;
      const unsigned int column = m_PixelOf[0][static_cast<std::size_t>(seen.first[0] + x)];
      ProjectedPixel &   pixel = m_Pending.projection[std::size_t{ row } * m_ProjectionSize[0] + column];
      pixel.label = std::max(pixel.label, label);
      pixel.medialCells += columns.medialCells[x];
    });
  }
}

void
Survey::Commit()
{
  m_Total.thickness.Add(m_Pending.thickness);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = 0; i < m_Pending.slices[axis].size(); ++i)
    {
      m_Total.slices[axis][i].score += m_Pending.slices[axis][i].score;
      m_Total.slices[axis][i].cells += m_Pending.slices[axis][i].cells;
    }
  }
  for (std::size_t i = 0; i < m_Pending.projection.size(); ++i)
  {
    const ProjectedPixel & pending = m_Pending.projection[i];
    ProjectedPixel &       total = m_Total.projection[i];
    total.label = std::max(total.label, pending.label);
    total.medialCells += pending.medialCells;
  }
}

std::uint64_t
Survey::GetBestSlice(unsigned int axis) const
{
  // Near the faces of the image, outside of which nothing is known, the sheets are not typical.
  const std::vector<SliceSums> & slices = m_Total.slices[axis];
  const std::size_t              size = slices.size();
  const std::size_t              margin = size / 20;
  std::size_t                    best = size / 2;
  for (std::size_t index = margin; index < size - margin; ++index)
  {
    const bool isFirst = slices[best].cells == 0;
    if (slices[index].cells > 0 && (isFirst || slices[index].score > slices[best].score))
    {
      best = index;
    }
  }
  return best;
}

std::size_t
Survey::GetBlock(std::uint64_t x, std::uint64_t y, std::uint64_t z) const
{
  const std::uint64_t blocksX = (static_cast<std::uint64_t>(m_Grid.GetSize()[0]) >> BlockShiftX) + 1;
  const std::uint64_t blocksY = (static_cast<std::uint64_t>(m_Grid.GetSize()[1]) >> BlockShiftYZ) + 1;
  return ((z >> BlockShiftYZ) * blocksY + (y >> BlockShiftYZ)) * blocksX + (x >> BlockShiftX);
}

/** The cells of a row share a block: rows do not cross multiples of 64. */
void
Survey::MarkBlock(const itk::MedialVoxelCellRow & row)
{
  m_Blocks[this->GetBlock(static_cast<std::uint64_t>(row.first[0]),
                          static_cast<std::uint64_t>(row.first[1]),
                          static_cast<std::uint64_t>(row.first[2]))] = true;
}

bool
Survey::MayHaveLabels(std::uint64_t x, std::uint64_t y, std::uint64_t z) const
{
  return m_Blocks[this->GetBlock(x, y, z)];
}

std::uint64_t
Survey::GetBytes(const VolumeGeometry & geometry, const SurveySettings & settings)
{
  // A histogram of walls as thick as the volume, and one that is copied as it grows.
  constexpr std::uint64_t histograms = 4 * sizeof(std::uint64_t) * BinsPerVoxel;
  std::uint64_t           longest = 0;
  std::uint64_t           slices = 0;
  for (const std::uint64_t size : geometry.size)
  {
    longest = std::max(longest, size);
    slices += size;
  }
  std::uint64_t bytes = settings.thickness ? histograms * std::min<std::uint64_t>(longest, 1024) : 0;
  if (settings.picture)
  {
    const auto              size = GetProjectionSizeFor(geometry);
    constexpr std::uint64_t bitsPerByte = 8;
    bytes += 2 * (std::uint64_t{ size[0] } * size[1] * sizeof(ProjectedPixel) + slices * sizeof(SliceSums)) +
             slices * sizeof(unsigned int) + GetNumberOfBlocks(geometry) / bitsPerByte;
  }
  return bytes;
}

} // end namespace medialvoxel
