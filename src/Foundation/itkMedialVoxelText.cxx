// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelText.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

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
  return ParseWhole<double>(text);
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
