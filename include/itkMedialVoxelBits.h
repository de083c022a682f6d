// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBits_h
#define itkMedialVoxelBits_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace itk
{

/** \class MedialVoxelBits
 * \brief One bit per voxel of a box, 64 voxels of a row to a word.
 *
 * Word w of a row holds the voxels 64 w .. 64 w + 63 of the image, whatever the box, so that volumes with different
 * boxes line up word by word. Bits outside the box are zero. Each row has one zero word before and after it, which
 * lets kernels read a word to either side of the box without a test.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBits
{
public:
  using WordType = std::uint64_t;

  static constexpr std::int64_t BitsPerWord = 64;

  MedialVoxelBits() = default;

  explicit MedialVoxelBits(const MedialVoxelBox & box) { this->Reshape(box); }

  /** Set the box and clear all bits. Box indices are not negative. */
  void
  Reshape(const MedialVoxelBox & box);

  /** Set the box and keep the bits that the old box and the new one share; other bits are zero. New memory suffices for
   * \a largestBox too. */
  void
  Reframe(const MedialVoxelBox & box, const MedialVoxelBox & largestBox);

  /** Set the box; its bits are undefined until CopyRows() sets them. New memory suffices for \a largestBox too. */
  void
  Frame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox);

  /** Copy whole rows of the box that are in \a rows from \a source; bits outside its box are zero. Several threads may
   * copy different rows. */
  void
  CopyRows(const MedialVoxelBits & source, const MedialVoxelBox & rows);

  /** Bytes that the bits have after a Frame(). */
  std::uint64_t
  GetBytesToFrame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox) const;

  /** True when Reframe() needs no further memory, as when a box slides along y or z. */
  bool
  CanReframeInPlace(const MedialVoxelBox & box) const;

  /** Memory that the bits have now; it does not shrink with them. */
  std::uint64_t
  GetReservedBytes() const
  {
    return m_Words.capacity() * sizeof(WordType);
  }

  const MedialVoxelBox &
  GetBox() const
  {
    return m_Box;
  }

  /** Image-wide number of the first word of a row. */
  std::int64_t
  GetFirstWord() const
  {
    return m_FirstWord;
  }

  std::int64_t
  GetWordsPerRow() const
  {
    return m_WordsPerRow;
  }

  /** Words from a row to the next one. */
  std::int64_t
  GetRowPitch() const
  {
    return m_RowPitch;
  }

  /** First word of the row at (y, z) in the box; index -1 and GetWordsPerRow() are readable zeros. */
  WordType *
  GetRow(std::int64_t y, std::int64_t z)
  {
    assert(this->HasRow(y, z));
    return m_Words.data() + this->RowOffset(y, z);
  }

  const WordType *
  GetRow(std::int64_t y, std::int64_t z) const
  {
    assert(this->HasRow(y, z));
    return m_Words.data() + this->RowOffset(y, z);
  }

  bool
  HasRow(std::int64_t y, std::int64_t z) const
  {
    return y >= m_Box.lower[1] && y < m_Box.upper[1] && z >= m_Box.lower[2] && z < m_Box.upper[2];
  }

  /** Value of one voxel; false outside the box. */
  bool
  Test(const MedialVoxelIndex & index) const;

  /** Set one voxel of the box. */
  void
  Set(const MedialVoxelIndex & index);

  /** The 64 bits from \a x on (bit 0 is x) of a row of the box; voxels outside the box read as zero. */
  WordType
  Extract(const std::int64_t x, const std::int64_t y, const std::int64_t z) const
  {
    // An arithmetic shift rounds towards minus infinity, as x may lie before the box.
    const std::int64_t word = (x >> 6) - m_FirstWord;
    if (word < -1 || word > m_WordsPerRow)
    {
      return 0;
    }
    const WordType * const row = this->GetRow(y, z) + word;
    const unsigned int     shift = static_cast<unsigned int>(x & (BitsPerWord - 1));
    if (shift == 0)
    {
      return row[0];
    }
    return (row[0] >> shift) | (word < m_WordsPerRow ? row[1] << (BitsPerWord - shift) : 0);
  }

  /** Mask of the bits of the image-wide word \a word that lie in [lower, upper). */
  static WordType
  RangeMask(const std::int64_t word, const std::int64_t lower, const std::int64_t upper)
  {
    const std::int64_t begin = std::max<std::int64_t>(lower - word * BitsPerWord, 0);
    const std::int64_t end = std::min<std::int64_t>(upper - word * BitsPerWord, BitsPerWord);
    if (begin >= end)
    {
      return 0;
    }
    const WordType upTo = (end == BitsPerWord) ? ~WordType{ 0 } : (WordType{ 1 } << end) - 1;
    return upTo & (~WordType{ 0 } << begin);
  }

  /** True when a bit is set in \a box, clipped to the own box. */
  bool
  Any(const MedialVoxelBox & box) const;

  /** Number of bits set in \a box, clipped to the own box. */
  std::uint64_t
  Count(const MedialVoxelBox & box) const;

  /** Bytes that the bits of a box take. */
  static std::uint64_t
  GetBytes(const MedialVoxelBox & box);

private:
  /** Set the box, but not the words. */
  void
  SetBox(const MedialVoxelBox & box);

  void
  ReframeInPlace(const MedialVoxelBox & box);

  void
  ClearAround(const MedialVoxelBox & kept);

  /** Call \a visit(word) for the bits of \a box, word by word without empty words, until it returns false. */
  template <typename TVisitor>
  void
  VisitWords(const MedialVoxelBox & box, TVisitor && visit) const;

  std::ptrdiff_t
  RowOffset(std::int64_t y, std::int64_t z) const
  {
    return static_cast<std::ptrdiff_t>(((z - m_Box.lower[2]) * m_Box.Extent(1) + (y - m_Box.lower[1])) * m_RowPitch +
                                       1);
  }

  /** Leaves new words undefined: the threads that set them should touch their memory first. */
  struct Allocator : public std::allocator<WordType>
  {
    template <typename TOther>
    struct rebind
    {
      using other = Allocator;
    };

    void
    construct(WordType * word)
    {
      ::new (static_cast<void *>(word)) WordType;
    }
    void
    construct(WordType * word, const WordType value)
    {
      ::new (static_cast<void *>(word)) WordType(value);
    }
  };
  using Words = std::vector<WordType, Allocator>;

  MedialVoxelBox m_Box;
  std::int64_t   m_FirstWord{ 0 };
  std::int64_t   m_WordsPerRow{ 0 };
  std::int64_t   m_RowPitch{ 0 };
  Words          m_Words;
};

/** Number of bits set in a word. */
inline int
MedialVoxelPopulationCount(std::uint64_t word)
{
#if (defined(__GNUC__) || defined(__clang__)) && (!defined(__x86_64__) || defined(__POPCNT__))
  return __builtin_popcountll(word);
#else
  // Sums of 2, 4 and 8 bits side by side, then of all bytes; without an instruction for it compilers call a function.
  word -= (word >> 1) & 0x5555555555555555u;
  word = (word & 0x3333333333333333u) + ((word >> 2) & 0x3333333333333333u);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return static_cast<int>((word * 0x0101010101010101u) >> 56);
#endif
}

/** Position of the lowest bit set; \a word is not zero. */
inline int
MedialVoxelLowestBit(std::uint64_t word)
{
#if defined(__GNUC__) || defined(__clang__)
  return __builtin_ctzll(word);
#else
  return MedialVoxelPopulationCount((word & (~word + 1)) - 1);
#endif
}

/** Position of the highest bit set; \a word is not zero. */
inline int
MedialVoxelHighestBit(std::uint64_t word)
{
#if defined(__GNUC__) || defined(__clang__)
  return 63 - __builtin_clzll(word);
#else
  int position = 0;
  while (word >>= 1)
  {
    ++position;
  }
  return position;
#endif
}

} // end namespace itk

#endif
