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
GetSmallestSpacing(const itk::MedialVoxelGrid & grid)
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
  return smallest > 0.0 ? smallest : 1.0;
}

double
GetBinWidth(const itk::MedialVoxelGrid & grid)
{
  return GetSmallestSpacing(grid) / BinsPerVoxel;
}

/** Area of the face of a voxel across the axis of the smallest spacing. */
double
GetLargestFace(const itk::MedialVoxelGrid & grid)
{
  double volume = 1.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    volume *= grid.IsActive(axis) ? grid.GetSpacing()[axis] : 1.0;
  }
  return volume / GetSmallestSpacing(grid);
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

/** Thicker than any. */
const PlaceCell NoWall{ 0, std::numeric_limits<float>::infinity() };

void
TakeThinner(PlaceCell & cell, const PlaceCell & other)
{
  cell = other.IsWorse(cell, PlaceKind::Thin) ? other : cell;
}

} // namespace

/** The sums of one tile. Columns run along the last axis. The columns of a word of cells are bits, the first one bit
 * 0. */
struct Survey::TileSums : public Workspace
{
  struct ColumnWord
  {
    itk::MedialVoxelCellRow seen; // any of the cells of a column
    std::uint32_t           medialCells[64];
    std::uint32_t           thickest[64]; // bin
  };
  /** Nothing, of a tile. Its memory is that of the tile before. */
  void
  Clear(const itk::MedialVoxelBox & box, bool withPicture)
  {
    firstWord = box.lower[0] >> 6;
    wordsPerRow = ((box.upper[0] - 1) >> 6) - firstWord + 1;
    lowerY = box.lower[1];
    walls.clear();
    thinnest = NoWall;
    if (withPicture)
    {
      columns.assign(static_cast<std::size_t>(wordsPerRow * box.Extent(1)), {});
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        slices[axis].assign(static_cast<std::size_t>(box.Extent(axis)), {});
      }
    }
  }

  ColumnWord &
  ColumnsAt(const itk::MedialVoxelIndex & cell)
  {
    return columns[static_cast<std::size_t>((cell[1] - lowerY) * wordsPerRow + ((cell[0] >> 6) - firstWord))];
  }

  std::int64_t                          firstWord{ 0 };
  std::int64_t                          wordsPerRow{ 0 };
  std::int64_t                          lowerY{ 0 };
  std::vector<itk::MedialVoxelWall>     walls; // that count
  PlaceCell                             thinnest;
  std::array<std::vector<SliceSums>, 3> slices;
  std::vector<ColumnWord>               columns;
};

Survey::Survey(const VolumeGeometry & geometry, const itk::MedialVoxelGrid & grid, const SurveySettings & settings)
  : m_Geometry(geometry)
  , m_Grid(grid)
  , m_Cells(grid.GetSize(), geometry.GetDimension())
  , m_Settings(settings)
  , m_Sample(geometry.GetNumberOfVoxels(), settings.fullyMeasuredVoxels)
  , m_AreaUnit(GetLargestFace(grid) / static_cast<double>(ThicknessSums::AreaUnitsPerFace))
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
Survey::Clear()
{
  m_Total.thickness.Clear();
  m_Total.thinnest = NoWall;
  if (m_Settings.picture)
  {
    this->Resize(m_Total);
    std::fill(m_Blocks.begin(), m_Blocks.end(), false);
  }
}

void
Survey::Begin()
{
  m_Pending.thickness.Clear();
  m_Pending.thinnest = NoWall;
  if (m_Settings.picture)
  {
    this->Resize(m_Pending);
  }
}

itk::MedialVoxelBits::WordType
Survey::SelectCells(const itk::MedialVoxelCellRow & row) const
{
  return m_Sample.Select(row);
}

auto
Survey::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return std::make_unique<TileSums>();
}

void
Survey::Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace)
{
  auto & sums = static_cast<TileSums &>(*workspace);
  sums.Clear(tile.box, m_Settings.picture);
  sums.walls.reserve(tile.walls.size());
  if (m_Settings.picture)
  {
    for (const itk::MedialVoxelCellRow & row : tile.rows)
    {
      TileSums::ColumnWord & columns = sums.ColumnsAt(row.first);
      columns.seen.first = row.first;
      columns.seen.candidates |= row.candidates;
      columns.seen.byBound |= row.byBound;
      columns.seen.byGeodesic |= row.byGeodesic;
      ForEachBit(row.byBound | row.byGeodesic, [&](int x) { ++columns.medialCells[x]; });
    }
  }
  itk::MedialVoxelForEachWall(tile.rows, tile.walls, [&](const auto & cell, const auto & wall) {
    if (m_Sample.Contains(cell))
    {
      this->AddWall(tile, cell, wall, sums);
    }
    if (m_Settings.picture && wall.IsMeasured())
    {
      TileSums::ColumnWord & columns = sums.ColumnsAt(cell);
      std::uint32_t &        thickest = columns.thickest[cell[0] - columns.seen.first[0]];
      thickest = std::max(thickest, static_cast<std::uint32_t>(this->GetBin(wall)));
    }
  });
  const std::lock_guard<std::mutex> lock(m_Mutex);
  this->AddSums(tile, sums);
}

std::size_t
Survey::GetBin(const itk::MedialVoxelWall & wall) const
{
  return m_Total.thickness.GetCells().GetBin(static_cast<double>(wall.thickness));
}

/** Weight of the wall at a cell in the sums and the slices. */
void
Survey::AddWall(const itk::MedialVoxelClassifiedTile & tile,
                const itk::MedialVoxelIndex &          cell,
                const itk::MedialVoxelWall &           wall,
                TileSums &                             sums) const
{
  sums.walls.push_back(wall);
  // Only a cell that could be the thinnest wall gets a key.
  if (wall.IsMeasured() && wall.thickness <= sums.thinnest.thickness)
  {
    PlaceCell found{ m_Cells.GetKey(cell), wall.thickness };
    if (found.IsWorse(sums.thinnest, PlaceKind::Thin))
    {
      found.uncertainty = wall.uncertainty;
      TakeSides(found, tile, cell);
      sums.thinnest = found;
    }
  }
  if (m_Settings.picture)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      SliceSums & slice = sums.slices[axis][static_cast<std::size_t>(cell[axis] - tile.box.lower[axis])];
      slice.score += axis == wall.axis ? -1 : 2;
      ++slice.cells;
    }
  }
}

void
Survey::AddSums(const itk::MedialVoxelClassifiedTile & tile, const TileSums & sums)
{
  for (const itk::MedialVoxelWall & wall : sums.walls)
  {
    m_Pending.thickness.AddWall(wall, m_AreaUnit);
  }
  TakeThinner(m_Pending.thinnest, sums.thinnest);
  if (m_Settings.picture)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (std::size_t i = 0; i < sums.slices[axis].size(); ++i)
      {
        SliceSums & slice = m_Pending.slices[axis][static_cast<std::size_t>(tile.box.lower[axis]) + i];
        slice.score += sums.slices[axis][i].score;
        slice.cells += sums.slices[axis][i].cells;
      }
    }
    this->AddProjection(sums);
    std::for_each(tile.rows.begin(), tile.rows.end(), [this](const auto & row) { this->MarkBlock(row); });
  }
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
      pixel.thickest = std::max(pixel.thickest, columns.thickest[x]);
    });
  }
}

void
Survey::Commit()
{
  this->AddToTotal(m_Pending);
}

void
Survey::AddToTotal(const Sums & sums)
{
  m_Total.thickness.Add(sums.thickness);
  TakeThinner(m_Total.thinnest, sums.thinnest);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = 0; i < sums.slices[axis].size(); ++i)
    {
      m_Total.slices[axis][i].score += sums.slices[axis][i].score;
      m_Total.slices[axis][i].cells += sums.slices[axis][i].cells;
    }
  }
  for (std::size_t i = 0; i < sums.projection.size(); ++i)
  {
    const ProjectedPixel & added = sums.projection[i];
    ProjectedPixel &       total = m_Total.projection[i];
    total.label = std::max(total.label, added.label);
    total.medialCells += added.medialCells;
    total.thickest = std::max(total.thickest, added.thickest);
  }
}

std::optional<WallLocation>
Survey::FindThinnest() const
{
  const bool isKnown = m_Total.thinnest.thickness < NoWall.thickness;
  return isKnown ? std::optional(LocateWall(m_Total.thinnest, m_Cells, m_Geometry)) : std::nullopt;
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

ProductFootprint
Survey::GetFootprint(const VolumeGeometry & geometry, const SurveySettings & settings)
{
  // Histograms of walls as thick as the volume, and two that are copied as they grow.
  constexpr std::uint64_t histograms = 8 * sizeof(std::uint64_t) * BinsPerVoxel;
  std::uint64_t           longest = 0;
  std::uint64_t           slices = 0;
  for (const std::uint64_t size : geometry.size)
  {
    longest = std::max(longest, size);
    slices += size;
  }
  std::uint64_t bytes = histograms * std::min<std::uint64_t>(longest, 1024);
  if (settings.picture)
  {
    const auto              size = GetProjectionSizeFor(geometry);
    constexpr std::uint64_t bitsPerByte = 8;
    bytes += 2 * (std::uint64_t{ size[0] } * size[1] * sizeof(ProjectedPixel) + slices * sizeof(SliceSums)) +
             slices * sizeof(unsigned int) + GetNumberOfBlocks(geometry) / bitsPerByte;
  }
  return { bytes, bytes, PerVoxelOfTile };
}

} // end namespace medialvoxel
