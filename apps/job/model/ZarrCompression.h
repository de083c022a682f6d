// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrCompression_h
#define medialvoxelZarrCompression_h

#include <cstdint>

namespace medialvoxel
{

/** How the chunks of a Zarr array are packed. */
enum class ZarrCompression : std::uint8_t
{
  None,
  Gzip ///< written as gzip, which more readers have than zlib; of arrays that are read, both
};

} // end namespace medialvoxel

#endif
