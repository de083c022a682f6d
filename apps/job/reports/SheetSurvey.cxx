// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetSurvey.h"

#include <algorithm>
#include <cmath>

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
    ++sums.rims;
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
AddCells(const itk::MedialVoxelCellRow & row, WordType cells)
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

} // namespace

SheetSurvey::SheetSurvey(const VolumeGeometry & geometry, double lengthUnit)
  : m_LengthUnit(lengthUnit)
  , m_Pending(geometry.size)
  , m_Total(geometry.size)
{}

void
SheetSurvey::Begin()
{
  m_Pending.Clear(m_Total.GetLevel()); // all cells need it already
}

void
SheetSurvey::Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace *)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  auto                              wall = tile.walls.begin();
  for (const itk::MedialVoxelCellRow & row : tile.rows)
  {
    for (WordType rest = row.byBound | row.byGeodesic; rest != 0;)
    {
      const int             first = itk::MedialVoxelLowestBit(rest);
      itk::MedialVoxelIndex cell = row.first;
      cell[0] += first;
      const WordType inBlock = rest & GetBlockMask(cell[0], first, m_Pending.GetLevel());
      rest &= ~inBlock;
      SheetPoints::Sums sums = AddCells(row, inBlock);
      for (WordType measured = row.measured & inBlock; measured != 0; measured &= measured - 1)
      {
        AddWall(*wall++, m_LengthUnit, sums);
      }
      m_Pending.Add(cell, sums);
    }
  }
}

void
SheetSurvey::Commit()
{
  m_Total.Add(m_Pending);
  m_Pending.Clear(m_Total.GetLevel());
}

void
SheetSurvey::Clear()
{
  m_Total.Clear();
}

std::string
SheetSurvey::Save() const
{
  NumberWriter numbers;
  m_Total.Save(numbers);
  return numbers.Pack();
}

void
SheetSurvey::Merge(const std::string & bytes)
{
  constexpr std::uint64_t mostBytesOfNumber = 10;
  NumberReader            numbers(bytes, mostBytesOfNumber * m_Total.GetMostNumbers());
  m_Total.Merge(numbers);
  numbers.CheckEnd();
}

std::uint64_t
SheetSurvey::GetBytes(const VolumeGeometry & geometry)
{
  return 2 * SheetPoints::GetBytes(geometry); // of a run and all
}

std::uint64_t
SheetSurvey::GetSavedBytes(const VolumeGeometry & geometry)
{
  // Of each number three bytes on the average, and the packed ones.
  constexpr std::uint64_t bytesPerPoint = 2 * 8 * 3;
  return bytesPerPoint * std::min<std::uint64_t>(SheetPoints::DefaultBudget, geometry.GetNumberOfVoxels());
}

} // end namespace medialvoxel
