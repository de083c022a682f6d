// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLengthUnits_h
#define medialvoxelLengthUnits_h

#include <optional>
#include <string>

namespace medialvoxel
{

/** Millimeters of a unit of lengths that a header names, as "mm" or "micron"; nothing for an unknown name. */
std::optional<double>
GetMillimeters(const std::string & unit);

} // end namespace medialvoxel

#endif
