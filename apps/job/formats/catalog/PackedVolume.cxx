// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PackedVolume.h"

#include "Errors.h"
#include "VolumeFormats.h"

#include "itk_zlib.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cstring>

namespace medialvoxel
{
namespace
{

constexpr int         FastestLevel = 1;
constexpr int         MemoryLevel = 8;
constexpr int         WindowBits = 15;
constexpr int         Gzip = 16; // added to the bits of the window
constexpr std::size_t BlockSize = std::size_t{ 1 } << 16;

} // namespace

struct PackedVolume::Deflater
{
  Deflater(OutputFile & outputFile, int windowBits, std::uint64_t begin)
    : file(outputFile)
    , offset(begin)
    , packed(BlockSize)
  {
    if (deflateInit2(&stream, FastestLevel, Z_DEFLATED, windowBits, MemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
    {
      Fail(ExitStatus::Failure, "cannot set up zlib to write ", file.GetFileName().string());
    }
  }
  ~Deflater() { deflateEnd(&stream); }
  Deflater(const Deflater &) = delete;
  Deflater &
  operator=(const Deflater &) = delete;

  void
  Add(const char * data, std::size_t numberOfBytes)
  {
    while (numberOfBytes > 0)
    {
      const std::size_t count = std::min(numberOfBytes, BlockSize - block.size());
      block.insert(block.end(), data, data + count);
      data += count;
      numberOfBytes -= count;
      if (block.size() == BlockSize)
      {
        this->Deflate(Z_NO_FLUSH);
      }
    }
  }

  void
  Deflate(int flush)
  {
    itk::MedialVoxelCheckAbort();
    stream.next_in = reinterpret_cast<Bytef *>(block.data());
    stream.avail_in = static_cast<uInt>(block.size());
    do
    {
      stream.next_out = packed.data();
      stream.avail_out = static_cast<uInt>(packed.size());
      deflate(&stream, flush);
      const std::size_t count = packed.size() - stream.avail_out;
      file.WriteAt(offset, packed.data(), count);
      offset += count;
    } while (stream.avail_out == 0);
    block.clear();
  }

  OutputFile &       file;
  std::uint64_t      offset; ///< in the file, of the next byte
  z_stream           stream{};
  std::vector<char>  block;
  std::vector<Bytef> packed;
};

struct PackedVolume::Inflater
{
  Inflater(const OutputFile & outputFile, std::uint64_t begin)
    : file(outputFile)
    , offset(begin)
    , packed(BlockSize)
  {
    constexpr int anyHeader = 32;
    if (inflateInit2(&stream, WindowBits + anyHeader) != Z_OK)
    {
      Fail(ExitStatus::Failure, "cannot set up zlib to read ", file.GetFileName().string());
    }
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater &) = delete;
  Inflater &
  operator=(const Inflater &) = delete;

  void
  Read(Bytef * data, std::uint64_t numberOfBytes)
  {
    while (numberOfBytes > 0)
    {
      itk::MedialVoxelCheckAbort();
      const auto count = static_cast<uInt>(std::min<std::uint64_t>(numberOfBytes, std::uint64_t{ 1 } << 20));
      stream.next_out = data;
      stream.avail_out = count;
      while (stream.avail_out > 0)
      {
        this->Step();
      }
      data += count;
      numberOfBytes -= count;
      position += count;
    }
  }

  void
  SkipTo(std::uint64_t target)
  {
    std::vector<Bytef> dropped(BlockSize);
    while (position < target)
    {
      this->Read(dropped.data(), std::min<std::uint64_t>(target - position, dropped.size()));
    }
  }

  void
  Step()
  {
    if (stream.avail_in == 0)
    {
      const std::uint64_t count = std::min<std::uint64_t>(file.GetSize() - offset, packed.size());
      file.ReadAt(offset, packed.data(), count);
      offset += count;
      stream.next_in = packed.data();
      stream.avail_in = static_cast<uInt>(count);
    }
    const int result = inflate(&stream, Z_NO_FLUSH);
    if (result != Z_OK && !(result == Z_STREAM_END && stream.avail_out == 0))
    {
      Fail(ExitStatus::Failure, file.GetFileName().string(), ": what was written cannot be unpacked");
    }
  }

  const OutputFile & file;
  std::uint64_t      offset;        ///< in the file, of the next byte
  std::uint64_t      position{ 0 }; ///< in the stream
  z_stream           stream{};
  std::vector<Bytef> packed;
};

PackedVolume::PackedVolume(const std::filesystem::path & fileName, bool overwrite)
  : m_Writer(*FindOutputFormat(fileName).format.writer)
  , m_File(fileName, overwrite)
{}

PackedVolume::~PackedVolume() = default;

void
PackedVolume::Create(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  m_Geometry = geometry;
  m_Layout = layout;
  m_File.Create(0, false);
  const std::string header = m_Writer.makeHeader(m_Geometry, m_Layout, "", 0);
  (m_Writer.packsHeader ? m_UnpackedHeader : m_HeaderSize) = header.size();
  m_Deflater = std::make_unique<Deflater>(m_File, m_Writer.packsAsZlib ? WindowBits : WindowBits + Gzip, m_HeaderSize);
  if (m_Writer.packsHeader)
  {
    m_Deflater->Add(header.data(), header.size());
  }
}

void
PackedVolume::Pack(const char * data, std::uint64_t numberOfBytes)
{
  m_Deflater->Add(data, numberOfBytes);
  m_NextByte += numberOfBytes;
}

void
PackedVolume::PackZeros(std::uint64_t numberOfBytes)
{
  const std::vector<char> zeros(std::min<std::uint64_t>(numberOfBytes, BlockSize));
  while (numberOfBytes > 0)
  {
    const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, zeros.size());
    this->Pack(zeros.data(), count);
    numberOfBytes -= count;
  }
}

void
PackedVolume::Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data)
{
  const std::uint64_t begin = firstVoxel * m_Layout.GetBytes();
  if (begin < m_NextByte)
  {
    Fail(ExitStatus::Failure, m_File.GetFileName().string(), ": its voxels do not come in their order");
  }
  this->PackZeros(begin - m_NextByte);
  this->Pack(static_cast<const char *>(data), numberOfVoxels * m_Layout.GetBytes());
}

void
PackedVolume::Finish()
{
  this->PackZeros(m_Geometry.GetNumberOfVoxels() * m_Layout.GetBytes() - m_NextByte);
  m_Deflater->Deflate(Z_FINISH);
  if (m_HeaderSize > 0)
  {
    const std::uint64_t packedSize = m_Deflater->offset - m_HeaderSize;
    const std::string   header = m_Writer.makeHeader(m_Geometry, m_Layout, "", packedSize);
    m_File.WriteAt(0, header.data(), header.size());
  }
  m_Deflater.reset();
  m_File.AcceptSize();
  m_File.Finish();
}

void
PackedVolume::Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const
{
  const std::uint64_t begin = m_UnpackedHeader + firstVoxel * m_Layout.GetBytes();
  if (!m_Inflater || m_Inflater->position > begin)
  {
    m_Inflater = std::make_unique<Inflater>(m_File, m_HeaderSize);
  }
  m_Inflater->SkipTo(begin);
  m_Inflater->Read(static_cast<Bytef *>(data), numberOfVoxels * m_Layout.GetBytes());
}

void
PackedVolume::Publish()
{
  m_File.Publish();
}

} // end namespace medialvoxel
