// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelThinning.h"

#include "itkMedialVoxelCellLink.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <utility>

namespace itk
{

namespace
{

constexpr std::int64_t TurnsPerPass = 8;

/** Parity of x, y and z (bits 0, 1, 2) of the cells of a turn. */
std::uint32_t
ParityOf(const std::int64_t turn)
{
  constexpr std::array<std::uint32_t, 8> grayCode{ { 0, 1, 3, 2, 6, 7, 5, 4 } };
  const std::uint32_t                    code = grayCode[static_cast<std::size_t>(turn % TurnsPerPass)];
  const auto                             shift = static_cast<unsigned int>(turn / TurnsPerPass % 3);
  return ((code << shift) | (code >> (3 - shift))) & 7u;
}

} // namespace

MedialVoxelThinning::MedialVoxelThinning(const MedialVoxelGrid & grid, Consumer consumer)
  : m_Grid(grid)
  , m_Image(grid.GetVoxelBox())
  , m_Cells(grid.GetCellBox())
  , m_Consumer(std::move(consumer))
  , m_NoBits(static_cast<std::size_t>(m_Image.upper[0] / MedialVoxelBits::BitsPerWord) + 4)
{}

MedialVoxelBox
MedialVoxelThinning::GetSliceBox(const std::int64_t slice) const
{
  MedialVoxelBox box = m_Image;
  box.lower[2] = slice;
  box.upper[2] = slice + 1;
  return box;
}

void
MedialVoxelThinning::AddSlice(MedialVoxelBits object, MedialVoxelBits medial, std::vector<LevelType> levels)
{
  m_Slices.push_back({ std::move(object), std::move(medial), std::move(levels) });
  m_HeldBytes += m_Slices.back().GetBytes();
  const std::int64_t slice = m_NumberOfSlices++;
  // The corners of a cell are in two slices, if the image has them.
  const std::int64_t ready = slice - (m_Image.Extent(2) > 1 ? 1 : 0);
  if (ready >= 0 && ready < m_Cells.upper[2])
  {
    this->Begin(ready);
    this->GoOn(ready);
    this->HandOver();
  }
}

void
MedialVoxelThinning::Begin(const std::int64_t slice)
{
  const bool hasNext = slice + 1 < m_NumberOfSlices;
  this->At(slice).cells =
    FindCells(m_Grid, this->At(slice).object, hasNext ? this->At(slice + 1).object : MedialVoxelBits());
  this->CountCells(slice);
  this->At(slice).turn = this->FindTurn(slice, 0);
}

MedialVoxelBits
MedialVoxelThinning::FindCells(const MedialVoxelGrid & grid,
                               const MedialVoxelBits & object,
                               const MedialVoxelBits & next)
{
  const MedialVoxelBox cells = grid.GetCellBox();
  const std::int64_t   slice = object.GetBox().lower[2];
  MedialVoxelBits      found(object.GetBox());
  for (std::int64_t y = 0; y < cells.upper[1] && slice < cells.upper[2]; ++y)
  {
    MedialVoxelBits::WordType * const target = found.GetRow(y, slice);
    for (std::int64_t corner = 0; corner < 4; ++corner)
    {
      const MedialVoxelBits & voxels = corner < 2 ? object : next;
      const std::int64_t      cornerY = y + corner % 2;
      const std::int64_t      cornerZ = slice + corner / 2;
      for (std::int64_t word = 0; voxels.HasRow(cornerY, cornerZ) && word < found.GetWordsPerRow(); ++word)
      {
        const MedialVoxelBits::WordType * const row = voxels.GetRow(cornerY, cornerZ) + word;
        target[word] |= row[0] | (row[0] >> 1) | (row[1] << 63);
      }
    }
    for (std::int64_t word = 0; word < found.GetWordsPerRow(); ++word)
    {
      target[word] &= MedialVoxelBits::RangeMask(word, 0, cells.upper[0]);
    }
  }
  return found;
}

/** Count the cells that can be deleted, by level. */
void
MedialVoxelThinning::CountCells(const std::int64_t slice)
{
  Slice & own = this->At(slice);
  own.open = own.cells;
  const auto forEachCell = [&](const auto & function) {
    for (std::int64_t y = 0; y < m_Cells.upper[1]; ++y)
    {
      for (std::int64_t word = 0; word < own.cells.GetWordsPerRow(); ++word)
      {
        MedialVoxelBits::WordType & open = own.open.GetRow(y, slice)[word];
        open &= ~own.medial.GetRow(y, slice)[word];
        for (auto bits = open; bits != 0; bits &= bits - 1)
        {
          const std::int64_t x = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(bits);
          function(x, y, own.levels[static_cast<std::size_t>(y * m_Image.upper[0] + x)]);
        }
      }
    }
  };
  LevelType highest = 0;
  forEachCell([&](std::int64_t, std::int64_t, const LevelType level) {
    own.lowest = std::min(own.lowest, level);
    highest = std::max(highest, level);
  });
  if (own.lowest == NoLevel)
  {
    return;
  }
  own.counts.resize(static_cast<std::size_t>(highest - own.lowest) + 1);
  m_HeldBytes += own.counts.capacity() * sizeof(Counts);
  forEachCell([&](const std::int64_t x, const std::int64_t y, const LevelType level) {
    ++own.counts[static_cast<std::size_t>(level - own.lowest)][static_cast<std::size_t>((x & 1) + 2 * (y & 1))];
  });
}

/** The first turn from \a turn on in which the slice has work. */
std::int64_t
MedialVoxelThinning::FindTurn(const std::int64_t slice, std::int64_t turn)
{
  const Slice &      own = this->At(slice);
  const std::int64_t end = own.lowest + static_cast<std::int64_t>(own.counts.size());
  const auto         countsOf = [&](const std::int64_t level) -> const Counts & {
    return own.counts[static_cast<std::size_t>(level - own.lowest)];
  };
  for (;; ++turn)
  {
    std::int64_t level = std::max<std::int64_t>(own.lowest, turn / TurnsPerPass - NumberOfChances + 1);
    while (level < end && countsOf(level) == Counts{})
    {
      ++level;
    }
    if (level >= end)
    {
      return Done;
    }
    turn = std::max(turn, level * TurnsPerPass);
    const std::uint32_t parity = ParityOf(turn);
    for (; (parity >> 2) == static_cast<std::uint32_t>(slice & 1) && level < end && level <= turn / TurnsPerPass;
         ++level)
    {
      if (countsOf(level)[parity & 3u] > 0)
      {
        return turn;
      }
    }
  }
}

/** Whether the slices beside it have taken all turns before its next one. */
bool
MedialVoxelThinning::CanGoOn(const std::int64_t slice)
{
  const std::int64_t turn = this->At(slice).turn;
  const auto         isAhead = [&](const std::int64_t other) {
    return other < m_FirstSlice || other >= m_Cells.upper[2] || (other<m_NumberOfSlices && this->At(other).turn> turn);
  };
  return turn != NotBegun && turn != Done && isAhead(slice - 1) && isAhead(slice + 1);
}

/** Let the slice and all that wait for it take their turns. */
void
MedialVoxelThinning::GoOn(const std::int64_t slice)
{
  std::vector<std::int64_t> slices{ slice - 1, slice };
  while (!slices.empty())
  {
    const std::int64_t next = slices.back();
    slices.pop_back();
    if (next < m_FirstSlice || next >= m_NumberOfSlices || !this->CanGoOn(next))
    {
      continue;
    }
    do
    {
      this->TakeTurn(next);
    } while (this->CanGoOn(next));
    slices.insert(slices.end(), { next - 1, next + 1 });
  }
}

void
MedialVoxelThinning::TakeTurn(const std::int64_t slice)
{
  MedialVoxelCheckAbort();
  Slice &             own = this->At(slice);
  const std::int64_t  pass = own.turn / TurnsPerPass;
  const std::uint32_t parity = ParityOf(own.turn) & 3u;
  const auto          ofParity = (~MedialVoxelBits::WordType{ 0 } / 3) << (parity & 1u);
  for (std::int64_t y = parity >> 1; y < m_Cells.upper[1]; y += 2)
  {
    MedialVoxelBits::WordType * const cells = own.cells.GetRow(y, slice);
    MedialVoxelBits::WordType * const open = own.open.GetRow(y, slice);
    const LevelType * const           levels = own.levels.data() + y * m_Image.upper[0];
    Rows                              rows{};
    for (std::int64_t word = 0; word < own.cells.GetWordsPerRow(); ++word)
    {
      auto bits = open[word] & ofParity;
      if (bits != 0 && rows.cells[4] == nullptr)
      {
        rows = this->FindRows(slice, y);
      }
      for (; bits != 0; bits &= bits - 1)
      {
        const MedialVoxelBits::WordType bit = bits & (~bits + 1);
        const std::int64_t              x = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(bits);
        const std::int64_t              level = levels[x];
        if (level <= pass && IsSimple(rows, x))
        {
          cells[word] ^= bit;
          open[word] ^= bit;
          --own.counts[static_cast<std::size_t>(level - own.lowest)][parity];
        }
        else if (pass - level >= NumberOfChances - 1)
        {
          open[word] ^= bit; // this was its last chance
        }
      }
    }
  }
  own.turn = this->FindTurn(slice, own.turn + 1);
}

auto
MedialVoxelThinning::FindRows(const std::int64_t slice, const std::int64_t row) -> Rows
{
  Rows rows{};
  rows.cells.fill(m_NoBits.data() + 1);
  rows.voxels.fill(m_NoBits.data() + 1);
  for (std::int64_t z = std::max(slice - 1, m_FirstSlice); z < std::min(slice + 2, m_NumberOfSlices); ++z)
  {
    const Slice & other = this->At(z);
    for (std::int64_t y = std::max<std::int64_t>(row - 1, 0); y < std::min(row + 2, m_Image.upper[1]); ++y)
    {
      const std::int64_t dy = y - row;
      const std::int64_t dz = z - slice;
      if (other.cells.HasRow(y, z))
      {
        rows.cells[static_cast<std::size_t>(3 * dz + dy + 4)] = other.cells.GetRow(y, z);
      }
      if (dy >= 0 && dz >= 0)
      {
        rows.voxels[static_cast<std::size_t>(2 * dz + dy)] = other.object.GetRow(y, z);
      }
    }
  }
  return rows;
}

bool
MedialVoxelThinning::IsSimple(const Rows & rows, const std::int64_t x)
{
  // Bits of all rows begin at the same place: three of cells from x - 1 on, two of voxels from x on.
  const auto take =
    [](const MedialVoxelBits::WordType * const row, const std::int64_t first, const std::uint32_t mask) {
      const std::int64_t word = first >> 6;
      const auto         shift = static_cast<unsigned int>(first & (MedialVoxelBits::BitsPerWord - 1));
      // A shift by 63 and by 1 more, as one by 64 is not defined.
      const MedialVoxelBits::WordType bits = (row[word] >> shift) | (row[word + 1] << 1 << (63 - shift));
      return static_cast<std::uint32_t>(bits) & mask;
    };
  std::uint32_t cells = 0;
  for (std::size_t k = 0; k < rows.cells.size(); ++k)
  {
    cells |= take(rows.cells[k], x - 1, 7u) << (3 * k);
  }
  std::uint32_t voxels = 0;
  for (std::size_t k = 0; k < rows.voxels.size(); ++k)
  {
    voxels |= take(rows.voxels[k], x, 3u) << (2 * k);
  }
  return MedialVoxelCellLink::IsSimple(cells, voxels);
}

/** Give slices that are done to the consumer, and keep only those that others need. */
void
MedialVoxelThinning::HandOver()
{
  const auto isDone = [&](const std::int64_t slice) {
    return slice < m_NumberOfSlices && this->At(slice).turn == Done;
  };
  for (; m_NumberHandedOver < m_Cells.upper[2] && isDone(m_NumberHandedOver); ++m_NumberHandedOver)
  {
    const Slice & own = this->At(m_NumberHandedOver);
    m_Added.Reshape(own.cells.GetBox());
    for (std::int64_t y = 0; y < m_Cells.upper[1] && own.lowest != NoLevel; ++y)
    {
      MedialVoxelBits::WordType * const       target = m_Added.GetRow(y, m_NumberHandedOver);
      const MedialVoxelBits::WordType * const kept = own.cells.GetRow(y, m_NumberHandedOver);
      const MedialVoxelBits::WordType * const medial = own.medial.GetRow(y, m_NumberHandedOver);
      for (std::int64_t word = 0; word < m_Added.GetWordsPerRow(); ++word)
      {
        target[word] = kept[word] & ~medial[word];
      }
    }
    m_Consumer(m_NumberHandedOver, own.cells, m_Added);
  }
  while (m_FirstSlice < m_NumberHandedOver && (isDone(m_FirstSlice + 1) || m_NumberHandedOver == m_Cells.upper[2]))
  {
    m_HeldBytes -= m_Slices.front().GetBytes();
    m_Slices.pop_front();
    ++m_FirstSlice;
  }
}

} // end namespace itk
