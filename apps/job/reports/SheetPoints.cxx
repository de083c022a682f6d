// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetPoints.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{
namespace
{

/** Of the index of a block along an axis in its key. */
constexpr unsigned int  BitsPerAxis = 21;
constexpr std::uint64_t MostBlocks = std::uint64_t{ 1 } << BitsPerAxis;

constexpr unsigned int MostLevels = 64;

unsigned int
GetFirstLevel(const std::array<std::uint64_t, 3> & size)
{
  unsigned int level = 0;
  while (*std::max_element(size.begin(), size.end()) >> level >= MostBlocks)
  {
    ++level;
  }
  return level;
}

} // namespace

void
SheetPoints::Sums::Add(const Sums & other)
{
  cells += other.cells;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    index[axis] += other.index[axis];
  }
  thickness += other.thickness;
  measured += other.measured;
  rims += other.rims;
}

SheetPoints::SheetPoints(const std::vector<std::uint64_t> & size, std::size_t budget)
  : m_Budget(std::max<std::size_t>(budget, 1))
{
  std::copy(size.begin(), size.end(), m_Size.begin());
  m_Level = GetFirstLevel(m_Size);
}

void
SheetPoints::Clear(unsigned int level)
{
  m_Points.clear();
  m_Level = std::max(GetFirstLevel(m_Size), level);
}

auto
SheetPoints::GetKey(const std::array<std::uint64_t, 3> & block) -> KeyType
{
  return (block[2] << BitsPerAxis | block[1]) << BitsPerAxis | block[0];
}

std::array<std::uint64_t, 3>
SheetPoints::GetBlock(const KeyType key)
{
  return { { key & (MostBlocks - 1), key >> BitsPerAxis & (MostBlocks - 1), key >> 2 * BitsPerAxis } };
}

std::array<std::uint64_t, 3>
SheetPoints::GetNumberOfBlocks() const
{
  std::array<std::uint64_t, 3> blocks{};
  std::transform(
    m_Size.begin(), m_Size.end(), blocks.begin(), [this](std::uint64_t size) { return ((size - 1) >> m_Level) + 1; });
  return blocks;
}

void
SheetPoints::Add(const itk::MedialVoxelIndex & cell, const Sums & sums)
{
  this->AddAt({ { static_cast<std::uint64_t>(cell[0]),
                  static_cast<std::uint64_t>(cell[1]),
                  static_cast<std::uint64_t>(cell[2]) } },
              0,
              sums);
}

void
SheetPoints::Add(const SheetPoints & other)
{
  this->CoarsenTo(other.m_Level);
  for (const auto & [key, sums] : other.m_Points)
  {
    this->AddAt(GetBlock(key), other.m_Level, sums);
  }
}

/** \param level of the block, not above that of the points */
void
SheetPoints::AddAt(std::array<std::uint64_t, 3> block, unsigned int level, const Sums & sums)
{
  for (std::uint64_t & index : block)
  {
    index >>= m_Level - level;
  }
  m_Points[GetKey(block)].Add(sums);
  while (m_Points.size() > m_Budget)
  {
    this->CoarsenTo(m_Level + 1);
  }
}

void
SheetPoints::CoarsenTo(unsigned int level)
{
  if (level <= m_Level)
  {
    return;
  }
  const unsigned int                levels = level - m_Level;
  std::unordered_map<KeyType, Sums> coarse;
  for (const auto & [key, sums] : m_Points)
  {
    std::array<std::uint64_t, 3> block = GetBlock(key);
    for (std::uint64_t & index : block)
    {
      index >>= levels;
    }
    coarse[GetKey(block)].Add(sums);
  }
  m_Points.swap(coarse);
  m_Level = level;
}

void
SheetPoints::ForEachPoint(const std::function<void(const Point & point)> & function) const
{
  std::vector<KeyType> keys;
  keys.reserve(m_Points.size());
  for (const auto & [key, sums] : m_Points)
  {
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  for (const KeyType key : keys)
  {
    function({ GetBlock(key), m_Points.at(key) });
  }
}

void
SheetPoints::Save(NumberWriter & numbers) const
{
  numbers.Add(m_Level);
  numbers.Add(m_Points.size());
  KeyType previous = 0;
  this->ForEachPoint([&](const Point & point) {
    const KeyType key = GetKey(point.block);
    numbers.Add(key - previous);
    previous = key;
    numbers.Add(point.sums.cells);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      numbers.Add(point.sums.index[axis] - point.sums.cells * (point.block[axis] << m_Level));
    }
    numbers.Add(point.sums.thickness);
    numbers.Add(point.sums.measured);
    numbers.Add(point.sums.rims);
  });
}

void
SheetPoints::Merge(NumberReader & numbers)
{
  const std::uint64_t level = numbers.Get();
  const std::size_t   size = numbers.GetLength();
  if (level >= MostLevels || size > m_Budget)
  {
    RefusePart();
  }
  this->CoarsenTo(static_cast<unsigned int>(level));
  KeyType key = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const std::uint64_t gap = numbers.Get();
    if (gap > std::numeric_limits<KeyType>::max() - key || (i > 0 && gap == 0))
    {
      RefusePart();
    }
    key += gap;
    const std::array<std::uint64_t, 3> block = GetBlock(key);
    Sums                               sums;
    sums.cells = numbers.Get();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      if (block[axis] > (m_Size[axis] - 1) >> level)
      {
        RefusePart();
      }
      sums.index[axis] = numbers.Get() + sums.cells * (block[axis] << level);
    }
    sums.thickness = numbers.Get();
    sums.measured = numbers.Get();
    sums.rims = numbers.Get();
    this->AddAt(block, static_cast<unsigned int>(level), sums);
  }
}

std::uint64_t
SheetPoints::GetMostNumbers() const
{
  constexpr std::uint64_t numbersPerPoint = 8;
  return 2 + numbersPerPoint * m_Budget;
}

std::uint64_t
SheetPoints::GetBytes(const VolumeGeometry & geometry, std::size_t budget)
{
  // A node with what the allocator takes for it, its bucket, and a quarter of that again while blocks grow.
  constexpr std::uint64_t bytesOfNode = sizeof(KeyType) + sizeof(Sums) + 4 * sizeof(void *);
  const std::uint64_t     points = std::min<std::uint64_t>(budget + 1, geometry.GetNumberOfVoxels());
  return points * (bytesOfNode + 2 * sizeof(void *)) * 5 / 4;
}

} // end namespace medialvoxel
