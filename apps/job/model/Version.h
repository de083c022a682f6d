// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVersion_h
#define medialvoxelVersion_h

#include <string>

namespace medialvoxel
{

/** Version of the program. */
std::string
GetVersion();

/** Version of ITK that the program runs with. */
std::string
GetItkVersion();

} // end namespace medialvoxel

#endif
