// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrCompression_h
#define medialvoxelZarrCompression_h

#include <cstdint>
#include <string>

namespace medialvoxel
{

/** How the chunks of a Zarr array are packed when they are written. */
enum class ZarrCompression : std::uint8_t
{
  None,
  Gzip,
  BloscZstd ///< zstd in the container of Blosc, as other programs write by default
};

/** Name of how chunks are packed, on the command line and in files. */
inline std::string
GetName(ZarrCompression compression)
{
  switch (compression)
  {
    case ZarrCompression::None:
      return "none";
    case ZarrCompression::Gzip:
      return "gzip";
    case ZarrCompression::BloscZstd:
      break;
  }
  return "blosc-zstd";
}

} // end namespace medialvoxel

#endif
