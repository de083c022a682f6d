// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMemoryPacking_h
#define medialvoxelMemoryPacking_h

#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** Packs values that are needed again, with LZ4, so that any part unpacks alone; without libblosc a copy.
 * \param valueSize of one of them
 * \param workspace loses its content */
std::vector<char>
PackInMemory(const std::vector<char> & values, std::uint64_t valueSize, std::vector<char> & workspace);

/** Unpacks \a count values from the \a first on. */
void
UnpackFromMemory(const std::vector<char> & packed,
                 std::uint64_t             valueSize,
                 std::uint64_t             first,
                 std::uint64_t             count,
                 char *                    target);

/** Memory that packing takes beside values and workspace. */
constexpr std::uint64_t PackingMemory = std::uint64_t{ 1 } << 21;

} // end namespace medialvoxel

#endif
