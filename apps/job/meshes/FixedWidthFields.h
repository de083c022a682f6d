// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFixedWidthFields_h
#define medialvoxelFixedWidthFields_h

#include "MeshWriters.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** Fields of a fixed width, of formats with the lines of punched cards. */

/** The text, filled with blanks at its right. */
std::string
GetField(std::string text, size_t width);

std::string
GetField(std::uint64_t number, size_t width);

/** A number with a point, which distinguishes it from an integer, in as many digits as the field holds.
 * \param width 8 at least, for 1 digit; 16 hold 9 digits of every number */
std::string
GetRealField(float value, size_t width);
std::string
GetRealField(double value, size_t width);

/** The coordinates of a vertex in the precision of its surface, a field each. */
std::vector<std::string>
GetPositionFields(const MeshReader & reader, const MeshSpool::Vertex & vertex, size_t width);

} // end namespace medialvoxel

#endif
