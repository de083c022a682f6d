// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelText_h
#define medialvoxelText_h

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace medialvoxel
{

/** The whole text as a number; nothing when any part of it is something else. */
std::optional<double>
ParseDouble(std::string_view text);
std::optional<std::int64_t>
ParseInteger(std::string_view text);

/** A number of bytes: digits, optionally with a fraction, and optionally K, M, G or T (powers of 1024). */
std::optional<std::uint64_t>
ParseByteSize(std::string_view text);

/** "1.5 GiB" and the like. */
std::string
FormatBytes(std::uint64_t numberOfBytes);

/** "12.3 s" and the like. */
std::string
FormatSeconds(double seconds);

/** Shortest text that reads back as the same number. */
std::string
FormatNumber(double value);

/** Without blanks and carriage returns at both ends. */
std::string
Trim(std::string_view text);

/** The parts between runs of blanks. */
std::vector<std::string>
SplitAtBlanks(std::string_view text);

std::string
ToLower(std::string_view text);

/** The values put together with a separator, such as "256 x 256 x 110". */
template <typename TRange, typename TFormat>
std::string
Join(const TRange & values, const std::string & separator, TFormat format)
{
  std::string text;
  for (const auto & value : values)
  {
    text += (text.empty() ? "" : separator) + format(value);
  }
  return text;
}

std::string
FormatSize(const std::vector<std::uint64_t> & size);
std::string
FormatNumbers(const std::vector<double> & values, const std::string & separator);

} // end namespace medialvoxel

#endif
