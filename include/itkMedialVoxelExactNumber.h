// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelExactNumber_h
#define itkMedialVoxelExactNumber_h

#include "MedialVoxelExport.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace itk
{

/** \class MedialVoxelExactNumber
 * \brief A number that is compared with pixel values exactly: any double, or any whole number of 64 bits.
 *
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelExactNumber
{
public:
  /** May be infinite, or NaN, which equals no value. */
  MedialVoxelExactNumber(const double value) // NOLINT(google-explicit-constructor): every double is a number
    : m_Nearest(value)
  {}

  /** Exact for all whole numbers. */
  template <typename TInteger, std::enable_if_t<std::is_integral<TInteger>::value, int> = 0>
  MedialVoxelExactNumber(const TInteger value) // NOLINT(google-explicit-constructor): and every integer
    : MedialVoxelExactNumber(value < TInteger{},
                             value < TInteger{} ? std::uint64_t{} - static_cast<std::uint64_t>(value)
                                                : static_cast<std::uint64_t>(value))
  {}

  /** The number of the whole \a text, exact for whole numbers of 64 bits; nothing when it is no number, or beyond 2^53
   * and with a fraction. */
  static std::optional<MedialVoxelExactNumber>
  Parse(std::string_view text);

  /** Text that reads back as the same number. */
  std::string
  Format() const;

  double
  GetNearestDouble() const
  {
    return m_Nearest;
  }

  /** True when a double holds the number. */
  bool
  IsDouble() const
  {
    return m_Rest == 0;
  }

  /** The number when it is not a double but a negative, or a not negative, whole number. */
  std::optional<std::int64_t>
  GetNegative() const;
  std::optional<std::uint64_t>
  GetWhole() const;

  bool
  IsNotANumber() const
  {
    return std::isnan(m_Nearest);
  }

  bool
  IsAbove(const MedialVoxelExactNumber & other) const
  {
    return m_Nearest > other.m_Nearest || (this->HasSameNearest(other) && m_Rest > other.m_Rest);
  }

  friend bool
  operator==(const MedialVoxelExactNumber & a, const MedialVoxelExactNumber & b)
  {
    return a.HasSameNearest(b) && a.m_Rest == b.m_Rest;
  }

  friend bool
  operator!=(const MedialVoxelExactNumber & a, const MedialVoxelExactNumber & b)
  {
    return !(a == b);
  }

  /** The smallest double that is not below the number, and the largest that is not above. */
  double
  GetFirstDouble() const
  {
    return m_Rest > 0 ? std::nextafter(m_Nearest, std::numeric_limits<double>::infinity()) : m_Nearest;
  }
  double
  GetLastDouble() const
  {
    return m_Rest < 0 ? std::nextafter(m_Nearest, -std::numeric_limits<double>::infinity()) : m_Nearest;
  }

  /** The smallest value of a type that is not below the number; nothing when all are. */
  template <typename TValue>
  std::optional<TValue>
  GetFirstValue() const;

  /** The largest value of a type that is not above the number; nothing when all are. */
  template <typename TValue>
  std::optional<TValue>
  GetLastValue() const;

private:
  MedialVoxelExactNumber(bool isNegative, std::uint64_t magnitude);

  bool
  HasSameNearest(const MedialVoxelExactNumber & other) const
  {
    return !(m_Nearest < other.m_Nearest) && !(m_Nearest > other.m_Nearest) && !this->IsNotANumber() &&
           !other.IsNotANumber();
  }

  /** -1, 0 or 1: the sum of a whole double and m_Rest is below, within or beyond the values of a type of integers. */
  template <typename TInteger>
  int
  CompareWithRange(double whole) const;

  /** The sum, which is within. */
  template <typename TInteger>
  TInteger
  AddRest(double whole) const;

  double       m_Nearest;
  std::int32_t m_Rest{ 0 }; ///< the number minus m_Nearest; 0 unless doubles are whole numbers there
};

template <typename TInteger>
int
MedialVoxelExactNumber::CompareWithRange(const double whole) const
{
  using Limits = std::numeric_limits<TInteger>;
  // Powers of two are exact in double, where the largest value of a 64-bit type is not.
  const double end = std::ldexp(1.0, Limits::digits);
  const double begin = Limits::is_signed ? -end : 0.0;
  const bool   isBelow = whole < begin || (whole <= begin && m_Rest < 0);
  const bool   isWithin = whole < end || (whole <= end && m_Rest < 0);
  return isBelow ? -1 : (isWithin ? 0 : 1);
}

template <typename TInteger>
TInteger
MedialVoxelExactNumber::AddRest(const double whole) const
{
  using Limits = std::numeric_limits<TInteger>;
  if (whole >= std::ldexp(1.0, Limits::digits))
  {
    return static_cast<TInteger>(Limits::max() - static_cast<TInteger>(-(m_Rest + 1)));
  }
  const auto value = static_cast<TInteger>(whole);
  return static_cast<TInteger>(m_Rest < 0 ? value - static_cast<TInteger>(-m_Rest)
                                          : value + static_cast<TInteger>(m_Rest));
}

template <typename TValue>
std::optional<TValue>
MedialVoxelExactNumber::GetFirstValue() const
{
  static_assert(std::is_integral<TValue>::value, "Other values are compared as doubles.");
  const double whole = std::ceil(m_Nearest);
  const int    place = this->IsNotANumber() ? 1 : this->CompareWithRange<TValue>(whole);
  if (place > 0)
  {
    return std::nullopt;
  }
  return place < 0 ? std::numeric_limits<TValue>::lowest() : this->AddRest<TValue>(whole);
}

template <typename TValue>
std::optional<TValue>
MedialVoxelExactNumber::GetLastValue() const
{
  static_assert(std::is_integral<TValue>::value, "Other values are compared as doubles.");
  const double whole = std::floor(m_Nearest);
  const int    place = this->IsNotANumber() ? -1 : this->CompareWithRange<TValue>(whole);
  if (place < 0)
  {
    return std::nullopt;
  }
  return place > 0 ? std::numeric_limits<TValue>::max() : this->AddRest<TValue>(whole);
}

} // end namespace itk

#endif
