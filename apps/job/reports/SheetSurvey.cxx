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
    itk::MedialVoxelIndex cell = row.first;
    itk::MedialVoxelIndex first = row.first; // of the cells that are not added yet, which are in one block
    SheetPoints::Sums     sums;
    for (WordType rest = row.byBound | row.byGeodesic; rest != 0; rest &= rest - 1)
    {
      const int x = itk::MedialVoxelLowestBit(rest);
      cell[0] = row.first[0] + x;
      if (sums.cells > 0 && (cell[0] ^ first[0]) >> m_Pending.GetLevel() != 0)
      {
        m_Pending.Add(first, sums);
        sums = {};
      }
      first = sums.cells == 0 ? cell : first;
      ++sums.cells;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sums.index[axis] += static_cast<std::uint64_t>(cell[axis]);
      }
      if ((row.measured >> x & 1) != 0)
      {
        AddWall(*wall++, m_LengthUnit, sums);
      }
    }
    if (sums.cells > 0)
    {
      m_Pending.Add(first, sums);
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
