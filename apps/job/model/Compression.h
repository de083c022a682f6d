// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCompression_h
#define medialvoxelCompression_h

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

/** Name of how chunks are packed, in files. */
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

/** How volumes are packed that are written. */
enum class Compression : std::uint8_t
{
  Default, ///< of each format
  On,      ///< as each format does it
  Gzip,
  BloscZstd,
  None
};

inline std::string
GetName(Compression compression)
{
  constexpr const char * names[] = { "default", "on", "gzip", "blosc-zstd", "none" };
  return names[static_cast<int>(compression)];
}

inline ZarrCompression
GetZarrCompression(Compression compression)
{
  return compression == Compression::None        ? ZarrCompression::None
         : compression == Compression::BloscZstd ? ZarrCompression::BloscZstd
                                                 : ZarrCompression::Gzip;
}

} // end namespace medialvoxel

#endif
