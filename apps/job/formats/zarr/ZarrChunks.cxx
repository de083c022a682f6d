// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrChunks.h"

#include "FileNames.h"
#include "MemoryPacking.h"
#include "ZarrChunkFile.h"
#include "ZarrShardIndex.h"

#include "itkByteSwapper.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{
namespace
{

/** Memory of the cached indices of shards, and of the map for each beside its numbers. */
constexpr std::uint64_t IndexCacheSize = std::uint64_t{ 1 } << 23;
constexpr std::uint64_t IndexOverhead = 256;

std::uint64_t
GetMostIndices(const ZarrShards & shards)
{
  return std::max<std::uint64_t>(1, IndexCacheSize / (shards.GetIndexSize() + IndexOverhead));
}

/** Brings the voxels of a chunk into the order with x fastest. */
void
ToRowOrder(const ZarrArray & array, const std::vector<char> & stored, std::vector<char> & voxels)
{
  const ZarrIndex & size = array.grid.chunk;
  ZarrIndex         step{};
  std::uint64_t     next = 1;
  for (const unsigned int axis : array.axisOrder)
  {
    step[axis] = next;
    next *= size[axis];
  }
  voxels.resize(stored.size());
  DispatchPixelType(array.grid.layout.pixelType, [&](auto zero) {
    using ValueType = decltype(zero);
    const auto * const from = reinterpret_cast<const ValueType *>(stored.data());
    auto *             to = reinterpret_cast<ValueType *>(voxels.data());
    for (std::uint64_t z = 0; z < size[2]; ++z)
    {
      for (std::uint64_t y = 0; y < size[1]; ++y)
      {
        for (std::uint64_t x = 0; x < size[0]; ++x)
        {
          *to++ = from[x * step[0] + y * step[1] + z * step[2]];
        }
      }
    }
  });
}

} // namespace

ZarrChunks::ZarrChunks(const std::filesystem::path & folder, ZarrArray array, std::uint64_t bytesToKeep)
  : m_Folder(folder)
  , m_Array(std::move(array))
  , m_ShardGrid(m_Array.GetShardGrid())
  , m_CacheSize(bytesToKeep)
{}

ZarrChunks::Buffers
ZarrChunks::MakeBuffers() const
{
  return { ZarrUnpacker(m_Array.codecs, m_Array.grid.GetChunkSize()), {}, {} };
}

std::uint64_t
ZarrChunks::GetBufferMemory(const ZarrArray & array)
{
  const std::uint64_t chunk = array.grid.GetChunkSize();
  return ZarrUnpacker::GetMemory(array.codecs, chunk) + (array.IsTransposed() ? chunk : 0) +
         (array.shards ? array.shards->GetIndexSize() : 0) + PackingMemory;
}

std::uint64_t
ZarrChunks::GetIndexSize(const ZarrArray & array)
{
  if (!array.shards)
  {
    return 0;
  }
  const std::uint64_t indices = std::min(array.GetShardGrid().GetNumberOfAllChunks(), GetMostIndices(*array.shards));
  return indices * (array.shards->GetIndexSize() + IndexOverhead);
}

const char *
ZarrChunks::Read(std::uint64_t component, const ZarrIndex & index, const Slices & slices, Buffers & buffers)
{
  const ZarrGrid &    grid = m_Array.grid;
  const std::uint64_t number = this->GetNumber(grid, component, index);
  const std::uint64_t perSlice = grid.chunk[0] * grid.chunk[1];
  const std::uint64_t valueSize = GetTraits(grid.layout.pixelType).bytes;
  if (const Kept kept = m_CacheSize > 0 ? this->FindKept(number, slices.moreFollow) : nullptr)
  {
    buffers.chunk.resize(slices.count * grid.GetPlaneSize());
    UnpackFromMemory(*kept, valueSize, slices.first * perSlice, slices.count * perSlice, buffers.chunk.data());
    return buffers.chunk.data();
  }
  const std::optional<Place> place = this->Find(component, index, buffers);
  if (!place)
  {
    return nullptr;
  }
  this->Unpack(*place, buffers);
  if (slices.moreFollow && m_CacheSize > 0)
  {
    this->Keep(
      number,
      std::make_shared<const std::vector<char>>(PackInMemory(buffers.chunk, valueSize, buffers.unpacker.GetPacked())));
  }
  return buffers.chunk.data() + slices.first * grid.GetPlaneSize();
}

bool
ZarrChunks::ReadSpan(const ZarrIndex & index, std::uint64_t offset, std::vector<char> & bytes, Buffers & buffers)
{
  const std::optional<Place> place = this->Find(0, index, buffers);
  if (!place)
  {
    return false;
  }
  const std::uint64_t chunkSize = m_Array.grid.GetChunkSize();
  if (place->numberOfBytes != chunkSize)
  {
    Fail(ExitStatus::CorruptInput,
         place->fileName.string(),
         " has ",
         place->numberOfBytes,
         m_Array.shards ? " bytes for a chunk" : " bytes",
         "; the chunks of its array have ",
         chunkSize);
  }
  if (!place->file->ReadAt(place->offset + offset, bytes.data(), bytes.size()))
  {
    FailWithErrno(ExitStatus::Failure, "read", place->fileName);
  }
  buffers.bytesRead += bytes.size();
  SwapToMachineOrder(m_Array, bytes);
  return true;
}

std::optional<ZarrChunks::Place>
ZarrChunks::Find(std::uint64_t component, const ZarrIndex & index, Buffers & buffers)
{
  if (m_Array.shards)
  {
    return this->FindInShard(index, buffers);
  }
  Place place;
  place.fileName = m_Folder / m_Array.grid.GetChunkName(component, index);
  place.file = OpenZarrChunks(place.fileName);
  if (!place.file)
  {
    return std::nullopt;
  }
  place.numberOfBytes = place.file->GetSize();
  return place;
}

std::optional<ZarrChunks::Place>
ZarrChunks::FindInShard(const ZarrIndex & index, Buffers & buffers)
{
  const ZarrIndex & chunks = m_Array.shards->chunks;
  ZarrIndex         shard{};
  ZarrIndex         inShard{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    shard[axis] = index[axis] / chunks[axis];
    inShard[axis] = index[axis] % chunks[axis];
  }
  Place place;
  place.fileName = m_Folder / m_ShardGrid.GetChunkName(0, shard);
  const ShardIndex    places = this->GetShardIndex(shard, place.fileName, buffers);
  const std::uint64_t number = (inShard[2] * chunks[1] + inShard[1]) * chunks[0] + inShard[0];
  if (places->empty() || (*places)[2 * number] == MissingInShard)
  {
    return std::nullopt;
  }
  place.offset = (*places)[2 * number];
  place.numberOfBytes = (*places)[2 * number + 1];
  place.file = OpenZarrChunks(place.fileName);
  if (!place.file)
  {
    Fail(ExitStatus::Failure, place.fileName.string(), " is gone since its index was read");
  }
  return place;
}

ZarrChunks::ShardIndex
ZarrChunks::GetShardIndex(const ZarrIndex & shard, const std::filesystem::path & fileName, Buffers & buffers)
{
  const std::uint64_t number = this->GetNumber(m_ShardGrid, 0, shard);
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    const auto                        found = m_ShardIndices.find(number);
    if (found != m_ShardIndices.end())
    {
      return found->second;
    }
  }
  auto       places = std::make_shared<std::vector<std::uint64_t>>();
  const auto file = OpenZarrChunks(fileName);
  if (file)
  {
    *places = ReadZarrShardIndex(fileName, *file, *m_Array.shards);
    buffers.bytesRead += m_Array.shards->GetIndexSize();
  }
  const std::lock_guard<std::mutex> lock(m_Mutex);
  while (m_ShardIndices.size() >= GetMostIndices(*m_Array.shards))
  {
    m_ShardIndices.erase(m_ShardIndices.begin());
  }
  m_ShardIndices[number] = places;
  return places;
}

/** Slices that come first have the smaller numbers. */
std::uint64_t
ZarrChunks::GetNumber(const ZarrGrid & grid, std::uint64_t component, const ZarrIndex & index) const
{
  return ((index[2] * grid.layout.components + component) * grid.GetNumberOfChunks(1) + index[1]) *
           grid.GetNumberOfChunks(0) +
         index[0];
}

void
ZarrChunks::Unpack(const Place & place, Buffers & buffers) const
{
  const std::uint64_t chunkSize = m_Array.grid.GetChunkSize();
  const std::uint64_t most = buffers.unpacker.GetMaximumSize();
  if (place.numberOfBytes > most || (m_Array.codecs.empty() && place.numberOfBytes != chunkSize))
  {
    Fail(ExitStatus::CorruptInput,
         place.fileName.string(),
         " has ",
         place.numberOfBytes,
         m_Array.shards ? " bytes for a chunk" : " bytes",
         m_Array.codecs.empty() ? "; the chunks of its array have " : "; packed chunks of its array have at most ",
         most);
  }
  std::vector<char> & packed = buffers.unpacker.GetPacked();
  packed.resize(place.numberOfBytes);
  if (!place.file->ReadAt(place.offset, packed.data(), packed.size()))
  {
    FailWithErrno(ExitStatus::Failure, "read", place.fileName);
  }
  buffers.bytesRead += packed.size();
  if (!buffers.unpacker.Unpack(buffers.chunk))
  {
    Fail(ExitStatus::CorruptInput,
         place.fileName.string(),
         " is damaged: its bytes cannot be unpacked by ",
         m_Array.packing,
         " to a chunk of ",
         chunkSize,
         " bytes");
  }
  if (m_Array.IsTransposed())
  {
    ToRowOrder(m_Array, buffers.chunk, buffers.transposed);
    buffers.chunk.swap(buffers.transposed);
  }
  SwapToMachineOrder(m_Array, buffers.chunk);
}

ZarrChunks::Kept
ZarrChunks::FindKept(std::uint64_t number, bool isNeededAgain)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  const auto                        found = m_Kept.find(number);
  if (found == m_Kept.end())
  {
    return nullptr;
  }
  Kept chunk = found->second;
  if (!isNeededAgain)
  {
    m_CachedSize -= chunk->size();
    m_Kept.erase(found);
  }
  return chunk;
}

/** Only chunks of slices that were passed make room: of a layer that does not fit as a whole, a part stays. */
void
ZarrChunks::Keep(std::uint64_t number, const Kept & chunk)
{
  const std::uint64_t               perLayer = m_Array.grid.GetChunksPerLayer();
  const std::lock_guard<std::mutex> lock(m_Mutex);
  while (!m_Kept.empty() && m_CachedSize + chunk->size() > m_CacheSize &&
         m_Kept.begin()->first / perLayer < number / perLayer)
  {
    m_CachedSize -= m_Kept.begin()->second->size();
    m_Kept.erase(m_Kept.begin());
  }
  if (m_CachedSize + chunk->size() <= m_CacheSize && m_Kept.emplace(number, chunk).second)
  {
    m_CachedSize += chunk->size();
  }
}

void
FillChunk(const ZarrArray & array, std::vector<char> & voxels)
{
  DispatchPixelType(array.grid.layout.pixelType, [&](auto zero) {
    using ValueType = decltype(zero);
    auto * const values = reinterpret_cast<ValueType *>(voxels.data());
    std::fill_n(values, voxels.size() / sizeof(ValueType), static_cast<ValueType>(array.fillValue));
  });
}

void
SwapToMachineOrder(const ZarrArray & array, std::vector<char> & voxels)
{
  DispatchPixelType(array.grid.layout.pixelType, [&](auto zero) {
    using ValueType = decltype(zero);
    using Swapper = itk::ByteSwapper<ValueType>;
    auto * const values = reinterpret_cast<ValueType *>(voxels.data());
    const auto   count = voxels.size() / sizeof(ValueType);
    array.bigEndian ? Swapper::SwapRangeFromSystemToBigEndian(values, count)
                      : Swapper::SwapRangeFromSystemToLittleEndian(values, count);
  });
}

} // end namespace medialvoxel
