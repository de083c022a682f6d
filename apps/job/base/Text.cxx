// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Text.h"

#include "Clock.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <regex>

namespace medialvoxel
{
std::optional<std::uint64_t>
ParseByteSize(std::string_view text)
{
  const std::string_view units = "kmgt";
  const std::string      lower = ToLower(std::string(text));
  const size_t           end = std::min(lower.find_first_of(units), lower.size());
  const size_t           unit = end < lower.size() ? units.find(lower[end]) : std::string_view::npos;
  const std::string      rest = lower.substr(std::min(end + 1, lower.size()));
  if (rest != "" && rest != "b" && rest != "ib")
  {
    return std::nullopt;
  }
  const double factor = unit == std::string_view::npos ? 1.0 : std::ldexp(1.0, static_cast<int>(10 * (unit + 1)));
  const std::optional<double> number = ParseDouble(lower.substr(0, end));
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
  return FormatFixed(seconds, 1) + " s";
}

std::string
FormatScientific(double value, int decimals)
{
  std::array<char, 64> text{};
  const auto           end = text.data() + text.size();
  return { text.data(), std::to_chars(text.data(), end, value, std::chars_format::scientific, decimals).ptr };
}

double
GetPowerOfTen(int exponent)
{
  return *ParseDouble("1e" + std::to_string(exponent));
}

double
GetPowerOfTenUpTo(double value)
{
  constexpr int     mostDecimals = 16; // with fewer, 9.99... may become 10
  const std::string text = FormatScientific(value, mostDecimals);
  return *ParseDouble("1" + text.substr(text.find('e')));
}

std::string
FormatShort(double value, int digits)
{
  constexpr double mostInFull = 1e9;
  const double     size = std::fabs(value);
  const bool       isInFull = size < mostInFull && size >= GetPowerOfTen(digits) - 0.5;
  if (isInFull)
  {
    return FormatFixed(value, 0);
  }
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

std::string
FormatFixed(double value, int decimals)
{
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string
FormatPercent(std::uint64_t count, std::uint64_t all)
{
  return FormatFixed(100.0 * static_cast<double>(count) / static_cast<double>(all), 2) + " %";
}

std::string
FormatSize(const std::vector<std::uint64_t> & size)
{
  return Join(size, " x ", [](std::uint64_t value) { return std::to_string(value); });
}

std::string
GetTime()
{
  const auto           now = std::chrono::system_clock::now().time_since_epoch();
  const auto           milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
  const std::time_t    seconds = milliseconds / 1000;
  const std::tm        parts = GetUniversalTime(seconds);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S.", &parts);
  const std::string fraction = std::to_string(1000 + milliseconds % 1000);
  return text.data() + fraction.substr(1) + "Z";
}

std::string
RemoveOrigin(const std::string & description)
{
  static const std::regex origin(R"(ITK ERROR: \w+\((0x)?[0-9a-fA-F]+\): )");
  return std::regex_replace(description, origin, "", std::regex_constants::match_continuous);
}

} // end namespace medialvoxel
