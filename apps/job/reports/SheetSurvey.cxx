// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetSurvey.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

using WordType = itk::MedialVoxelBits::WordType;

void
AddWall(const itk::MedialVoxelWall & wall, double lengthUnit, SheetPoints::Sums & sums)
{
  if (wall.IsMeasured())
  {
    sums.thickness += static_cast<std::uint64_t>(std::llround(static_cast<double>(wall.thickness) / lengthUnit));
    ++sums.measured;
  }
  else
  {
    ++sums.unpaired;
  }
}

/** Bits of a row from \a bit on whose cells are in the block of its cell, which has the index \a x. */
WordType
GetBlockMask(std::int64_t x, int bit, unsigned int level)
{
  constexpr unsigned int levelOfRow = 6; // rows do not cross multiples of 64
  const unsigned int     shift = std::min(level, levelOfRow);
  const std::int64_t     end = bit + (((x >> shift) + 1) << shift) - x;
  const WordType         from = ~WordType{ 0 } << bit;
  return end < itk::MedialVoxelBits::BitsPerWord ? from & ~(~WordType{ 0 } << end) : from;
}

/** Sums of some cells of a row, without walls. */
SheetPoints::Sums
SumCells(const itk::MedialVoxelCellRow & row, WordType cells)
{
  SheetPoints::Sums sums;
  sums.cells = static_cast<std::uint64_t>(itk::MedialVoxelPopulationCount(cells));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    sums.index[axis] = sums.cells * static_cast<std::uint64_t>(row.first[axis]);
  }
  for (; cells != 0; cells &= cells - 1)
  {
    sums.index[0] += static_cast<std::uint64_t>(itk::MedialVoxelLowestBit(cells));
  }
  return sums;
}

/** The thickness up to which a cell is medial, in a unit; the last digits of 32 bits are rounded up. */
std::uint64_t
GetImportance(const float importance, const double lengthUnit)
{
  const double thickness =
    static_cast<double>(importance) * (1.0 + 1e-6) / itk::MedialVoxelParameters::EpsilonFromThickness(1.0);
  return static_cast<std::uint64_t>(thickness / lengthUnit);
}

/** Of some cells of a row, the largest one. */
std::uint64_t
FindImportance(const itk::MedialVoxelClassifiedTile & tile,
               const itk::MedialVoxelCellRow &        row,
               WordType                               cells,
               const double                           lengthUnit)
{
  float             largest = 0.0F;
  const std::size_t first = tile.box.OffsetOf(row.first);
  for (; cells != 0; cells &= cells - 1)
  {
    largest = std::max(largest, (*tile.importance)[first + static_cast<std::size_t>(itk::MedialVoxelLowestBit(cells))]);
  }
  return GetImportance(largest, lengthUnit);
}

/** Calls function(cell, sums) for the cells of each row that are in one block of the level; cell is the first of them.
 */
template <typename TFunction>
void
ForEachBlock(const itk::MedialVoxelClassifiedTile & tile,
             const CellSample &                     sample,
             double                                 lengthUnit,
             unsigned int                           level,
             TFunction &&                           function)
{
  auto wall = tile.walls.begin();
  for (const itk::MedialVoxelCellRow & row : tile.rows)
  {
    const WordType counting = sample.Select(row);
    for (WordType rest = row.byBound | row.byGeodesic; rest != 0;)
    {
      const int             first = itk::MedialVoxelLowestBit(rest);
      itk::MedialVoxelIndex cell = row.first;
      cell[0] += first;
      const WordType inBlock = rest & GetBlockMask(cell[0], first, level);
      rest &= ~inBlock;
      SheetPoints::Sums   sums = SumCells(row, inBlock);
      const std::uint64_t importance = tile.importance != nullptr ? FindImportance(tile, row, inBlock, lengthUnit) : 0;
      for (WordType measured = row.measured & inBlock; measured != 0; measured &= measured - 1, ++wall)
      {
        if ((measured & (~measured + 1) & counting) != 0)
        {
          AddWall(*wall, lengthUnit, sums);
        }
      }
      function(cell, sums, importance);
    }
  }
}

/** The sums of all blocks of a tile: a byte for each of its voxels at the least level. */
class BlocksOfTile
{
public:
  /** A tile has too many smaller blocks. */
  static constexpr unsigned int LeastLevel = 2;

  BlocksOfTile(const itk::MedialVoxelBox & tile, unsigned int level)
    : m_Level(level)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Blocks.lower[axis] = tile.lower[axis] >> level;
      m_Blocks.upper[axis] = ((tile.upper[axis] - 1) >> level) + 1;
    }
    m_Rows.resize(static_cast<std::size_t>(m_Blocks.NumberOfVoxels()));
  }

  void
  Add(const itk::MedialVoxelIndex & cell, const SheetPoints::Sums & sums, const std::uint64_t importance)
  {
    Row & row = m_Rows[m_Blocks.OffsetOf({ { cell[0] >> m_Level, cell[1] >> m_Level, cell[2] >> m_Level } })];
    row.sums.Add(sums);
    row.importance = std::max(row.importance, importance);
  }

  void
  AddTo(SheetPoints & points) const
  {
    auto row = m_Rows.begin();
    for (std::int64_t z = m_Blocks.lower[2]; z < m_Blocks.upper[2]; ++z)
    {
      for (std::int64_t y = m_Blocks.lower[1]; y < m_Blocks.upper[1]; ++y)
      {
        for (std::int64_t x = m_Blocks.lower[0]; x < m_Blocks.upper[0]; ++x, ++row)
        {
          if (row->sums.cells > 0)
          {
            points.Add({ { x << m_Level, y << m_Level, z << m_Level } }, row->sums, row->importance);
          }
        }
      }
    }
  }

private:
  struct Row
  {
    SheetPoints::Sums sums;
    std::uint64_t     importance{ 0 };
  };

  static_assert(sizeof(Row) <= SheetSurvey::PerVoxelOfTile << (3 * LeastLevel));

  unsigned int        m_Level;
  itk::MedialVoxelBox m_Blocks;
  std::vector<Row>    m_Rows; // x fastest
};

} // namespace

SheetSurvey::SheetSurvey(const VolumeGeometry & geometry, double lengthUnit, const CellSample & sample)
  : m_LengthUnit(lengthUnit)
  , m_Sample(sample)
  , m_Pending(geometry.size)
  , m_Total(geometry.size)
  , m_PendingPart(geometry.size)
  , m_Part(geometry.size)
{}

void
SheetSurvey::Begin()
{
  m_Pending.Clear(m_Total.GetLevel()); // all cells need it already
  m_PendingPart.Clear();
}

void
SheetSurvey::Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace *)
{
  PartBlocks part(m_PendingPart, tile.box);
  part.Count(tile);
  std::unique_lock<std::mutex> lock(m_Mutex);
  m_PendingPart.Add(part);
  const unsigned int level = m_Pending.GetLevel();
  if (level < BlocksOfTile::LeastLevel)
  {
    ForEachBlock(tile, m_Sample, m_LengthUnit, level, [this](const auto &... block) { m_Pending.Add(block...); });
    return;
  }
  lock.unlock();
  BlocksOfTile blocks(tile.box, level);
  ForEachBlock(tile, m_Sample, m_LengthUnit, level, [&blocks](const auto &... block) { blocks.Add(block...); });
  lock.lock();
  blocks.AddTo(m_Pending);
}

void
SheetSurvey::Commit()
{
  if (m_Total.GetNumberOfPoints() == 0)
  {
    std::swap(m_Total, m_Pending);
  }
  else
  {
    m_Total.Add(m_Pending);
  }
  m_Pending.Clear(m_Total.GetLevel());
  m_Part.Add(m_PendingPart);
}

void
SheetSurvey::Clear()
{
  m_Part.Clear();
  m_Total.Clear();
}

std::string
SheetSurvey::Save() const
{
  NumberWriter numbers;
  m_Total.Save(numbers);
  m_Part.Save(numbers);
  return numbers.Pack();
}

void
SheetSurvey::Merge(const std::string & bytes)
{
  constexpr std::uint64_t longestNumber = 10;
  NumberReader            numbers(bytes, longestNumber * (m_Total.GetMostNumbers() + m_Part.GetNumberOfBlocks()));
  m_Total.Merge(numbers);
  m_Part.Merge(numbers);
  numbers.CheckEnd();
}

ProductFootprint
SheetSurvey::GetFootprint(const VolumeGeometry & geometry, const bool hasImportance)
{
  const std::uint64_t ofRunAndAll = 2 * SheetPoints::GetBytes(geometry, hasImportance);
  // Three bytes for each number on the average, and the packed ones.
  constexpr std::uint64_t perPoint = 2 * 8 * 3;
  const std::uint64_t     points = std::min<std::uint64_t>(SheetPoints::DefaultBudget, geometry.GetNumberOfVoxels());
  // Of the part a run, the sum of all, and their bytes once more.
  const std::uint64_t blocks = PartBlocks(geometry.size).GetNumberOfBlocks();
  return { ofRunAndAll + 2 * blocks, perPoint * points + 2 * blocks, PerVoxelOfTile };
}

} // end namespace medialvoxel
