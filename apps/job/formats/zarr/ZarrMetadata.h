// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrMetadata_h
#define medialvoxelZarrMetadata_h

#include "VolumeHeader.h"
#include "ZarrCodecs.h"
#include "ZarrGrid.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

// Versions 2 and 3 of Zarr, https://zarr-specs.readthedocs.io, and 0.4 and 0.5 of OME-Zarr,
// https://ngff.openmicroscopy.org. Version 2 and 0.4 are written.

/** Names of files with metadata: of an array in version 2, of an array or a group in version 3. */
constexpr const char * ZarrArrayFile = ".zarray";
constexpr const char * ZarrFile = "zarr.json";

/** Levels at which chunks are packed. */
constexpr int ZarrGzipLevel = 1;
constexpr int ZarrBloscLevel = 5;

/** The file .zgroup. */
std::string
MakeZarrGroupText();

/** The file .zarray of voxels in the byte order of this machine; chunks that are missing are 0. */
std::string
MakeZarrArrayText(const ZarrGrid & grid, ZarrCompression compression);

/** One size of an image that is written. */
struct ZarrLevel
{
  VolumeGeometry geometry;
  ZarrGrid       grid;
  std::string    folder; ///< of the array, in that of the image
};

/** The file .zattrs: axes, and for each level spacing as scale and origin as translation. The format lacks
 * directions; an attribute of this project has them, unless they are the axes of space.
 * \param name of the image */
std::string
MakeZarrAttributesText(const std::string & name, const std::vector<ZarrLevel> & levels);

/** How chunks lie together in files, the shards of version 3. */
struct ZarrShards
{
  ZarrIndex chunks{ { 1, 1, 1 } };     ///< of a shard, along each axis
  bool      indexAtStart{ false };     ///< where in the file is written where its chunks are; otherwise at its end
  bool      indexIsBigEndian{ false }; ///< byte order of the numbers there
  bool      indexHasChecksum{ false }; ///< CRC-32C

  std::uint64_t
  GetNumberOfChunks() const
  {
    return chunks[0] * chunks[1] * chunks[2];
  }

  std::uint64_t
  GetIndexSize() const
  {
    constexpr std::uint64_t bytesPerChunk = 16;
    constexpr std::uint64_t bytesOfChecksum = 4;
    return GetNumberOfChunks() * bytesPerChunk + (indexHasChecksum ? bytesOfChecksum : 0);
  }
};

/** The metadata of an array that is read. */
struct ZarrArray
{
  ZarrGrid                       grid;    ///< of shards their chunks
  std::vector<const ZarrCodec *> codecs;  ///< that packed the bytes of a chunk, in their order
  std::string                    packing; ///< how chunks are packed, in words; empty: they are not
  bool                           bigEndian{ false };
  double                         fillValue{ 0.0 }; ///< of chunks that have no file; one that the type of the voxels has
  std::optional<ZarrShards>      shards;

  /** The axes of a chunk from the fastest on. */
  std::array<unsigned int, 3> axisOrder{ { 0, 1, 2 } };

  bool
  IsTransposed() const
  {
    return axisOrder != std::array<unsigned int, 3>{ { 0, 1, 2 } };
  }

  /** True when each voxel of a chunk has a place in its file, so that some of them can be read alone. */
  bool
  IsPlain() const
  {
    return codecs.empty() && !this->IsTransposed();
  }

  /** How shards divide the volume. */
  ZarrGrid
  GetShardGrid() const;
};

/** Reads .zarray of version 2, or zarr.json of version 3, of an array whose last \a dimension axes are the axes of
 * space.
 * \param dimension 2 or 3; 0: as many as the array has, 3 at most
 * \throw HeaderError, or JobError when the file is not JSON */
ZarrArray
ReadZarrArray(const std::filesystem::path & arrayFile, unsigned int dimension);

/** True for a folder that is a group or an array of Zarr. */
bool
IsZarrFolder(const std::filesystem::path & folder);

} // end namespace medialvoxel

#endif
