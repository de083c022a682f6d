// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetPoints.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

/** Bits of the index of a block along an axis, in its key. */
constexpr unsigned int  BitsPerAxis = 21;
constexpr std::uint64_t MostBlocks = std::uint64_t{ 1 } << BitsPerAxis;

constexpr unsigned int MostLevels = 64;

/** Places for the numbers of the first blocks, as a power of two. */
constexpr unsigned int LeastBitsOfPlaces = 8;
constexpr unsigned int BitsOfHash = 64;

/** Blocks along x whose numbers lie in one line of the cache, as a power of two. */
constexpr unsigned int BitsOfLine = 4;

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
  unpaired += other.unpaired;
}

SheetPoints::SheetPoints(const std::vector<std::uint64_t> & size, std::size_t budget)
  : m_Budget(std::max<std::size_t>(budget, 1))
  , m_Numbers(std::size_t{ 1 } << LeastBitsOfPlaces)
  , m_Shift(BitsOfHash - LeastBitsOfPlaces)
{
  std::copy(size.begin(), size.end(), m_Size.begin());
  m_Level = GetFirstLevel(m_Size);
}

void
SheetPoints::Clear(unsigned int level)
{
  m_Blocks.clear();
  m_Importance.clear();
  std::fill(m_Numbers.begin(), m_Numbers.end(), 0);
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
SheetPoints::Add(const itk::MedialVoxelIndex & cell, const Sums & sums, const std::uint64_t importance)
{
  this->AddAt({ { static_cast<std::uint64_t>(cell[0]),
                  static_cast<std::uint64_t>(cell[1]),
                  static_cast<std::uint64_t>(cell[2]) } },
              0,
              sums,
              importance);
}

void
SheetPoints::Add(const SheetPoints & other)
{
  this->CoarsenTo(other.m_Level);
  for (std::size_t i = 0; i < other.m_Blocks.size(); ++i)
  {
    const Block & block = other.m_Blocks[i];
    this->AddAt(GetBlock(block.key), other.m_Level, block.sums, other.GetImportance(i));
  }
}

/** \param level of the block, not above that of the points */
void
SheetPoints::AddAt(std::array<std::uint64_t, 3> block,
                   unsigned int                 level,
                   const Sums &                 sums,
                   const std::uint64_t          importance)
{
  for (std::uint64_t & index : block)
  {
    index >>= m_Level - level;
  }
  this->AddToBlock(GetKey(block), sums, importance);
  while (m_Blocks.size() > m_Budget)
  {
    this->CoarsenTo(m_Level + 1);
  }
}

/** The place of the number of a block, or the free one for it. */
std::uint32_t &
SheetPoints::FindNumber(const KeyType key)
{
  constexpr std::uint64_t goldenRatio = 0x9E3779B97F4A7C15u;
  constexpr KeyType       line = KeyType{ 1 } << BitsOfLine;
  const std::size_t       first = ((key >> BitsOfLine) * goldenRatio >> m_Shift) ^ (key & (line - 1));
  // The next line, as a whole one may be taken.
  for (std::size_t place = first;; place = (place + line + 1) & (m_Numbers.size() - 1))
  {
    std::uint32_t & number = m_Numbers[place];
    if (number == 0 || m_Blocks[number - 1].key == key)
    {
      return number;
    }
  }
}

void
SheetPoints::AddToBlock(const KeyType key, const Sums & sums, const std::uint64_t importance)
{
  const auto raise = [this, importance](const std::size_t block) {
    if (importance > 0 || !m_Importance.empty())
    {
      m_Importance.reserve(m_Blocks.capacity());
      m_Importance.resize(m_Blocks.size());
      m_Importance[block] = std::max(m_Importance[block], importance);
    }
  };
  std::uint32_t * number = &this->FindNumber(key);
  if (*number != 0)
  {
    m_Blocks[*number - 1].sums.Add(sums);
    raise(*number - 1);
    return;
  }
  // Half of the places stay free, so that searches are short.
  if (2 * (m_Blocks.size() + 1) > m_Numbers.size())
  {
    this->MakeRoom();
    number = &this->FindNumber(key);
  }
  m_Blocks.push_back({ key, sums });
  *number = static_cast<std::uint32_t>(m_Blocks.size());
  raise(m_Blocks.size() - 1);
}

/** Twice as many places. */
void
SheetPoints::MakeRoom()
{
  m_Numbers.assign(2 * m_Numbers.size(), 0);
  --m_Shift;
  m_Blocks.reserve(std::min(m_Numbers.size() / 2, m_Budget + 1));
  for (std::size_t i = 0; i < m_Blocks.size(); ++i)
  {
    this->FindNumber(m_Blocks[i].key) = static_cast<std::uint32_t>(i + 1);
  }
}

/** In place: no more blocks are left than were read. */
void
SheetPoints::CoarsenTo(unsigned int level)
{
  if (level <= m_Level)
  {
    return;
  }
  const unsigned int levels = level - m_Level;
  std::size_t        left = 0;
  std::fill(m_Numbers.begin(), m_Numbers.end(), 0);
  for (std::size_t i = 0; i < m_Blocks.size(); ++i)
  {
    const Block                  fine = m_Blocks[i];
    const std::uint64_t          importance = this->GetImportance(i);
    std::array<std::uint64_t, 3> block = GetBlock(fine.key);
    for (std::uint64_t & index : block)
    {
      index >>= levels;
    }
    const KeyType   key = GetKey(block);
    std::uint32_t & number = this->FindNumber(key);
    const bool      isNew = number == 0;
    if (isNew)
    {
      m_Blocks[left] = { key, fine.sums };
      number = static_cast<std::uint32_t>(++left);
    }
    else
    {
      m_Blocks[number - 1].sums.Add(fine.sums);
    }
    if (!m_Importance.empty())
    {
      std::uint64_t & ofBlock = m_Importance[number - 1];
      ofBlock = isNew ? importance : std::max(ofBlock, importance);
    }
  }
  m_Blocks.resize(left);
  m_Importance.resize(m_Importance.empty() ? 0 : left);
  m_Level = level;
}

void
SheetPoints::ForEachPoint(const std::function<void(const Point & point)> & function) const
{
  std::vector<std::pair<KeyType, std::size_t>> sorted;
  sorted.reserve(m_Blocks.size());
  for (std::size_t i = 0; i < m_Blocks.size(); ++i)
  {
    sorted.emplace_back(m_Blocks[i].key, i);
  }
  std::sort(sorted.begin(), sorted.end());
  for (const auto & [key, i] : sorted)
  {
    function({ GetBlock(key), m_Blocks[i].sums, this->GetImportance(i) });
  }
}

std::vector<std::uint32_t>
SheetPoints::FindNumbers(const std::vector<std::array<std::int32_t, 3>> & cells,
                         const std::vector<std::uint32_t> &               numbers) const
{
  std::vector<KeyType> keys;
  keys.reserve(m_Blocks.size());
  this->ForEachPoint([&keys](const Point & point) { keys.push_back(GetKey(point.block)); });
  std::vector<std::uint32_t> found(keys.size(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    std::array<std::uint64_t, 3> block{};
    std::transform(cells[i].begin(), cells[i].end(), block.begin(), [this](const std::int32_t index) {
      return static_cast<std::uint64_t>(index) >> m_Level;
    });
    const KeyType key = GetKey(block);
    const auto    at = std::lower_bound(keys.begin(), keys.end(), key);
    // The sheet of the walls has few cells beside those of the points.
    if (numbers[i] > 0 && at != keys.end() && *at == key)
    {
      std::uint32_t & number = found[static_cast<std::size_t>(at - keys.begin())];
      number = number == 0 ? numbers[i] : std::min(number, numbers[i]);
    }
  }
  return found;
}

void
SheetPoints::Save(NumberWriter & numbers) const
{
  numbers.Add(m_Level);
  numbers.Add(m_Blocks.size());
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
    numbers.Add(point.sums.unpaired);
    numbers.Add(point.importance);
  });
}

void
SheetPoints::Merge(NumberReader & numbers)
{
  const std::uint64_t level = numbers.Get();
  const std::size_t   size = numbers.GetLength();
  if (level >= MostLevels || size > m_Budget)
  {
    RefuseSaved();
  }
  this->CoarsenTo(static_cast<unsigned int>(level));
  KeyType key = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const std::uint64_t gap = numbers.Get();
    if (gap > std::numeric_limits<KeyType>::max() - key || (i > 0 && gap == 0))
    {
      RefuseSaved();
    }
    key += gap;
    const std::array<std::uint64_t, 3> block = GetBlock(key);
    Sums                               sums;
    sums.cells = numbers.Get();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      if (block[axis] > (m_Size[axis] - 1) >> level)
      {
        RefuseSaved();
      }
      sums.index[axis] = numbers.Get() + sums.cells * (block[axis] << level);
    }
    sums.thickness = numbers.Get();
    sums.measured = numbers.Get();
    sums.unpaired = numbers.Get();
    const std::uint64_t importance = numbers.Get();
    this->AddAt(block, static_cast<unsigned int>(level), sums, importance);
  }
}

std::uint64_t
SheetPoints::GetMostNumbers() const
{
  constexpr std::uint64_t numbersPerPoint = 9;
  return 2 + numbersPerPoint * m_Budget;
}

std::uint64_t
SheetPoints::GetBytes(const VolumeGeometry & geometry, const bool hasImportance, std::size_t budget)
{
  // A block while it is copied to more memory, up to four places for its number, and an entry to sort it.
  constexpr std::uint64_t bytesPerPoint =
    sizeof(Block) * 3 / 2 + 4 * sizeof(std::uint32_t) + sizeof(std::pair<KeyType, std::size_t>);
  const std::uint64_t points = std::min<std::uint64_t>(budget + 1, geometry.GetNumberOfVoxels());
  return points * (bytesPerPoint + (hasImportance ? sizeof(std::uint64_t) * 3 / 2 : 0));
}

} // end namespace medialvoxel
