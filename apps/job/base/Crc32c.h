// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCrc32c_h
#define medialvoxelCrc32c_h

#include <cstdint>
#include <optional>
#include <string_view>

namespace medialvoxel
{

/** CRC-32C, of Castagnoli, as in RFC 3720. */
std::uint32_t
GetCrc32c(std::string_view bytes);

/** The bytes before their CRC-32C, four bytes with the lowest first; nothing when it is another one. */
std::optional<std::string_view>
CheckCrc32c(std::string_view bytesAndChecksum);

} // end namespace medialvoxel

#endif
