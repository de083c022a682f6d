// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelText_h
#define medialvoxelText_h

#include "itkMedialVoxelText.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace medialvoxel
{

using itk::MedialVoxelText::FormatNumber;
using itk::MedialVoxelText::FormatNumbers;
using itk::MedialVoxelText::Join;
using itk::MedialVoxelText::ParseDouble;
using itk::MedialVoxelText::ParseInteger;
using itk::MedialVoxelText::SplitAtBlanks;
using itk::MedialVoxelText::ToLower;
using itk::MedialVoxelText::Trim;

/** Names and values to print. */
using TextTable = std::vector<std::pair<std::string, std::string>>;

/** A number of bytes: digits, optionally with a fraction, and optionally K, M, G or T (powers of 1024),
 * behind which B or iB may stand; in any case. */
std::optional<std::uint64_t>
ParseByteSize(std::string_view text);

/** "1.5 GiB" and the like. */
std::string
FormatBytes(std::uint64_t numberOfBytes);

/** "12.3 s" and the like. */
std::string
FormatSeconds(double seconds);

/** A digit, a point, so many decimals and a power of ten. */
std::string
FormatScientific(double value, int decimals);

/** 10^exponent, of exponents from -300 to 300. */
double
GetPowerOfTen(int exponent);

/** The largest power of ten up to a positive number. */
double
GetPowerOfTenUpTo(double value);

/** So many significant digits at most, and all of those before the point up to 10^9. */
std::string
FormatShort(double value, int digits = 4);

/** As many decimals as wanted. */
std::string
FormatFixed(double value, int decimals);

/** "12.34 %" of all, which are not none. */
std::string
FormatPercent(std::uint64_t count, std::uint64_t all);

std::string
FormatSize(const std::vector<std::uint64_t> & size);

/** Now, as 2026-11-22T01:02:03.456Z. */
std::string
GetTime();

/** The description of an exception of ITK without the class and address of the object that it comes from. */
std::string
RemoveOrigin(const std::string & description);

} // end namespace medialvoxel

#endif
