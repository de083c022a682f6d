// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSparseBits_h
#define itkMedialVoxelSparseBits_h

#include "itkMedialVoxelBits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelSparseBits
 * \brief One bit per voxel of a box, most of them zero: only blocks of words with a bit that was set take memory.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSparseBits
{
public:
  using WordType = MedialVoxelBits::WordType;

  MedialVoxelSparseBits() = default;

  /** All bits are zero. Box indices are not negative. */
  explicit MedialVoxelSparseBits(const MedialVoxelBox & box);

  const MedialVoxelBox &
  GetBox() const
  {
    return m_Box;
  }

  /** Set the box and keep the bits that the old box and the new one share; others are zero. */
  void
  Reframe(const MedialVoxelBox & box);

  /** Set the box and take the bits that \a source has in it; others are zero. */
  void
  CopyFrom(const MedialVoxelSparseBits & source, const MedialVoxelBox & box);

  /** Invert the bit of a voxel of the box. */
  void
  Invert(const MedialVoxelIndex & index)
  {
    this->GetWord(index[0] / MedialVoxelBits::BitsPerWord, index[1], index[2]) ^=
      WordType{ 1 } << (index[0] % MedialVoxelBits::BitsPerWord);
  }

  /** Value of one voxel; false outside the box. */
  bool
  Test(const MedialVoxelIndex & index) const;

  /** Call \a visit(bits, word, y, z) for the bits of \a box, but for empty words; \a word counts from x = 0 on. */
  template <typename TVisitor>
  void
  VisitWords(const MedialVoxelBox & box, TVisitor && visit) const;

  /** Bytes that the bits have. */
  std::uint64_t
  GetReservedBytes() const;

  /** Bytes that the bits of a box take, at most, also while one is set. */
  static std::uint64_t
  GetBytes(const MedialVoxelBox & box);

private:
  static constexpr std::int64_t WordsPerBlock = 4;

  using Block = std::array<WordType, WordsPerBlock>;

  /** Nothing as long as no bit was set. */
  struct Slice
  {
    std::vector<std::uint32_t> numbers; ///< of the block of each place in the slice, from 1 on; 0 is a block of zeros
    std::vector<Block>         blocks;
  };

  /** Places for blocks along a row of the image that \a box has voxels of. */
  static std::int64_t
  BlocksPerRow(const MedialVoxelBox & box);

  static std::size_t
  BlocksPerSlice(const MedialVoxelBox & box);

  bool
  HasSameSlices(const MedialVoxelBox & box) const;

  std::size_t
  PlaceOf(std::int64_t word, std::int64_t y) const;

  /** The word, counted from x = 0 on, with memory for it. */
  WordType &
  GetWord(std::int64_t word, std::int64_t y, std::int64_t z);

  MedialVoxelBox     m_Box;
  std::vector<Slice> m_Slices;
};

template <typename TVisitor>
void
MedialVoxelSparseBits::VisitWords(const MedialVoxelBox & box, TVisitor && visit) const
{
  const MedialVoxelBox clipped = box.Intersection(m_Box);
  if (clipped.IsEmpty())
  {
    return;
  }
  const std::int64_t firstWord = clipped.lower[0] / MedialVoxelBits::BitsPerWord;
  const std::int64_t lastWord = (clipped.upper[0] - 1) / MedialVoxelBits::BitsPerWord;
  for (std::int64_t z = clipped.lower[2]; z < clipped.upper[2]; ++z)
  {
    const Slice & slice = m_Slices[static_cast<std::size_t>(z - m_Box.lower[2])];
    for (std::int64_t y = clipped.lower[1]; y < clipped.upper[1] && !slice.blocks.empty(); ++y)
    {
      for (std::int64_t word = firstWord; word <= lastWord; ++word)
      {
        const std::uint32_t number = slice.numbers[this->PlaceOf(word, y)];
        if (number == 0)
        {
          word |= WordsPerBlock - 1;
          continue;
        }
        const WordType bits = slice.blocks[number - 1][static_cast<std::size_t>(word % WordsPerBlock)] &
                              MedialVoxelBits::RangeMask(word, clipped.lower[0], clipped.upper[0]);
        if (bits != 0)
        {
          visit(bits, word, y, z);
        }
      }
    }
  }
}

} // end namespace itk

#endif
