// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectPredicate_h
#define itkMedialVoxelObjectPredicate_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelExactNumber.h"
#include "itkMedialVoxelRows.h"

#include <algorithm>
#include <cmath>
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
    MedialVoxelObjectPredicate predicate = EqualTo(background);
    predicate.m_IsInside = false;
    return predicate;
  }

  /** Exactly \a value, even where it is no double. */
  static MedialVoxelObjectPredicate
  EqualTo(const TPixel value)
  {
    return { value, value };
  }

  /** The values v with lower <= v <= upper. */
  static MedialVoxelObjectPredicate
  InRange(const MedialVoxelExactNumber & lower, const MedialVoxelExactNumber & upper)
  {
    if constexpr (std::is_floating_point<TPixel>::value)
    {
      return { FirstFrom(lower.GetFirstDouble()), -FirstFrom(-upper.GetLastDouble()) };
    }
    else
    {
      using Limits = std::numeric_limits<TPixel>;
      const std::optional<TPixel> first = lower.GetFirstValue<TPixel>();
      const std::optional<TPixel> last = upper.GetLastValue<TPixel>();
      if (first && last && *first <= *last)
      {
        return { *first, *last };
      }
      MedialVoxelObjectPredicate none{ Limits::lowest(), Limits::max() };
      none.m_IsInside = false;
      return none;
    }
  }

  /** Without branches, so that compilers make vectors of it. */
  bool
  operator()(const TPixel value) const
  {
    if constexpr (std::is_floating_point<TPixel>::value)
    {
      return m_IsInside ? (value >= m_Lower) & (value <= m_Upper) : (value != m_Lower) & (value == value);
    }
    else
    {
      // Below the lower limit the difference is larger than any width.
      using Unsigned = std::make_unsigned_t<TPixel>;
      const auto width = static_cast<Unsigned>(static_cast<Unsigned>(m_Upper) - static_cast<Unsigned>(m_Lower));
      return (static_cast<Unsigned>(static_cast<Unsigned>(value) - static_cast<Unsigned>(m_Lower)) <= width) == m_IsInside;
    }
  }

private:
  MedialVoxelObjectPredicate(const TPixel lower, const TPixel upper)
    : m_Lower(lower)
    , m_Upper(upper)
  {}

  /** The first value that is not less; infinity beyond all. */
  static TPixel
  FirstFrom(const double limit)
  {
    constexpr TPixel infinity = std::numeric_limits<TPixel>::infinity();
    constexpr TPixel largest = std::numeric_limits<TPixel>::max();
    if (limit > static_cast<double>(largest))
    {
      return infinity;
    }
    if (limit < -static_cast<double>(largest))
    {
      return limit < -std::numeric_limits<double>::max() ? -infinity : -largest;
    }
    const auto nearest = static_cast<TPixel>(limit);
    return static_cast<double>(nearest) < limit ? std::nextafter(nearest, infinity) : nearest;
  }

  TPixel m_Lower;
  TPixel m_Upper;
  bool   m_IsInside{ true };
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

/** \brief Bit i says whether pixel i of \a count, at most 64, fulfills \a predicate.
 *
 * \param predicate a copy, as writing bytes could change another one; compilers then make vectors of the first loop
 * \ingroup MedialVoxel
 */
template <typename TPixel, typename TPredicate>
MedialVoxelBits::WordType
MedialVoxelPackWord(const TPixel * const pixels, const std::int64_t count, const TPredicate predicate)
{
  constexpr std::int64_t bitsPerWord = MedialVoxelBits::BitsPerWord;
  constexpr std::int64_t bitsPerByte = 8;
  std::uint8_t           fulfilled[bitsPerWord];
  if (count == bitsPerWord)
  {
    for (std::int64_t i = 0; i < bitsPerWord; ++i)
    {
      fulfilled[i] = predicate(pixels[i]) ? 1 : 0;
    }
  }
  else
  {
    std::fill(std::transform(pixels, pixels + count, fulfilled, predicate), fulfilled + bitsPerWord, std::uint8_t{ 0 });
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
  return bits;
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
  const std::int64_t     end = x + count;
  // Most of a mask is zero; comparing whole words finds that quickly.
  const bool skipsZeros = !predicate(TPixel{});
  for (std::int64_t begin = x; begin < end;)
  {
    const std::int64_t word = begin / bitsPerWord;
    const std::int64_t pixelsOfWord = std::min((word + 1) * bitsPerWord, end) - begin;
    if (!skipsZeros || !MedialVoxelAreAllZero(pixels, pixelsOfWord))
    {
      row[word] |= MedialVoxelPackWord(pixels, pixelsOfWord, predicate) << (begin % bitsPerWord);
    }
    pixels += pixelsOfWord;
    begin += pixelsOfWord;
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
