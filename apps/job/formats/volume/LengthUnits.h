// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLengthUnits_h
#define medialvoxelLengthUnits_h

#include "VolumeHeader.h"

#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Millimeters of a unit of lengths that a header names, as "mm" or "micron"; nothing for an unknown name. */
std::optional<double>
GetMillimeters(const std::string & unit);

/** Lengths of the geometry in millimeters, where all axes have a unit; a warning where only some have, or a rare one.
 * \param units names, x first; empty ones are not told */
void
ApplyUnits(VolumeHeader & header, const std::vector<std::string> & units);

/** Warns that lengths along some axes are a guess; a spacing that the user gives ends the warning.
 * \param what the file lacks, for example "the pages do not tell how far they are from each other" */
void
WarnOfUnknownSpacing(VolumeHeader & header, const std::string & what);

} // end namespace medialvoxel

#endif
