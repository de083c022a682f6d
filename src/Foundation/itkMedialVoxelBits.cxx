// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBits.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
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
    // Freed before more is taken, so that both are never there at the same time.
    Words().swap(m_Words);
  }
  m_Words.assign(words, 0);
}

void
MedialVoxelBits::Reframe(const MedialVoxelBox & box, const MedialVoxelBox & room)
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
  result.Frame(box, room);
  for (MedialVoxelBox slice = box; slice.lower[2] < box.upper[2]; ++slice.lower[2])
  {
    MedialVoxelPoll();
    slice.upper[2] = slice.lower[2] + 1;
    result.CopyRows(*this, slice);
  }
  *this = std::move(result);
}

std::uint64_t
MedialVoxelBits::GetBytesToFrame(const MedialVoxelBox & box, const MedialVoxelBox & room) const
{
  return WordsOfBox(box) <= m_Words.capacity() ? this->GetReservedBytes() : std::max(GetBytes(box), GetBytes(room));
}

void
MedialVoxelBits::Frame(const MedialVoxelBox & box, const MedialVoxelBox & room)
{
  this->SetBox(box);
  const std::size_t words = WordsOfBox(box);
  if (words > m_Words.capacity())
  {
    Words().swap(m_Words);
    m_Words.reserve(std::max(words, WordsOfBox(room)));
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

bool
MedialVoxelBits::CanReframeInPlace(const MedialVoxelBox & box) const
{
  const bool hasSameSlices = box.lower[0] == m_Box.lower[0] && box.upper[0] == m_Box.upper[0] &&
                             box.lower[1] == m_Box.lower[1] && box.upper[1] == m_Box.upper[1];
  return hasSameSlices && !box.Intersection(m_Box).IsEmpty() && WordsOfBox(box) <= m_Words.capacity();
}

void
MedialVoxelBits::ReframeInPlace(const MedialVoxelBox & box)
{
  const MedialVoxelBox shared = box.Intersection(m_Box);
  const std::ptrdiff_t wordsPerSlice = m_RowPitch * m_Box.Extent(1);
  const std::size_t    words = WordsOfBox(box);
  const std::ptrdiff_t source = (shared.lower[2] - m_Box.lower[2]) * wordsPerSlice;
  const std::ptrdiff_t target = (shared.lower[2] - box.lower[2]) * wordsPerSlice;
  const std::ptrdiff_t count = shared.Extent(2) * wordsPerSlice;
  m_Words.resize(std::max(m_Words.size(), words));
  std::memmove(m_Words.data() + target, m_Words.data() + source, static_cast<std::size_t>(count) * sizeof(WordType));
  m_Words.resize(words);
  std::fill(m_Words.begin(), m_Words.begin() + target, 0);
  std::fill(m_Words.begin() + target + count, m_Words.end(), 0);
  m_Box = box;
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
