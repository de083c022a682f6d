// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrShardIndex.h"

#include "Crc32c.h"
#include "FileNames.h"

#include "itkByteSwapper.h"

namespace medialvoxel
{
namespace
{

void
CheckPlaces(const std::filesystem::path & fileName, std::uint64_t fileSize, const std::vector<std::uint64_t> & places)
{
  for (std::size_t i = 0; i < places.size(); i += 2)
  {
    const std::uint64_t offset = places[i];
    const std::uint64_t bytes = places[i + 1];
    const bool          isMissing = offset == MissingInShard && bytes == MissingInShard;
    if (!isMissing && (offset > fileSize || bytes > fileSize - offset))
    {
      Fail(ExitStatus::CorruptInput,
           fileName.string(),
           ": its index has chunk ",
           i / 2,
           " at byte ",
           offset,
           " with ",
           bytes,
           " bytes; the file has ",
           fileSize);
    }
  }
}

} // namespace

std::vector<std::uint64_t>
ReadZarrShardIndex(const std::filesystem::path & fileName, const SystemFile & file, const ZarrShards & shards)
{
  const std::uint64_t indexSize = shards.GetIndexSize();
  const std::uint64_t fileSize = file.GetSize();
  if (fileSize < indexSize)
  {
    Fail(ExitStatus::CorruptInput,
         fileName.string(),
         " has ",
         fileSize,
         " bytes; the index of a shard of its array has ",
         indexSize);
  }
  constexpr std::uint64_t    numbersPerChunk = 2;
  std::vector<std::uint64_t> places((indexSize + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
  auto * const               bytes = reinterpret_cast<char *>(places.data());
  if (!file.ReadAt(shards.indexAtStart ? 0 : fileSize - indexSize, bytes, indexSize))
  {
    FailWithErrno(ExitStatus::Failure, "read", fileName);
  }
  if (shards.indexHasChecksum && !CheckCrc32c({ bytes, indexSize }))
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), ": the checksum of its index is wrong");
  }
  places.resize(shards.GetNumberOfChunks() * numbersPerChunk);
  using Swapper = itk::ByteSwapper<std::uint64_t>;
  shards.indexIsBigEndian ? Swapper::SwapRangeFromSystemToBigEndian(places.data(), places.size())
                          : Swapper::SwapRangeFromSystemToLittleEndian(places.data(), places.size());
  CheckPlaces(fileName, fileSize, places);
  return places;
}

} // end namespace medialvoxel
