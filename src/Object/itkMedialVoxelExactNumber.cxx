// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelExactNumber.h"

#include "itkMedialVoxelText.h"

#include <charconv>

namespace itk
{
namespace
{

/** Up to here every whole number is a double. */
constexpr std::uint64_t LargestOfDoubles = std::uint64_t{ 1 } << 53;

/** The smallest number of 64 bits, without its sign. */
constexpr std::uint64_t LargestOfNegative = std::uint64_t{ 1 } << 63;

} // namespace

MedialVoxelExactNumber::MedialVoxelExactNumber(const bool isNegative, const std::uint64_t magnitude)
  : m_Nearest(static_cast<double>(magnitude))
{
  // 2^64 is not a whole number of 64 bits: both differences are modulo 2^64.
  const bool          isEnd = m_Nearest >= std::ldexp(1.0, std::numeric_limits<std::uint64_t>::digits);
  const std::uint64_t nearest = isEnd ? 0 : static_cast<std::uint64_t>(m_Nearest);
  m_Rest = isEnd || magnitude < nearest ? -static_cast<std::int32_t>(nearest - magnitude)
                                        : static_cast<std::int32_t>(magnitude - nearest);
  if (isNegative)
  {
    m_Nearest = -m_Nearest;
    m_Rest = -m_Rest;
  }
}

std::optional<MedialVoxelExactNumber>
MedialVoxelExactNumber::Parse(const std::string_view text)
{
  const std::optional<double> nearest = MedialVoxelText::ParseDouble(text);
  if (!nearest || !(std::fabs(*nearest) >= static_cast<double>(LargestOfDoubles)))
  {
    return nearest ? std::optional<MedialVoxelExactNumber>(*nearest) : std::nullopt;
  }
  const std::size_t      signs = text.front() == '-' || text.front() == '+' ? 1 : 0;
  const std::string_view digits = text.substr(signs, text.find_first_not_of("0123456789", signs) - signs);
  const std::string_view fraction = text.substr(signs + digits.size());
  std::uint64_t          magnitude = 0;
  const auto             read = std::from_chars(digits.data(), digits.data() + digits.size(), magnitude);
  const bool             hasExponent = text.find_first_of("eE") != std::string_view::npos;
  const bool             isNegative = text.front() == '-';
  const bool             isBeyond = read.ec != std::errc() || (isNegative && magnitude > LargestOfNegative);
  if (digits.empty() || hasExponent || isBeyond)
  {
    return MedialVoxelExactNumber(*nearest);
  }
  if (fraction.find_first_not_of(".0") != std::string_view::npos)
  {
    return std::nullopt;
  }
  return MedialVoxelExactNumber(isNegative, magnitude);
}

std::string
MedialVoxelExactNumber::Format() const
{
  if (const auto whole = this->GetWhole())
  {
    return std::to_string(*whole);
  }
  const auto negative = this->GetNegative();
  return negative ? std::to_string(*negative) : MedialVoxelText::FormatNumber(m_Nearest);
}

std::optional<std::int64_t>
MedialVoxelExactNumber::GetNegative() const
{
  return this->IsDouble() || m_Nearest > 0 ? std::nullopt : this->GetFirstValue<std::int64_t>();
}

std::optional<std::uint64_t>
MedialVoxelExactNumber::GetWhole() const
{
  return this->IsDouble() || m_Nearest < 0 ? std::nullopt : this->GetFirstValue<std::uint64_t>();
}

} // end namespace itk
