// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSliceNames_h
#define medialvoxelSliceNames_h

#include <cstdint>
#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** True for an existing folder, and for a name that no file has with *, ? or one %d in its last part. */
bool
NamesSlices(const std::filesystem::path & input);

/** True for a pattern with %d, %4d or %04d, whose range counts the numbers in the names. */
bool
IsNumberPattern(const std::filesystem::path & input);

/** Files in a folder, or of a pattern, in natural order. Names that begin with a dot are left out.
 * \param range first and last number of a number pattern, all of which must exist; empty: all that exist
 * \throw HeaderError Unreadable for a missing folder or file */
std::vector<std::filesystem::path>
ListSliceFiles(const std::filesystem::path & input, const std::vector<std::uint64_t> & range);

/** Natural order: numbers in the texts count as numbers. */
bool
IsBefore(const std::filesystem::path & a, const std::filesystem::path & b);

/** Where all names differ in one number only, it must grow by the same step, or slices are missing or doubled.
 * \param input that the message begins with
 * \throw HeaderError with the names around the first fault */
void
CheckNumbers(const std::filesystem::path & input, const std::vector<std::filesystem::path> & files);

} // end namespace medialvoxel

#endif
