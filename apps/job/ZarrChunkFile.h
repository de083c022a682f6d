// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrChunkFile_h
#define medialvoxelZarrChunkFile_h

#include "ZarrMetadata.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** The name that a chunk has while it is written. */
std::filesystem::path
GetPartialName(const std::filesystem::path & chunkFile);

/** \class ZarrChunkWriter
 * \brief Writes chunks that appear under their names only when they are complete.
 *
 * A chunk is written at once, or in parts that are kept as they are until the last one is there. The folder of a chunk
 * is made with its first file. Several processes may write different chunks of an array. */
class ZarrChunkWriter
{
public:
  /** \param numberOfBytes of a chunk, not packed */
  ZarrChunkWriter(ZarrCompression compression, std::uint64_t numberOfBytes);

  /** Memory that a writer takes. */
  static std::uint64_t
  GetMemoryBytes(ZarrCompression compression, std::uint64_t numberOfBytes);

  /** \throw JobError Failure. */
  void
  Write(const std::filesystem::path & chunkFile, const char * chunk);

  /** Writes some bytes of a chunk that is completed later; bytes that are not written are 0. */
  void
  WritePart(const std::filesystem::path & chunkFile,
            std::uint64_t                 offset,
            const char *                  bytes,
            std::uint64_t                 numberOfBytes) const;

  /** Makes a chunk of the parts written. \param chunk memory for one */
  void
  CompleteParts(const std::filesystem::path & chunkFile, char * chunk);

private:
  /** The bytes of a file, which are those of the chunk when nothing is packed. */
  std::pair<const char *, std::uint64_t>
  Pack(const std::filesystem::path & chunkFile, const char * chunk);

  ZarrCompression   m_Compression;
  std::uint64_t     m_NumberOfBytes;
  std::vector<char> m_Packed;
};

/** Reads a chunk. \return false when it has no file
 * \throw JobError CorruptInput when the file has another number of bytes, or is damaged */
bool
ReadZarrChunk(const std::filesystem::path & chunkFile,
              ZarrCompression               compression,
              void *                        chunk,
              std::uint64_t                 numberOfBytes);

/** Some bytes of a chunk that is not packed. */
struct ZarrChunkPart
{
  std::uint64_t offset{ 0 };
  std::uint64_t numberOfBytes{ 0 };
  std::uint64_t chunkBytes{ 0 }; ///< of the whole chunk
};

/** Reads a part of a chunk that is not packed; otherwise as ReadZarrChunk(). */
bool
ReadZarrChunkPart(const std::filesystem::path & chunkFile, const ZarrChunkPart & part, void * bytes);

/** Sets voxels to what those of chunks without a file are, in the byte order of this machine. */
void
FillChunk(const ZarrArray & array, std::vector<char> & voxels);

/** Brings voxels of an array into the byte order of this machine, or back. */
void
SwapToMachineOrder(const ZarrArray & array, std::vector<char> & voxels);

} // end namespace medialvoxel

#endif
