// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFormatNames_h
#define medialvoxelFormatNames_h

#include <string>
#include <vector>

namespace medialvoxel
{

/** Names of the formats that are read. */
std::vector<std::string>
ListInputFormats();

/** Extensions of written volumes, of the formats that have so many components. */
std::vector<std::string>
ListOutputExtensions(unsigned int components = 1);

} // end namespace medialvoxel

#endif
