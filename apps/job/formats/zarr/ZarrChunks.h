// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrChunks_h
#define medialvoxelZarrChunks_h

#include "SystemFile.h"
#include "ZarrMetadata.h"

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class ZarrChunks
 * \brief The chunks of an array, each read and unpacked alone, also from a shard.
 *
 * Several threads may ask, each with buffers of its own. Errors are JobError: CorruptInput when a file has another size
 * than it must have or is damaged, Failure when it cannot be read. */
class ZarrChunks
{
public:
  /** The buffers of a thread. */
  struct Buffers
  {
    ZarrUnpacker      unpacker;
    std::vector<char> chunk;
    std::vector<char> transposed;
    std::uint64_t     bytesRead{ 0 }; ///< from files
  };

  /** Slices of a chunk. */
  struct Slices
  {
    std::uint64_t first{ 0 };
    std::uint64_t count{ 0 };
    bool          moreFollow{ false }; ///< later slices will be asked for: the chunk is kept when there is room
  };

  /** \param folder of the array
   * \param bytesToKeep of chunks that are needed again, packed by LZ4 meanwhile */
  ZarrChunks(const std::filesystem::path & folder, ZarrArray array, std::uint64_t bytesToKeep);

  const ZarrArray &
  GetArray() const
  {
    return m_Array;
  }

  Buffers
  MakeBuffers() const;

  /** Reads slices of a chunk, x fastest, in the byte order of this machine; they stay until the next call. Null when
   * there is no chunk, so that its voxels have the fill value. */
  const char *
  Read(std::uint64_t component, const ZarrIndex & index, const Slices & slices, Buffers & buffers);

  /** A whole chunk. */
  const char *
  Read(std::uint64_t component, const ZarrIndex & index, Buffers & buffers)
  {
    return this->Read(component, index, { 0, m_Array.grid.chunk[2] }, buffers);
  }

  /** Reads some bytes of a chunk of a plain array, in the byte order of this machine; false when there is none. */
  bool
  ReadSpan(const ZarrIndex & index, std::uint64_t offset, std::vector<char> & bytes, Buffers & buffers);

  /** Memory of the buffers of a thread and of a chunk, and of the indices of shards. */
  static std::uint64_t
  GetBufferMemory(const ZarrArray & array);
  static std::uint64_t
  GetIndexSize(const ZarrArray & array);

private:
  /** Where the bytes of a chunk are. */
  struct Place
  {
    std::filesystem::path     fileName;
    std::optional<SystemFile> file;
    std::uint64_t             offset{ 0 };
    std::uint64_t             numberOfBytes{ 0 };
  };

  /** Offset and bytes of each chunk of a shard; empty for a shard without a file. */
  using ShardIndex = std::shared_ptr<const std::vector<std::uint64_t>>;

  std::optional<Place>
  Find(std::uint64_t component, const ZarrIndex & index, Buffers & buffers);

  std::optional<Place>
  FindInShard(const ZarrIndex & index, Buffers & buffers);

  ShardIndex
  GetShardIndex(const ZarrIndex & shard, const std::filesystem::path & fileName, Buffers & buffers);

  std::uint64_t
  GetNumber(const ZarrGrid & grid, std::uint64_t component, const ZarrIndex & index) const;

  void
  Unpack(const Place & place, Buffers & buffers) const;

  /** A chunk that is packed in memory. */
  using Kept = std::shared_ptr<const std::vector<char>>;

  Kept
  FindKept(std::uint64_t number, bool isNeededAgain);

  void
  Keep(std::uint64_t number, const Kept & chunk);

  std::filesystem::path m_Folder;
  ZarrArray             m_Array;
  ZarrGrid              m_ShardGrid;
  std::uint64_t         m_CacheSize;

  std::mutex                          m_Mutex; ///< of the members below
  std::map<std::uint64_t, Kept>       m_Kept;  ///< slices that come first are first
  std::uint64_t                       m_CachedSize{ 0 };
  std::map<std::uint64_t, ShardIndex> m_ShardIndices;
};

/** Sets voxels to the value of chunks without a file. */
void
FillChunk(const ZarrArray & array, std::vector<char> & voxels);

/** Brings voxels of an array into the byte order of this machine. */
void
SwapToMachineOrder(const ZarrArray & array, std::vector<char> & voxels);

} // end namespace medialvoxel

#endif
