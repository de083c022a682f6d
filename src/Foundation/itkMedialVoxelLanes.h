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

/** Numbers that are computed side by side. Compilers would split loops over them into single ones. */
constexpr std::size_t MedialVoxelNumberOfLanes = 8;

#if defined(__GNUC__) && !defined(MEDIALVOXEL_PLAIN_LANES)
// All functions are inlined, so that no two versions have to agree on how to return vectors.
#  pragma GCC diagnostic ignored "-Wpsabi"
using MedialVoxelLanes [[gnu::vector_size(MedialVoxelNumberOfLanes * sizeof(float))]] = float;
using MedialVoxelIntegerLanes [[gnu::vector_size(MedialVoxelNumberOfLanes * sizeof(float))]] = std::int32_t;

MEDIALVOXEL_INLINE MedialVoxelIntegerLanes
MedialVoxelTruncate(const MedialVoxelLanes & lanes)
{
  return __builtin_convertvector(lanes, MedialVoxelIntegerLanes);
}

MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelToFloat(const MedialVoxelIntegerLanes & lanes)
{
  return __builtin_convertvector(lanes, MedialVoxelLanes);
}

MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelSelect(const MedialVoxelIntegerLanes & condition, const MedialVoxelLanes & yes, const MedialVoxelLanes & no)
{
  return condition ? yes : no;
}
#else
/** The same for compilers without vectors; single numbers have the type of the lanes. */
template <typename TValue>
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
  static MedialVoxelPlainLanes<TResult>
  Combine(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b, TOperation && operation)
  {
    MedialVoxelPlainLanes<TResult> result;
    for (std::size_t i = 0; i < MedialVoxelNumberOfLanes; ++i)
    {
      result[i] = operation(a[i], b[i]);
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
  operator<<(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<TValue>(a, b, [](const TValue x, const TValue y) { return x << y; });
  }

  friend MedialVoxelPlainLanes<std::int32_t>
  operator<(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<std::int32_t>(a, b, [](const TValue x, const TValue y) { return x < y ? -1 : 0; });
  }

  friend MedialVoxelPlainLanes<std::int32_t>
  operator>(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return b < a;
  }

  friend MedialVoxelPlainLanes<std::int32_t>
  operator<=(const MedialVoxelPlainLanes & a, const MedialVoxelPlainLanes & b)
  {
    return Combine<std::int32_t>(a, b, [](const TValue x, const TValue y) { return x <= y ? -1 : 0; });
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
  std::array<TValue, MedialVoxelNumberOfLanes> m_Values{};
};

using MedialVoxelLanes = MedialVoxelPlainLanes<float>;
using MedialVoxelIntegerLanes = MedialVoxelPlainLanes<std::int32_t>;

inline MedialVoxelIntegerLanes
MedialVoxelTruncate(const MedialVoxelLanes & lanes)
{
  MedialVoxelIntegerLanes result;
  for (std::size_t i = 0; i < MedialVoxelNumberOfLanes; ++i)
  {
    result[i] = static_cast<std::int32_t>(lanes[i]);
  }
  return result;
}

inline MedialVoxelLanes
MedialVoxelToFloat(const MedialVoxelIntegerLanes & lanes)
{
  MedialVoxelLanes result;
  for (std::size_t i = 0; i < MedialVoxelNumberOfLanes; ++i)
  {
    result[i] = static_cast<float>(lanes[i]);
  }
  return result;
}

inline MedialVoxelLanes
MedialVoxelSelect(const MedialVoxelIntegerLanes & condition, const MedialVoxelLanes & yes, const MedialVoxelLanes & no)
{
  MedialVoxelLanes result;
  for (std::size_t i = 0; i < MedialVoxelNumberOfLanes; ++i)
  {
    result[i] = condition[i] != 0 ? yes[i] : no[i];
  }
  return result;
}
#endif

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

MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelLoad(const float * const from)
{
  MedialVoxelLanes lanes;
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
