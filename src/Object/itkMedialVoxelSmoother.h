// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSmoother_h
#define itkMedialVoxelSmoother_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelRows.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

namespace itk
{

/** \brief Numbers of the smoothing F = 3 B^2 - 2 B^4, where B is the binomial step [1 2 1] / 4 along each axis.
 *
 * F removes noise and leaves edges and thin walls in place, since it has the same first three moments as no smoothing.
 * Beyond its faces the image is mirrored. Values are integers times Scale.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSmoothingNumbers
{
  static constexpr std::int64_t Margin = 4;                      ///< voxels along each axis that F depends on
  static constexpr std::int64_t ScaleOfTwo = 1 << 12;            ///< of B^2
  static constexpr std::int64_t Scale = std::int64_t{ 1 } << 24; ///< of B^4 and F

  static constexpr std::int64_t RowsOfStrip = 32;
  static constexpr std::int64_t SlicesOfStrip = 64;

  /** The voxels that F in \a box depends on. */
  static MedialVoxelBox
  GetInputBox(const MedialVoxelBox & box, const MedialVoxelBox & image)
  {
    return box.Expanded({ Margin, Margin, Margin }).Intersection(image);
  }

  /** The index from 0 to \a length - 1 that a mirrored image has at \a index. */
  static std::int64_t
  Mirror(std::int64_t index, const std::int64_t length)
  {
    const std::int64_t period = 2 * length;
    index = ((index % period) + period) % period;
    return index < length ? index : period - 1 - index;
  }
};

/** \brief Call \a function(part) for strips of \a rows rows in a few slices of \a box, each of which is best read
 * together with its margin: this needs little memory and reads few voxels twice.
 * \ingroup MedialVoxel
 */
template <typename TFunction>
void
MedialVoxelForEachStrip(const MedialVoxelBox & box, const std::int64_t rows, TFunction && function)
{
  constexpr std::int64_t slices = MedialVoxelSmoothingNumbers::SlicesOfStrip;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; z += slices)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1];)
    {
      MedialVoxelBox part = box;
      part.lower[1] = y;
      part.lower[2] = z;
      part.upper[1] = std::min((y / rows + 1) * rows, box.upper[1]);
      part.upper[2] = std::min(z + slices, box.upper[2]);
      function(part);
      y = part.upper[1];
    }
  }
}

/** \class MedialVoxelMaskSmoothing
 * \brief The mask of a predicate is smoothed, and values of at least one half become object.
 * \ingroup MedialVoxel
 */
template <typename TPixel>
class MedialVoxelMaskSmoothing
{
public:
  using FirstType = std::int32_t; ///< up to B^2
  using ThirdType = std::int32_t; ///< beyond
  using SumType = std::int32_t;   ///< of F

  explicit MedialVoxelMaskSmoothing(const MedialVoxelObjectPredicate<TPixel> & predicate)
    : m_Predicate(predicate)
  {}

  void
  GetValues(const TPixel * pixels, std::int64_t count, FirstType * values) const
  {
    // Comparisons to bytes and their widening are two loops, each of which compilers vectorize. Bytes might be a part
    // of this object, but not of a copy.
    const MedialVoxelObjectPredicate<TPixel> predicate = m_Predicate;
    constexpr std::int64_t                   most = 64;
    for (; count > 0; count -= most, pixels += most, values += most)
    {
      const std::int64_t number = std::min(count, most);
      std::uint8_t       fulfilled[most] = {};
      for (std::int64_t i = 0; i < number; ++i)
      {
        fulfilled[i] = predicate(pixels[i]) ? 1 : 0;
      }
      std::copy_n(fulfilled, number, values);
    }
  }

  bool
  operator()(const SumType sum) const
  {
    return sum >= static_cast<SumType>(MedialVoxelSmoothingNumbers::Scale / 2);
  }

  SumType
  GetSumOfBackground() const
  {
    return 0;
  }

private:
  MedialVoxelObjectPredicate<TPixel> m_Predicate;
};

/** \class MedialVoxelValueSmoothing
 * \brief Values are smoothed and compared with a threshold.
 *
 * Exact for integers of up to 32 bits; others are doubles, which are added in one order. Values that are not finite
 * count as the threshold, which favors no side; NaN stays background.
 * \ingroup MedialVoxel
 */
template <typename TPixel>
class MedialVoxelValueSmoothing
{
public:
  static constexpr bool IsShort = std::is_integral<TPixel>::value && sizeof(TPixel) <= 2;
  static constexpr bool IsLong = std::is_integral<TPixel>::value && sizeof(TPixel) == 4;

  using SumType = std::conditional_t<IsLong, std::int64_t, double>;
  using FirstType = std::conditional_t<IsShort, std::int32_t, SumType>;
  using ThirdType = std::conditional_t<sizeof(TPixel) == 1, std::int32_t, SumType>;

  /** Object are the values from a finite \a threshold on, or those up to it. */
  MedialVoxelValueSmoothing(const double threshold, const bool objectIsAbove)
    : m_Sign(objectIsAbove ? 1 : -1)
    , m_Threshold(threshold)
    , m_Limit(static_cast<SumType>(threshold * static_cast<double>(MedialVoxelSmoothingNumbers::Scale)))
  {}

  void
  GetValues(const TPixel * const pixels, const std::int64_t count, FirstType * const values) const
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      if constexpr (std::is_floating_point<TPixel>::value)
      {
        values[i] = std::isfinite(pixels[i]) ? static_cast<FirstType>(pixels[i]) : m_Threshold;
      }
      else
      {
        values[i] = static_cast<FirstType>(pixels[i]);
      }
    }
  }

  bool
  operator()(const SumType sum) const
  {
    return m_Sign > 0 ? sum >= m_Limit : sum <= m_Limit;
  }

  SumType
  GetSumOfBackground() const
  {
    return m_Sign > 0 ? std::numeric_limits<SumType>::lowest() : std::numeric_limits<SumType>::max();
  }

private:
  int     m_Sign;
  double  m_Threshold;
  SumType m_Limit;
};

/** \class MedialVoxelSmoother
 * \brief The object bits of the smoothed values of a box. One thread has one.
 *
 * \tparam TRule MedialVoxelMaskSmoothing or MedialVoxelValueSmoothing
 * \ingroup MedialVoxel
 */
template <typename TPixel, typename TRule>
class MedialVoxelSmoother
{
public:
  using Numbers = MedialVoxelSmoothingNumbers;

  MedialVoxelSmoother(const MedialVoxelBox & image, const TRule & rule)
    : m_Image(image)
    , m_Rule(rule)
  {}

  /** Set the bits of the object voxels of \a box, which are clear.
   * \param first the pixel of the lowest voxel of Numbers::GetInputBox(), all of which is there
   * \param strides of the pixels */
  void
  Run(const TPixel * first, const MedialVoxelStrides & strides, const MedialVoxelBox & box, MedialVoxelBits & object);

  /** Bytes that the smoother takes. */
  static constexpr std::uint64_t
  GetBytes()
  {
    constexpr std::uint64_t voxels = (LargestX + 2 * Numbers::Margin) * (LargestY + 2 * Numbers::Margin);
    return voxels * (9 * sizeof(FirstType) + 5 * sizeof(ThirdType) + sizeof(SumType));
  }

private:
  using FirstType = typename TRule::FirstType;
  using ThirdType = typename TRule::ThirdType;
  using SumType = typename TRule::SumType;

  /** Voxels that are smoothed together fit a cache. */
  static constexpr std::int64_t LargestX = 512;
  static constexpr std::int64_t LargestY = 32;

  /** Values of a slice of the block and of some voxels around it. */
  template <typename TValue>
  struct Slice
  {
    std::vector<TValue> values;
    bool                areEqual{ false }; ///< all of them

    void
    SetAll(const TValue value)
    {
      std::fill(values.begin(), values.end(), value);
      areEqual = true;
    }
  };

  struct View
  {
    const TPixel *     first;
    MedialVoxelStrides strides;
    MedialVoxelBox     box;
  };

  void
  RunBlock(const View & view, const MedialVoxelBox & block, MedialVoxelBits & object);

  /** Reads the values of a slice and of Margin voxels around it. */
  void
  Load(const View & view, const MedialVoxelBox & block, std::int64_t z);

  /** (1 4 6 4 1) along x and y; the result has two voxels less on each side. */
  template <typename TIn, typename TOut>
  static void
  SmoothSlice(const Slice<TIn> &  in,
              std::int64_t        width,
              std::int64_t        height,
              std::vector<TOut> & row,
              Slice<TOut> &       out);

  /** Sets the bits of the slice that the last five slices of m_Third lie around. */
  void
  SetObject(const View & view, const MedialVoxelBox & block, std::int64_t step, MedialVoxelBits & object);

  /** F of B^2 and B^4. */
  static SumType
  AddUp(const FirstType two, const SumType four)
  {
    return static_cast<SumType>(3 * Numbers::ScaleOfTwo) * static_cast<SumType>(two) - 2 * four;
  }

  /** (1 4 6 4 1) of five values; symmetric, so that a mirrored image has the same results. */
  template <typename TOut, typename TIn>
  static TOut
  Weigh(const TIn a, const TIn b, const TIn c, const TIn d, const TIn e)
  {
    return (static_cast<TOut>(a) + static_cast<TOut>(e)) + 4 * (static_cast<TOut>(b) + static_cast<TOut>(d)) +
           6 * static_cast<TOut>(c);
  }

  /** True when all values of all slices are the same. */
  template <typename TValue, std::size_t VNumber>
  static bool
  AreEqual(const Slice<TValue> (&slices)[VNumber])
  {
    return std::all_of(std::begin(slices), std::end(slices), [&slices](const Slice<TValue> & slice) {
      return slice.areEqual && !(slice.values.front() != slices[0].values.front());
    });
  }

  static constexpr std::int64_t NumberOfTaps = 5;
  static constexpr std::int64_t NumberOfTwice = 3;

  MedialVoxelBox         m_Image;
  TRule                  m_Rule;
  Slice<FirstType>       m_Loaded;
  Slice<FirstType>       m_Once[NumberOfTaps];   ///< smoothed along x and y
  Slice<FirstType>       m_Twice[NumberOfTwice]; ///< B^2
  Slice<ThirdType>       m_Third[NumberOfTaps];  ///< B^2, smoothed along x and y
  std::vector<FirstType> m_FirstRow;
  std::vector<ThirdType> m_ThirdRow;
  std::vector<SumType>   m_Sums;
};

} // end namespace itk

#include "itkMedialVoxelSmoother.hxx"

#endif
