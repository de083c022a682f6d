// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrChunkFile_h
#define medialvoxelZarrChunkFile_h

#include "Checksum.h"
#include "SystemFile.h"
#include "ZarrMetadata.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Extension of the names that chunks have while they are written. */
constexpr const char * PartialExtension = ".partial";

/** Some bytes of a chunk that is not packed. */
struct ZarrChunkSpan
{
  std::uint64_t offset{ 0 };
  std::uint64_t numberOfBytes{ 0 };
  std::uint64_t chunkSize{ 0 }; ///< of the whole chunk
};

/** \class ZarrChunkWriter
 * \brief Writes chunks that appear under their names only when they are complete.
 *
 * A chunk is written at once, or in spans that are kept as they are until the last one is there. The folder of a chunk
 * is made with its first file. Several processes may write different chunks of an array. */
class ZarrChunkWriter
{
public:
  /** \param numberOfBytes of a chunk, not packed
   * \param valueSize of one of its numbers
   * \param process a text that differs where several processes might write a chunk at the same time */
  ZarrChunkWriter(ZarrCompression     compression,
                  std::uint64_t       numberOfBytes,
                  std::uint64_t       valueSize,
                  const std::string & process);

  /** Memory that a writer takes. */
  static std::uint64_t
  GetMemory(ZarrCompression compression, std::uint64_t numberOfBytes);

  /** \throw JobError Failure. */
  void
  Write(const std::filesystem::path & chunkFile, const char * chunk);

  /** Writes some bytes of a chunk that is completed later; other bytes are 0.
   * \param isFirst drops the bytes that an earlier process left of the chunk */
  void
  WriteSpan(const std::filesystem::path & chunkFile,
            const ZarrChunkSpan &         span,
            const char *                  bytes,
            bool                          isFirst) const;

  /** Makes a chunk of the spans written. \param chunk memory for one */
  void
  CompleteSpans(const std::filesystem::path & chunkFile, char * chunk);

  /** Sums up the bytes of the files that get their names from now on. */
  void
  StartChecksum()
  {
    m_Checksum = Checksum();
  }

  std::uint32_t
  GetChecksum() const
  {
    return m_Checksum ? m_Checksum->GetValue() : 0;
  }

private:
  /** The name that a chunk has while it is written. */
  std::filesystem::path
  GetPartialName(const std::filesystem::path & chunkFile) const;

  void
  GiveName(const std::filesystem::path & chunkFile) const;

  /** The bytes of a file, equal to the chunk when nothing is packed. */
  std::pair<const char *, std::uint64_t>
  Pack(const std::filesystem::path & chunkFile, const char * chunk);

  ZarrCompression   m_Compression;
  std::uint64_t     m_NumberOfBytes;
  std::uint64_t     m_ValueSize;
  std::string       m_PartialExtension;
  std::vector<char> m_Packed;
  std::vector<char> m_PackedZeros; ///< of a chunk without anything else, as soon as there was one

  std::optional<Checksum> m_Checksum;
};

/** Opens a file of chunks to be read; nothing when there is none.
 * \throw JobError Failure, also when it is not a regular file */
std::optional<SystemFile>
OpenZarrChunks(const std::filesystem::path & chunkFile);

/** Adds the bytes of the file of a chunk, if there is one. */
void
AddZarrChunk(const std::filesystem::path & chunkFile, Checksum & checksum);

} // end namespace medialvoxel

#endif
