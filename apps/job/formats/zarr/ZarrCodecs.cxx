// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrCodecs.h"

#include "Crc32c.h"
#include "Text.h"
#include "ZarrMetadata.h"

#include "itk_zlib.h"

#include "itkMedialVoxelProgress.h"

#ifdef MEDIALVOXEL_WITH_BLOSC
#  include <blosc.h>
#endif
#ifdef MEDIALVOXEL_WITH_ZSTD
#  include <zstd.h>
#endif

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace medialvoxel
{
namespace
{

using Count = std::optional<std::uint64_t>;

/** Chunks that cannot be packed grow by less than this in every library. */
std::uint64_t
AllowGrowth(std::uint64_t bytes)
{
  constexpr std::uint64_t overhead = std::uint64_t{ 1 } << 12;
  return bytes + bytes / 64 + overhead;
}

std::uint64_t
NeedNothing(std::uint64_t)
{
  return 0;
}

std::uint64_t
NeedZlib(std::uint64_t)
{
  return std::uint64_t{ 1 } << 16;
}

/** Unpacks zlib and gzip, also members of gzip that follow each other. */
Count
Inflate(const ZarrData & packed, char * target, std::uint64_t room)
{
  constexpr int           anyHeader = 15 + 32;
  constexpr std::uint64_t bytesAtOnce = std::uint64_t{ 1 } << 22;
  z_stream                stream = {};
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(packed.data));
  stream.avail_in = static_cast<uInt>(packed.size);
  if (inflateInit2(&stream, anyHeader) != Z_OK)
  {
    return std::nullopt;
  }
  struct Ender
  {
    ~Ender() { inflateEnd(&stream); }
    z_stream & stream;
  } const ender{ stream };
  std::uint64_t done = 0;
  for (int result = Z_OK; result != Z_STREAM_END || stream.avail_in > 0;)
  {
    itk::MedialVoxelCheckAbort();
    if (result == Z_STREAM_END && inflateReset(&stream) != Z_OK)
    {
      return std::nullopt;
    }
    const auto count = static_cast<uInt>(std::min(room - done, bytesAtOnce));
    stream.next_out = reinterpret_cast<Bytef *>(target + done);
    stream.avail_out = count;
    result = inflate(&stream, Z_NO_FLUSH);
    done += count - stream.avail_out;
    if (result != Z_OK && result != Z_STREAM_END) // also when bytes or room are missing
    {
      return std::nullopt;
    }
  }
  return done;
}

/** As gzip, with a header without a time. */
Count
Deflate(const ZarrData & bytes, std::uint64_t, char * target, std::uint64_t room)
{
  constexpr int windowBitsOfGzip = 15 + 16;
  constexpr int memoryLevel = 8;
  // Chunks that are written are far from the 4 GiB that zlib takes at once.
  z_stream stream = {};
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data));
  stream.avail_in = static_cast<uInt>(bytes.size);
  stream.next_out = reinterpret_cast<Bytef *>(target);
  stream.avail_out = static_cast<uInt>(room);
  const bool isReady =
    deflateInit2(&stream, ZarrGzipLevel, Z_DEFLATED, windowBitsOfGzip, memoryLevel, Z_DEFAULT_STRATEGY) == Z_OK;
  const bool isPacked = isReady && deflate(&stream, Z_FINISH) == Z_STREAM_END;
  deflateEnd(&stream);
  return isPacked ? Count(stream.total_out) : std::nullopt;
}

#ifdef MEDIALVOXEL_WITH_BLOSC

/** Three of its blocks, which have up to some MiB in chunks that other programs write. */
std::uint64_t
NeedBlosc(std::uint64_t bytes)
{
  constexpr std::uint64_t largestBlock = std::uint64_t{ 1 } << 22;
  return 3 * std::min(bytes, largestBlock);
}

Count
UnpackBlosc(const ZarrData & packed, char * target, std::uint64_t room)
{
  std::size_t bytes = 0;
  if (packed.size < BLOSC_MIN_HEADER_LENGTH || blosc_cbuffer_validate(packed.data, packed.size, &bytes) != 0 ||
      bytes > room)
  {
    return std::nullopt;
  }
  const int done = bytes == 0 ? 0 : blosc_decompress_ctx(packed.data, target, room, 1);
  return done >= 0 && static_cast<std::size_t>(done) == bytes ? Count(bytes) : std::nullopt;
}

Count
PackBlosc(const ZarrData & bytes, std::uint64_t valueSize, char * target, std::uint64_t room)
{
  const int done = blosc_compress_ctx(
    ZarrBloscLevel, BLOSC_SHUFFLE, valueSize, bytes.size, bytes.data, target, room, BLOSC_ZSTD_COMPNAME, 0, 1);
  return done > 0 ? Count(done) : std::nullopt;
}

#else

constexpr auto           NeedBlosc = NeedNothing;
constexpr std::nullptr_t UnpackBlosc = nullptr;
constexpr std::nullptr_t PackBlosc = nullptr;

#endif
#ifdef MEDIALVOXEL_WITH_ZSTD

/** Measured for chunks that are unpacked at once. */
std::uint64_t
NeedZstd(std::uint64_t)
{
  return std::uint64_t{ 1 } << 18;
}

Count
UnpackZstd(const ZarrData & packed, char * target, std::uint64_t room)
{
  const std::size_t done = ZSTD_decompress(target, room, packed.data, packed.size);
  return ZSTD_isError(done) != 0 ? std::nullopt : Count(done);
}

#else

constexpr auto           NeedZstd = NeedNothing;
constexpr std::nullptr_t UnpackZstd = nullptr;

#endif

/** Bytes with their checksum behind them. */
Count
UnpackCrc32c(const ZarrData & packed, char * target, std::uint64_t room)
{
  const auto bytes = CheckCrc32c({ packed.data, packed.size });
  if (!bytes || bytes->size() > room)
  {
    return std::nullopt;
  }
  std::memcpy(target, bytes->data(), bytes->size());
  return bytes->size();
}

const std::array<ZarrCodec, 5> Codecs{
  { { "gzip", "gzip", "", AllowGrowth, NeedZlib, Inflate, Deflate },
    { "zlib", "zlib", "", AllowGrowth, NeedZlib, Inflate, nullptr },
    { "blosc", "blosc", "libblosc", AllowGrowth, NeedBlosc, UnpackBlosc, PackBlosc },
    { "zstd", "zstd", "libzstd", AllowGrowth, NeedZstd, UnpackZstd, nullptr },
    { "", "crc32c", "", AllowGrowth, NeedNothing, UnpackCrc32c, nullptr } }
};

std::string
GetName(const ZarrCodec & codec, int version)
{
  return version == 2 ? codec.nameInVersion2 : codec.nameInVersion3;
}

} // namespace

const ZarrCodec *
FindZarrCodec(const std::string & name, int version)
{
  const auto found = std::find_if(Codecs.begin(), Codecs.end(), [&](const ZarrCodec & codec) {
    return !name.empty() && GetName(codec, version) == name;
  });
  return found == Codecs.end() ? nullptr : &*found;
}

const ZarrCodec *
GetZarrCodec(ZarrCompression compression)
{
  switch (compression)
  {
    case ZarrCompression::None:
      break;
    case ZarrCompression::Gzip:
      return FindZarrCodec("gzip", 2);
    case ZarrCompression::BloscZstd:
      return FindZarrCodec("blosc", 2);
  }
  return nullptr;
}

std::string
ListZarrCodecs(int version)
{
  std::vector<std::string> names;
  for (const ZarrCodec & codec : Codecs)
  {
    if (codec.unpack != nullptr && !GetName(codec, version).empty())
    {
      names.push_back(GetName(codec, version));
    }
  }
  return Join(names, ", ", [](const std::string & name) { return name; });
}

ZarrUnpacker::ZarrUnpacker(std::vector<const ZarrCodec *> codecs, std::uint64_t chunkSize)
  : m_Codecs(std::move(codecs))
  , m_MaximumSizes{ chunkSize }
{
  for (const ZarrCodec * const codec : m_Codecs)
  {
    m_MaximumSizes.push_back(codec->getMaximumSize(m_MaximumSizes.back()));
  }
}

std::uint64_t
ZarrUnpacker::GetMemory(const std::vector<const ZarrCodec *> & codecs, std::uint64_t chunkSize)
{
  std::uint64_t workspace = 0;
  for (const ZarrCodec * const codec : codecs)
  {
    workspace = std::max(workspace, codec->getWorkspace(chunkSize));
  }
  const std::uint64_t buffers = std::min<std::uint64_t>(codecs.size(), 2);
  return chunkSize + buffers * ZarrUnpacker(codecs, chunkSize).GetMaximumSize() + workspace;
}

bool
ZarrUnpacker::Unpack(std::vector<char> & chunk)
{
  for (std::size_t number = m_Codecs.size(); number > 0; --number)
  {
    std::vector<char> & target = number == 1 ? chunk : m_Between;
    target.resize(m_MaximumSizes[number - 1]);
    const auto bytes = m_Codecs[number - 1]->unpack({ m_Packed.data(), m_Packed.size() }, target.data(), target.size());
    if (!bytes)
    {
      return false;
    }
    target.resize(*bytes);
    if (number > 1)
    {
      m_Packed.swap(m_Between);
    }
  }
  if (m_Codecs.empty())
  {
    chunk.swap(m_Packed);
  }
  return chunk.size() == m_MaximumSizes.front();
}

} // end namespace medialvoxel
