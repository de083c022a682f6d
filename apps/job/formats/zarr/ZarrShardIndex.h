// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrShardIndex_h
#define medialvoxelZarrShardIndex_h

#include "SystemFile.h"
#include "ZarrMetadata.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** In place of offset and bytes of a chunk that a shard lacks. */
constexpr std::uint64_t MissingInShard = ~std::uint64_t{ 0 };

/** Offset and bytes of each chunk of a shard, x fastest; all chunks lie in the file.
 * \throw JobError CorruptInput, also when the checksum is another one */
std::vector<std::uint64_t>
ReadZarrShardIndex(const std::filesystem::path & fileName, const SystemFile & file, const ZarrShards & shards);

} // end namespace medialvoxel

#endif
