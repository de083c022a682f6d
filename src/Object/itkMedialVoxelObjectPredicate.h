// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectPredicate_h
#define itkMedialVoxelObjectPredicate_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelExactNumber.h"
#include "itkMedialVoxelRows.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

namespace itk
{

/** \class MedialVoxelObjectPredicate
 * \brief Decides which pixel values are object, and packs rows of pixels to bits.
 *
 * Every value but the background value is object, or one value, or every value from a lower to an upper limit. Limits
 * are compared as numbers: between two values of the pixel type they act like the next value inside, and beyond the
 * range of the type like its end. NaN is never object.
 * \ingroup MedialVoxel
 */
template <typename TPixel>
class MedialVoxelObjectPredicate
{
public:
  static_assert(std::is_arithmetic<TPixel>::value, "The pixel type must be a scalar.");

  /** All values but \a background. */
  static MedialVoxelObjectPredicate
  DifferentFrom(const TPixel background)
  {
    MedialVoxelObjectPredicate predicate;
    predicate.m_IsRange = false;
    predicate.m_Lower = background;
    return predicate;
  }

  /** Exactly \a value, even where it is no double. */
  static MedialVoxelObjectPredicate
  EqualTo(const TPixel value)
  {
    MedialVoxelObjectPredicate predicate;
    predicate.m_IsRange = true;
    predicate.m_Lower = value;
    predicate.m_Upper = value;
    return predicate;
  }

  /** The values v with lower <= v <= upper. */
  static MedialVoxelObjectPredicate
  InRange(const MedialVoxelExactNumber & lower, const MedialVoxelExactNumber & upper)
  {
    MedialVoxelObjectPredicate predicate;
    predicate.m_IsRange = true;
    if constexpr (std::is_floating_point<TPixel>::value)
    {
      predicate.m_Lower = lower.GetFirstDouble();
      predicate.m_Upper = upper.GetLastDouble();
    }
    else
    {
      using Limits = std::numeric_limits<TPixel>;
      const std::optional<TPixel> first = lower.GetFirstValue<TPixel>();
      const std::optional<TPixel> last = upper.GetLastValue<TPixel>();
      // An empty range is written as one that no value fulfills.
      const bool isEmpty = !first || !last;
      predicate.m_Lower = isEmpty ? Limits::max() : *first;
      predicate.m_Upper = isEmpty ? Limits::lowest() : *last;
    }
    return predicate;
  }

  bool
  operator()(const TPixel value) const
  {
    return m_IsRange ? (value >= m_Lower && value <= m_Upper) : (value != m_Lower && value == value);
  }

private:
  using LimitType = std::conditional_t<std::is_floating_point<TPixel>::value, double, TPixel>;

  bool      m_IsRange{ false };
  LimitType m_Lower{};
  LimitType m_Upper{};
};

/** \brief True when all bytes of \a count pixels are zero, so that all numbers are 0.
 * \ingroup MedialVoxel
 */
template <typename TPixel>
bool
MedialVoxelAreAllZero(const TPixel * const pixels, const std::int64_t count)
{
  constexpr std::size_t bytesPerWord = sizeof(std::uint64_t);
  const auto * const    bytes = reinterpret_cast<const unsigned char *>(pixels);
  const std::size_t     numberOfBytes = static_cast<std::size_t>(count) * sizeof(TPixel);
  std::uint64_t         any = 0;
  std::size_t           at = 0;
  for (; at + bytesPerWord <= numberOfBytes; at += bytesPerWord)
  {
    std::uint64_t word;
    std::memcpy(&word, bytes + at, bytesPerWord);
    any |= word;
  }
  for (; at < numberOfBytes; ++at)
  {
    any |= bytes[at];
  }
  return any == 0;
}

/** \brief Set the bits of the pixels that fulfill \a predicate, for \a count pixels the first of which is voxel \a x.
 *
 * \a row points to where image-wide word 0 would be. Bits are only set, never cleared.
 * \ingroup MedialVoxel
 */
template <typename TPixel, typename TPredicate>
void
MedialVoxelPackRow(const TPixel *                    pixels,
                   const std::int64_t                x,
                   const std::int64_t                count,
                   const TPredicate &                predicate,
                   MedialVoxelBits::WordType * const row)
{
  constexpr std::int64_t bitsPerWord = MedialVoxelBits::BitsPerWord;
  constexpr std::int64_t bitsPerByte = 8;
  const std::int64_t     end = x + count;
  // Most of a volume is zero; comparing whole words finds that quickly.
  const bool skipsZeros = !predicate(TPixel{});
  for (std::int64_t begin = x; begin < end;)
  {
    const std::int64_t word = begin / bitsPerWord;
    const std::int64_t wordEnd = std::min((word + 1) * bitsPerWord, end);
    const std::int64_t first = begin % bitsPerWord;
    if (skipsZeros && MedialVoxelAreAllZero(pixels, wordEnd - begin))
    {
      pixels += wordEnd - begin;
      begin = wordEnd;
      continue;
    }
    // Comparisons to bytes and the gathering of bytes to bits are two loops, each of which compilers vectorize.
    std::uint8_t fulfilled[bitsPerWord] = {};
    for (std::int64_t i = 0; i < wordEnd - begin; ++i)
    {
      fulfilled[first + i] = predicate(pixels[i]) ? 1 : 0;
    }
    MedialVoxelBits::WordType bits = 0;
    for (std::int64_t byte = 0; byte < bitsPerByte; ++byte)
    {
      std::uint64_t eight = 0;
      for (std::int64_t i = 0; i < bitsPerByte; ++i)
      {
        eight |= std::uint64_t{ fulfilled[byte * bitsPerByte + i] } << (i * bitsPerByte);
      }
      // Moves the lowest bit of byte i to bit i of the topmost byte.
      bits |= ((eight * 0x0102040810204080u) >> 56) << (byte * bitsPerByte);
    }
    row[word] |= bits;
    pixels += wordEnd - begin;
    begin = wordEnd;
  }
}

/** \brief Set the bits of the voxels of \a box whose pixels fulfill \a predicate; the box begins at \a first.
 * \ingroup MedialVoxel
 */
template <typename TPixel, typename TPredicate>
void
MedialVoxelPackBox(const TPixel * const       first,
                   const MedialVoxelStrides & strides,
                   const MedialVoxelBox &     box,
                   const TPredicate &         predicate,
                   MedialVoxelBits &          bits)
{
  MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    MedialVoxelBits::WordType * const words = bits.GetRow(row.lower[1], row.lower[2]) - bits.GetFirstWord();
    MedialVoxelPackRow(first + offset, row.lower[0], row.Extent(0), predicate, words);
  });
}

/** \brief Set the values of the voxels of \a box, which begins at \a first.
 * \ingroup MedialVoxel
 */
template <typename TPixel>
void
MedialVoxelCopyBox(const TPixel * const       first,
                   const MedialVoxelStrides & strides,
                   const MedialVoxelBox &     box,
                   MedialVoxelGray &          gray)
{
  MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    float * const target = gray.GetRow(row.lower[1], row.lower[2]) + (row.lower[0] - gray.GetBox().lower[0]);
    std::transform(first + offset, first + offset + row.Extent(0), target, [](const TPixel value) {
      return static_cast<float>(value);
    });
  });
}

} // end namespace itk

#endif
