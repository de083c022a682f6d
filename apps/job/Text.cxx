// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace medialvoxel
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
  return ParseWhole<double>(text);
}

std::optional<std::int64_t>
ParseInteger(std::string_view text)
{
  return ParseWhole<std::int64_t>(text);
}

std::optional<std::uint64_t>
ParseByteSize(std::string_view text)
{
  const std::string_view units = "KMGT";
  double                 factor = 1.0;
  if (!text.empty())
  {
    const size_t unit = units.find(static_cast<char>(std::toupper(static_cast<unsigned char>(text.back()))));
    if (unit != std::string_view::npos)
    {
      factor = std::ldexp(1.0, static_cast<int>(10 * (unit + 1)));
      text.remove_suffix(1);
    }
  }
  const std::optional<double> number = ParseDouble(text);
  if (!number || !(*number >= 0) || *number * factor >= std::ldexp(1.0, 63))
  {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(*number * factor);
}

std::string
FormatBytes(std::uint64_t numberOfBytes)
{
  constexpr std::array<const char *, 5> units{ "B", "KiB", "MiB", "GiB", "TiB" };
  double                                value = static_cast<double>(numberOfBytes);
  size_t                                unit = 0;
  while (value >= 1024.0 && unit + 1 < units.size())
  {
    value /= 1024.0;
    ++unit;
  }
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
  return text.data();
}

std::string
FormatSeconds(double seconds)
{
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", seconds);
  return text.data();
}

std::string
FormatNumber(double value)
{
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
FormatSize(const std::vector<std::uint64_t> & size)
{
  return Join(size, " x ", [](std::uint64_t value) { return std::to_string(value); });
}

std::string
FormatNumbers(const std::vector<double> & values, const std::string & separator)
{
  return Join(values, separator, FormatNumber);
}

} // end namespace medialvoxel
