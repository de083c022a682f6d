// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrCompression_h
#define medialvoxelZarrCompression_h

#include <cstdint>
#include <string>

namespace medialvoxel
{

/** How the chunks of a Zarr array are packed. */
enum class ZarrCompression : std::uint8_t
{
  None,
  Gzip ///< written as gzip, which more readers have than zlib; of arrays that are read, both
};

/** Name of how chunks are packed, on the command line and in files. */
inline std::string
GetName(ZarrCompression compression)
{
  return compression == ZarrCompression::Gzip ? "gzip" : "none";
}

} // end namespace medialvoxel

#endif
