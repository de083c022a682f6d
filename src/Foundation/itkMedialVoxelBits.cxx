// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBits.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace itk
{

namespace
{

std::int64_t
WordsOfRow(const MedialVoxelBox & box)
{
  return box.IsEmpty() ? 0
                       : (box.upper[0] + MedialVoxelBits::BitsPerWord - 1) / MedialVoxelBits::BitsPerWord -
                           box.lower[0] / MedialVoxelBits::BitsPerWord;
}

/** Words of all rows, each with the zero words around it. */
std::size_t
WordsOfBox(const MedialVoxelBox & box)
{
  return box.IsEmpty() ? 0 : static_cast<std::size_t>(box.Extent(1) * box.Extent(2) * (WordsOfRow(box) + 2));
}

} // namespace

std::uint64_t
MedialVoxelBits::GetBytes(const MedialVoxelBox & box)
{
  return WordsOfBox(box) * sizeof(WordType);
}

void
MedialVoxelBits::SetBox(const MedialVoxelBox & box)
{
  m_Box = box;
  m_FirstWord = box.lower[0] / BitsPerWord;
  m_WordsPerRow = WordsOfRow(box);
  m_RowPitch = m_WordsPerRow + 2;
}

void
MedialVoxelBits::Reshape(const MedialVoxelBox & box)
{
  this->SetBox(box);
  const std::size_t words = WordsOfBox(box);
  if (words > m_Words.capacity())
  {
    // Free the old memory first, so that both never exist at the same time.
    Words().swap(m_Words);
  }
  m_Words.assign(words, 0);
}

void
MedialVoxelBits::Reframe(const MedialVoxelBox & box, const MedialVoxelBox & largestBox)
{
  if (box == m_Box)
  {
    return;
  }
  if (this->CanReframeInPlace(box))
  {
    this->ReframeInPlace(box);
    return;
  }
  MedialVoxelBits result;
  result.Frame(box, largestBox);
  for (MedialVoxelBox slice = box; slice.lower[2] < box.upper[2]; ++slice.lower[2])
  {
    MedialVoxelCheckAbort();
    slice.upper[2] = slice.lower[2] + 1;
    result.CopyRows(*this, slice);
  }
  *this = std::move(result);
}

std::uint64_t
MedialVoxelBits::GetBytesToFrame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox) const
{
  return WordsOfBox(box) <= m_Words.capacity() ? this->GetReservedBytes()
                                               : std::max(GetBytes(box), GetBytes(largestBox));
}

void
MedialVoxelBits::Frame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox)
{
  this->SetBox(box);
  const std::size_t words = WordsOfBox(box);
  if (words > m_Words.capacity())
  {
    Words().swap(m_Words);
    m_Words.reserve(std::max(words, WordsOfBox(largestBox)));
  }
  m_Words.resize(words);
}

void
MedialVoxelBits::CopyRows(const MedialVoxelBits & source, const MedialVoxelBox & rows)
{
  const MedialVoxelBox own = rows.Intersection(m_Box);
  const std::int64_t   begin = std::max(m_Box.lower[0], source.m_Box.lower[0]);
  const std::int64_t   end = std::min(m_Box.upper[0], source.m_Box.upper[0]);
  for (std::int64_t z = own.lower[2]; z < own.upper[2]; ++z)
  {
    for (std::int64_t y = own.lower[1]; y < own.upper[1]; ++y)
    {
      WordType * const target = this->GetRow(y, z) - m_FirstWord;
      std::fill_n(target + m_FirstWord - 1, m_RowPitch, 0);
      if (begin < end && source.HasRow(y, z))
      {
        const WordType * const from = source.GetRow(y, z) - source.m_FirstWord;
        for (std::int64_t word = begin / BitsPerWord; word <= (end - 1) / BitsPerWord; ++word)
        {
          target[word] = from[word] & RangeMask(word, begin, end);
        }
      }
    }
  }
}

namespace
{

/** Rows of a box are numbered in the order in which they lie in memory. */
std::int64_t
NumberOfRow(const MedialVoxelBox & box, const std::int64_t y, const std::int64_t z)
{
  return (z - box.lower[2]) * box.Extent(1) + y - box.lower[1];
}

/** Growth of the numbers of shared rows from one box to the other, at the first and the last slice of these rows; in
 * between it lies between both. */
std::array<std::int64_t, 2>
GrowthOfNumbers(const MedialVoxelBox & from, const MedialVoxelBox & to, const MedialVoxelBox & shared)
{
  const std::int64_t y = shared.lower[1];
  const auto         growth = [&](const std::int64_t z) { return NumberOfRow(to, y, z) - NumberOfRow(from, y, z); };
  return { growth(shared.lower[2]), growth(shared.upper[2] - 1) };
}

} // namespace

bool
MedialVoxelBits::CanReframeInPlace(const MedialVoxelBox & box) const
{
  const bool           hasSameRows = box.lower[0] == m_Box.lower[0] && box.upper[0] == m_Box.upper[0];
  const MedialVoxelBox shared = box.Intersection(m_Box);
  if (!hasSameRows || shared.IsEmpty() || WordsOfBox(box) > m_Words.capacity())
  {
    return false;
  }
  // One after the other, none over one that is still to be moved.
  const auto growth = GrowthOfNumbers(m_Box, box, shared);
  return (growth[0] <= 0 && growth[1] <= 0) || (growth[0] >= 0 && growth[1] >= 0);
}

void
MedialVoxelBits::ReframeInPlace(const MedialVoxelBox & box)
{
  const MedialVoxelBox from = m_Box;
  const MedialVoxelBox shared = box.Intersection(from);
  const auto           growth = GrowthOfNumbers(from, box, shared);
  const std::size_t    words = WordsOfBox(box);
  m_Words.resize(std::max(m_Words.size(), words));
  // Rows of a slice lie beside each other in both boxes.
  const auto bytes = static_cast<std::size_t>(shared.Extent(1) * m_RowPitch) * sizeof(WordType);
  const auto moveSlice = [&](const std::int64_t z) {
    const auto place = [&](const MedialVoxelBox & of) {
      return m_Words.data() + NumberOfRow(of, shared.lower[1], z) * m_RowPitch;
    };
    std::memmove(place(box), place(from), bytes);
  };
  if (growth[0] <= 0 && growth[1] <= 0)
  {
    for (std::int64_t z = shared.lower[2]; z < shared.upper[2]; ++z)
    {
      moveSlice(z);
    }
  }
  else
  {
    for (std::int64_t z = shared.upper[2]; z-- > shared.lower[2];)
    {
      moveSlice(z);
    }
  }
  m_Words.resize(words);
  m_Box = box;
  this->ClearAround(shared);
}

/** Clears all rows that are not in \a kept. */
void
MedialVoxelBits::ClearAround(const MedialVoxelBox & kept)
{
  const auto clear = [this](const std::int64_t begin, const std::int64_t end) {
    std::fill(m_Words.begin() + begin * m_RowPitch, m_Words.begin() + end * m_RowPitch, 0);
  };
  std::int64_t begin = 0;
  for (std::int64_t z = kept.lower[2]; z < kept.upper[2]; ++z)
  {
    clear(begin, NumberOfRow(m_Box, kept.lower[1], z));
    begin = NumberOfRow(m_Box, kept.upper[1], z);
  }
  clear(begin, m_Box.Extent(1) * m_Box.Extent(2));
}

bool
MedialVoxelBits::Test(const MedialVoxelIndex & index) const
{
  if (!m_Box.Contains(index))
  {
    return false;
  }
  const WordType word = this->GetRow(index[1], index[2])[index[0] / BitsPerWord - m_FirstWord];
  return ((word >> (index[0] % BitsPerWord)) & 1u) != 0;
}

void
MedialVoxelBits::Set(const MedialVoxelIndex & index)
{
  this->GetRow(index[1], index[2])[index[0] / BitsPerWord - m_FirstWord] |= WordType{ 1 } << (index[0] % BitsPerWord);
}

template <typename TVisitor>
void
MedialVoxelBits::VisitWords(const MedialVoxelBox & box, TVisitor && visit) const
{
  const MedialVoxelBox clipped = box.Intersection(m_Box);
  if (clipped.IsEmpty())
  {
    return;
  }
  const std::int64_t firstWord = clipped.lower[0] / BitsPerWord;
  const std::int64_t lastWord = (clipped.upper[0] - 1) / BitsPerWord;
  for (std::int64_t z = clipped.lower[2]; z < clipped.upper[2]; ++z)
  {
    for (std::int64_t y = clipped.lower[1]; y < clipped.upper[1]; ++y)
    {
      const WordType * const row = this->GetRow(y, z) - m_FirstWord;
      for (std::int64_t word = firstWord; word <= lastWord; ++word)
      {
        if (row[word] != 0 && !visit(row[word] & RangeMask(word, clipped.lower[0], clipped.upper[0])))
        {
          return;
        }
      }
    }
  }
}

bool
MedialVoxelBits::Any(const MedialVoxelBox & box) const
{
  bool any = false;
  this->VisitWords(box, [&any](const WordType bits) {
    any = (bits != 0);
    return !any;
  });
  return any;
}

std::uint64_t
MedialVoxelBits::Count(const MedialVoxelBox & box) const
{
  std::uint64_t count = 0;
  this->VisitWords(box, [&count](const WordType bits) {
    count += static_cast<std::uint64_t>(MedialVoxelPopulationCount(bits));
    return true;
  });
  return count;
}

} // end namespace itk
