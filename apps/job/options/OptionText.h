// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionText_h
#define medialvoxelOptionText_h

#include "Options.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace medialvoxel
{

/** A text that is no value of an option: the text, and the allowed values. */
struct WrongValue : std::invalid_argument
{
  using std::invalid_argument::invalid_argument;
};

constexpr std::uint64_t LargestCount = std::uint64_t{ 1 } << 62;

/** Each reads the whole text, or throws WrongValue. \param others further allowed values */
double
ToFinite(const std::string & text);
double
ToDistance(const std::string & text); ///< infinity is the same as no limit
double
ToSpacing(const std::string & text, const std::string & others = "");
double
ToLength(const std::string & text, const std::string & others = ""); ///< that a wall or a ball may have
double
ToLengthOrNone(const std::string & text); ///< 0: none
std::int64_t
ToInteger(const std::string & text, std::int64_t least, std::int64_t most);
std::uint64_t
ToCount(const std::string & text, std::uint64_t least, std::uint64_t most);
std::uint64_t
ToByteSize(const std::string & text);
bool
ToFlag(const std::string & text);
std::string
ToFileName(const std::string & text); ///< a shell completes a folder with a slash

/** A limit on values, where whole numbers keep all 64 bits. */
itk::MedialVoxelExactNumber
ToLimit(const std::string & text, const std::string & others = "");
LabelValue
ToLabel(const std::string & text);
LabelSelection
ToLabels(const std::string & text);
ElementSize
ToElementSize(const std::string & text);
itk::MedialVoxelScanLevels
ToLevels(const std::string & text);
ColorRange
ToColorRange(const std::string & text);

/** A limit on the thickness of walls, and perhaps the one that places grow to and the least area. */
PlaceLimits
ToPlaceLimits(const std::string & text, PlaceKind kind);

/** The inverse of the functions above. */
std::string
FormatFlag(bool value);
std::string
FormatLabels(const LabelSelection & labels);
std::string
FormatElementSize(const ElementSize & size);
std::string
FormatLevels(const itk::MedialVoxelScanLevels & levels);
std::string
FormatColorRange(const ColorRange & range);
std::string
FormatPlaceLimits(const PlaceLimits & limits);

/** The number of the name that a text is, in any case. */
std::size_t
FindChoice(const std::vector<std::string> & names, const std::string & text);

/** The value of a flag: true, on, yes and 1, or false, off, no and 0, in any case. */
std::optional<bool>
ParseFlag(const std::string & text);

/** Lengths as numbers, and an area behind the second comma: mm are units of the spacing, and a vx is \a voxel of them.
 * What has no unit stays. */
std::string
ReplaceUnits(const std::string & text, double voxel);

/** Whether one of them is in voxels. */
bool
HasVoxels(const std::string & text);

/** Also of nothing, and behind the last comma. */
std::vector<std::string>
SplitAtCommas(const std::string & text);

} // end namespace medialvoxel

#endif
