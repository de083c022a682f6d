// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZeros_h
#define medialvoxelZeros_h

#include <cstdint>
#include <cstring>

namespace medialvoxel
{

/** \param numberOfBytes 1 or more */
inline bool
IsAllZero(const char * data, std::uint64_t numberOfBytes)
{
  // Every byte equals its successor and the first one is zero: one call that runs at the speed of memory.
  return data[0] == 0 && std::memcmp(data, data + 1, numberOfBytes - 1) == 0;
}

} // end namespace medialvoxel

#endif
