// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrCodecs_h
#define medialvoxelZarrCodecs_h

#include "Compression.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Bytes that are packed, or to be packed. */
struct ZarrData
{
  const char *  data{ nullptr };
  std::uint64_t size{ 0 };
};

/** A way to pack the bytes of chunks: a row of the table in ZarrCodecs.cxx. */
struct ZarrCodec
{
  const char * nameInVersion2; ///< empty: version 2 of Zarr has none
  const char * nameInVersion3;

  /** The library that the build needs for the functions below; empty: none. */
  const char * neededLibrary;

  /** The most bytes that so many may be packed into; larger ones are refused before they are read. */
  std::uint64_t (*getMaximumSize)(std::uint64_t);

  /** Memory that unpacking to so many bytes takes beside them. */
  std::uint64_t (*getWorkspace)(std::uint64_t);

  /** Unpacks to \a target, which has room for \a room bytes. \return their number; nothing for damaged bytes, or for
   * more of them. Null: the program was built without the library. */
  std::optional<std::uint64_t> (*unpack)(const ZarrData & packed, char * target, std::uint64_t room);

  /** The other way; nothing when memory is short. Null: it is only read. */
  std::optional<std::uint64_t> (*pack)(const ZarrData & bytes,
                                       std::uint64_t    valueSize,
                                       char *           target,
                                       std::uint64_t    room);
};

/** The codec of a name in the metadata of version 2 or 3 of Zarr; null for an unknown name. */
const ZarrCodec *
FindZarrCodec(const std::string & name, int version);

/** Packs the chunks that are written; null: they are not packed. */
const ZarrCodec *
GetZarrCodec(ZarrCompression compression);

/** Names of the codecs of a version that this program can read, for messages. */
std::string
ListZarrCodecs(int version);

/** Largest chunk that is packed, in bytes. */
constexpr std::uint64_t LargestPackedChunk = (std::uint64_t{ 1 } << 31) - (std::uint64_t{ 1 } << 20);

/** Most ways of packing that one chunk may go through. */
constexpr std::size_t MostZarrCodecs = 4;

/** \class ZarrUnpacker
 * \brief Unpacks chunks that went through several codecs, with memory for one chunk. */
class ZarrUnpacker
{
public:
  /** \param codecs in the order in which they packed; all can unpack */
  ZarrUnpacker(std::vector<const ZarrCodec *> codecs, std::uint64_t chunkSize);

  /** Memory that one takes, with the chunk. */
  static std::uint64_t
  GetMemory(const std::vector<const ZarrCodec *> & codecs, std::uint64_t chunkSize);

  /** The most bytes that a packed chunk can have. */
  std::uint64_t
  GetMaximumSize() const
  {
    return m_MaximumSizes.back();
  }

  /** Where the bytes of a packed chunk are put before Unpack(). */
  std::vector<char> &
  GetPacked()
  {
    return m_Packed;
  }

  /** Unpacks to a chunk, which gets its size. \return false when the bytes are damaged */
  bool
  Unpack(std::vector<char> & chunk);

private:
  std::vector<const ZarrCodec *> m_Codecs;
  std::vector<std::uint64_t>     m_MaximumSizes; ///< before the first codec, and after each
  std::vector<char>              m_Packed;
  std::vector<char>              m_Between; ///< two codecs
};

} // end namespace medialvoxel

#endif
