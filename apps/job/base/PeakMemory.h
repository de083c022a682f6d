// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPeakMemory_h
#define medialvoxelPeakMemory_h

#include <cstdint>

namespace medialvoxel
{

/** Peak of the memory that the process kept resident; 0 where the system does not tell. */
std::uint64_t
GetPeakMemoryBytes();

} // end namespace medialvoxel

#endif
