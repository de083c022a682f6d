// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSealedJson_h
#define medialvoxelSealedJson_h

#include "Json.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Writes a file that is complete and on the disk when it appears, in place of one that is there.
 * \throw JobError Failure */
void
WriteDurably(const std::filesystem::path & fileName, const std::string & text);

/** Writes a JSON object with the checksum of all else as its last member, as WriteDurably().
 * \throw JobError Usage when a text in it is not valid UTF-8 */
void
WriteSealed(const std::filesystem::path & fileName, Json object);

/** The object of a file of WriteSealed(), without the checksum; nothing when the file does not exist.
 * \throw JobError Failure for a file that cannot be read, is damaged or was changed */
std::optional<Json>
ReadSealed(const std::filesystem::path & fileName);

/** A whole number of JSON; the library would silently convert others.
 * \throw std::invalid_argument for other values, and beyond the range of the type */
template <typename TInteger>
void
ReadWhole(const Json & value, TInteger & number)
{
  using Limits = std::numeric_limits<TInteger>;
  const auto fitsUp = [](std::uint64_t whole) { return whole <= static_cast<std::uint64_t>(Limits::max()); };
  const auto fitsDown = [](std::int64_t whole) { return whole >= static_cast<std::int64_t>(Limits::lowest()); };
  const bool isWhole = value.is_number_integer();
  const bool isNegative = isWhole && !value.is_number_unsigned() && value.get<std::int64_t>() < 0;
  const bool fits = isWhole && (isNegative ? fitsDown(value.get<std::int64_t>()) : fitsUp(value.get<std::uint64_t>()));
  if (!fits)
  {
    throw std::invalid_argument(value.dump() + " is not a whole number in range");
  }
  number = value.get<TInteger>();
}

/** The same of a value that may be null. */
template <typename TInteger>
void
ReadWhole(const Json & value, std::optional<TInteger> & number)
{
  number.reset();
  if (!value.is_null())
  {
    ReadWhole(value, number.emplace());
  }
}

} // end namespace medialvoxel

#endif
