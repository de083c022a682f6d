// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelText.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace itk
{
namespace MedialVoxelText
{
namespace
{

template <typename TNumber>
std::optional<TNumber>
ParseWhole(std::string_view text)
{
  if (text.size() > 1 && text.front() == '+' && text[1] != '-')
  {
    text.remove_prefix(1);
  }
  TNumber    value{};
  const auto last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last)
  {
    return std::nullopt;
  }
  return value;
}

bool
IsBlank(char character)
{
  return character == ' ' || character == '\t' || character == '\r';
}

} // namespace

std::optional<double>
ParseDouble(std::string_view text)
{
// libc++ has from_chars for real numbers from version 20 on, and macOS needs a newer system for it.
#if defined(__APPLE__) || (defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000)
  return ParseStreamedDouble(text);
#else
  return ParseWhole<double>(text);
#endif
}

std::optional<double>
ParseStreamedDouble(std::string_view text)
{
  const bool hasSign = !text.empty() && (text.front() == '-' || text.front() == '+');
  const bool isNegative = hasSign && text.front() == '-';
  text.remove_prefix(hasSign ? 1 : 0);
  const std::string name = ToLower(text);
  double            value = std::numeric_limits<double>::infinity();
  if (name == "nan")
  {
    value = std::numeric_limits<double>::quiet_NaN();
  }
  else if (name != "inf" && name != "infinity")
  {
    // A stream would take blanks, another sign and hexadecimal digits.
    const bool isDecimal = text.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
    if (text.empty() || !isDecimal || text.front() == '-' || text.front() == '+')
    {
      return std::nullopt;
    }
    std::istringstream stream{ std::string(text) };
    stream.imbue(std::locale::classic());
    const bool isZero = text.substr(0, text.find_first_of("eE")).find_first_of("123456789") == std::string_view::npos;
    if (!(stream >> value) || stream.peek() != std::istringstream::traits_type::eof() ||
        (!isZero && value < std::numeric_limits<double>::min()))
    {
      return std::nullopt;
    }
  }
  return isNegative ? -value : value;
}

std::optional<std::int64_t>
ParseInteger(std::string_view text)
{
  return ParseWhole<std::int64_t>(text);
}

std::string
FormatNumber(double value)
{
  if (std::isnan(value))
  {
    return "nan"; // without a sign, which tells nothing
  }
  std::array<char, 32> text{};
  const auto           result = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), result.ptr);
}

std::string
Trim(std::string_view text)
{
  while (!text.empty() && IsBlank(text.front()))
  {
    text.remove_prefix(1);
  }
  while (!text.empty() && IsBlank(text.back()))
  {
    text.remove_suffix(1);
  }
  return std::string(text);
}

std::vector<std::string>
SplitAtBlanks(std::string_view text)
{
  std::vector<std::string> parts;
  while (true)
  {
    const auto first = std::find_if_not(text.begin(), text.end(), IsBlank);
    const auto last = std::find_if(first, text.end(), IsBlank);
    if (first == last)
    {
      return parts;
    }
    parts.emplace_back(first, last);
    text.remove_prefix(static_cast<size_t>(last - text.begin()));
  }
}

std::string
ToLower(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

std::string
FormatNumbers(const std::vector<double> & values, const std::string & separator)
{
  return Join(values, separator, FormatNumber);
}

} // end namespace MedialVoxelText
} // end namespace itk
