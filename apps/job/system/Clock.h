// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelClock_h
#define medialvoxelClock_h

#include <ctime>

namespace medialvoxel
{

/** Date and time in UTC; as std::gmtime(), for any thread. */
std::tm
GetUniversalTime(std::time_t seconds);

} // end namespace medialvoxel

#endif
