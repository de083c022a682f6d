// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLanes_h
#define itkMedialVoxelLanes_h

#include "itkMedialVoxelProcessors.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>

namespace itk
{

#if defined(__GNUC__) && !defined(MEDIALVOXEL_PLAIN_LANES)
// All functions are inlined, so that no two versions have to agree on how to return vectors.
#  pragma GCC diagnostic ignored "-Wpsabi"
template <typename TValue, std::size_t VNumber>
struct MedialVoxelVector
{
  using Type [[gnu::vector_size(VNumber * sizeof(TValue))]] = TValue;
};

/** Numbers that are computed side by side. Compilers would split loops over them into single ones. */
template <typename TValue, std::size_t VNumber>
using MedialVoxelLanesOf = typename MedialVoxelVector<TValue, VNumber>::Type;

template <typename TCondition, typename TLanes>
MEDIALVOXEL_INLINE TLanes
MedialVoxelSelect(const TCondition & condition, const TLanes & yes, const TLanes & no)
{
  return condition ? yes : no;
}

template <typename TTo, typename TFrom>
MEDIALVOXEL_INLINE TTo
MedialVoxelConvert(const TFrom & lanes)
{
  return __builtin_convertvector(lanes, TTo);
}
#else
/** The same for compilers without vectors; single numbers have the type of the lanes. */
template <typename TValue, std::size_t VNumber>
class MedialVoxelPlainLanes
{
public:
  MedialVoxelPlainLanes() = default;

  MedialVoxelPlainLanes(const TValue value) { m_Values.fill(value); }

  TValue &
  operator[](const std::size_t i)
  {
    return m_Values[i];
  }

  TValue
  operator[](const std::size_t i) const
  {
    return m_Values[i];
  }

  /** operation(a, b) of each lane. */
  template <typename TResult, typename TOperation>
  static MedialVoxelPlainLanes<TResult, VNumber>
  Combine(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b, TOperation && operation)
  {
    MedialVoxelPlainLanes<TResult, VNumber> result;
    for (std::size_t i = 0; i < VNumber; ++i)
    {
      result[i] = operation(a[i], b[i]);
    }
    return result;
  }

  /** The numbers of another type, rounded to zero. */
  template <typename TOther>
  static MedialVoxelPlainLanes
  From(const MedialVoxelPlainLanes<TOther, VNumber> & other)
  {
    MedialVoxelPlainLanes result;
    for (std::size_t i = 0; i < VNumber; ++i)
    {
      result[i] = static_cast<TValue>(other[i]);
    }
    return result;
  }

  friend MedialVoxelPlainLanes
  operator+(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<TValue>(a, b, std::plus<>());
  }

  friend MedialVoxelPlainLanes
  operator-(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<TValue>(a, b, std::minus<>());
  }

  friend MedialVoxelPlainLanes
  operator*(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<TValue>(a, b, std::multiplies<>());
  }

  friend MedialVoxelPlainLanes
  operator/(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<TValue>(a, b, std::divides<>());
  }

  friend MedialVoxelPlainLanes
  operator&(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<TValue>(a, b, std::bit_and<>());
  }

  friend MedialVoxelPlainLanes
  operator<<(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<TValue>(a, b, [](const TValue x, const TValue y) { return x << y; });
  }

  friend MedialVoxelPlainLanes<std::int32_t, VNumber>
  operator<(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<std::int32_t>(a, b, [](const TValue x, const TValue y) { return x < y ? -1 : 0; });
  }

  friend MedialVoxelPlainLanes<std::int32_t, VNumber>
  operator>(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return b < a;
  }

  friend MedialVoxelPlainLanes<std::int32_t, VNumber>
  operator<=(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<std::int32_t>(a, b, [](const TValue x, const TValue y) { return x <= y ? -1 : 0; });
  }

  friend MedialVoxelPlainLanes<std::int32_t, VNumber>
  operator!=(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<std::int32_t>(a, b, [](const TValue x, const TValue y) { return x != y ? -1 : 0; });
  }

  MedialVoxelPlainLanes
  operator-() const
  {
    return Combine<TValue>(*this, *this, [](const TValue x, TValue) { return -x; });
  }

  MedialVoxelPlainLanes &
  operator+=(const MedialVoxelPlainLanes & other)
  {
    return *this = *this + other;
  }

  MedialVoxelPlainLanes &
  operator-=(const MedialVoxelPlainLanes & other)
  {
    return *this = *this - other;
  }

  MedialVoxelPlainLanes &
  operator*=(const MedialVoxelPlainLanes & other)
  {
    return *this = *this * other;
  }

private:
  std::array<TValue, VNumber> m_Values{};
};

template <typename TValue, std::size_t VNumber>
using MedialVoxelLanesOf = MedialVoxelPlainLanes<TValue, VNumber>;

template <typename TValue, std::size_t VNumber>
inline MedialVoxelPlainLanes<TValue, VNumber>
MedialVoxelSelect(const MedialVoxelPlainLanes<std::int32_t, VNumber> & condition,
                  const MedialVoxelPlainLanes<TValue, VNumber> &       yes,
                  const MedialVoxelPlainLanes<TValue, VNumber> &       no)
{
  MedialVoxelPlainLanes<TValue, VNumber> result;
  for (std::size_t i = 0; i < VNumber; ++i)
  {
    result[i] = condition[i] != 0 ? yes[i] : no[i];
  }
  return result;
}

template <typename TTo, typename TFrom>
inline TTo
MedialVoxelConvert(const TFrom & lanes)
{
  return TTo::From(lanes);
}
#endif

/** Those of most kernels, and the whole numbers of as many bytes. */
constexpr std::size_t MedialVoxelNumberOfLanes = 8;
using MedialVoxelLanes = MedialVoxelLanesOf<float, MedialVoxelNumberOfLanes>;
using MedialVoxelIntegerLanes = MedialVoxelLanesOf<std::int32_t, MedialVoxelNumberOfLanes>;

/** 2 to the power of exponents from -126 to 127, from the bits of a number. */
MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelPowerOfTwo(const MedialVoxelIntegerLanes & exponents)
{
  const MedialVoxelIntegerLanes bits = (exponents + 127) << 23;
  MedialVoxelLanes              powers;
  static_assert(sizeof(powers) == sizeof(bits));
  std::memcpy(static_cast<void *>(&powers), &bits, sizeof(powers));
  return powers;
}

template <typename TLanes = MedialVoxelLanes, typename TValue>
MEDIALVOXEL_INLINE TLanes
MedialVoxelLoad(const TValue * const from)
{
  TLanes lanes;
  std::memcpy(static_cast<void *>(&lanes), from, sizeof(lanes));
  return lanes;
}

/** In a fixed order. */
MEDIALVOXEL_INLINE double
MedialVoxelSumOf(const MedialVoxelLanes & lanes)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < MedialVoxelNumberOfLanes; ++i)
  {
    sum += static_cast<double>(lanes[i]);
  }
  return sum;
}

} // end namespace itk

#endif
