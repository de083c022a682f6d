// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectPredicate_h
#define itkMedialVoxelObjectPredicate_h

#include "itkMedialVoxelBits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{

/** \class MedialVoxelObjectPredicate
 * \brief Which pixel values are object, and the packing of rows of pixels into bits.
 *
 * Either every value but the background value is object, or every value from a lower to an upper limit. Limits are
 * compared as numbers: between two values of the pixel type they act like the next value inside, and beyond the range
 * of the type like its end. NaN is never object.
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

  /** The values v with lower <= v <= upper. */
  static MedialVoxelObjectPredicate
  InRange(const double lower, const double upper)
  {
    MedialVoxelObjectPredicate predicate;
    predicate.m_IsRange = true;
    if constexpr (std::is_floating_point<TPixel>::value)
    {
      predicate.m_Lower = lower;
      predicate.m_Upper = upper;
    }
    else
    {
      using Limits = std::numeric_limits<TPixel>;
      // Powers of two are exact in double, where the largest value of a 64-bit type is not.
      const double end = std::ldexp(1.0, Limits::digits);
      const double begin = Limits::is_signed ? -end : 0.0;
      const double first = std::ceil(lower);
      const double last = std::floor(upper);
      const bool   isEmpty = !(first <= last) || first >= end || last < begin;
      // An empty range is written as one that no value fulfills.
      predicate.m_Lower = isEmpty ? Limits::max() : (first <= begin ? Limits::lowest() : static_cast<TPixel>(first));
      predicate.m_Upper = isEmpty ? Limits::lowest() : (last >= end ? Limits::max() : static_cast<TPixel>(last));
    }
    return predicate;
  }

  bool
  operator()(const TPixel value) const
  {
    return m_IsRange ? (value >= m_Lower && value <= m_Upper) : (value != m_Lower && value == value);
  }

  /** Set the bits of the object voxels among \a count pixels, the first of which is voxel \a x of the image.
   *
   * \a row points to where image-wide word 0 would be. */
  void
  PackRow(const TPixel * pixels, const std::int64_t x, const std::int64_t count, MedialVoxelBits::WordType * row) const
  {
    constexpr std::int64_t bitsPerWord = MedialVoxelBits::BitsPerWord;
    for (std::int64_t begin = x; begin < x + count;)
    {
      const std::int64_t        word = begin / bitsPerWord;
      const std::int64_t        end = std::min((word + 1) * bitsPerWord, x + count);
      MedialVoxelBits::WordType bits = 0;
      for (std::int64_t position = begin; position < end; ++position, ++pixels)
      {
        bits |= MedialVoxelBits::WordType{ (*this)(*pixels) } << (position % bitsPerWord);
      }
      row[word] |= bits;
      begin = end;
    }
  }

private:
  using LimitType = std::conditional_t<std::is_floating_point<TPixel>::value, double, TPixel>;

  bool      m_IsRange{ false };
  LimitType m_Lower{};
  LimitType m_Upper{};
};

} // end namespace itk

#endif
