// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InflateReader.h"

#include "Errors.h"
#include "HeaderParsing.h"

#include "itkMedialVoxelProgress.h"
#include "itk_zlib.h"

#include <algorithm>
#include <vector>

namespace medialvoxel
{
namespace
{
// Window of 2^15 bytes, and recognition of both zlib's and gzip's header.
constexpr int    WindowBits = 15 + 32;
constexpr int    BareWindowBits = -15;
constexpr size_t ChunkSize = size_t{ 1 } << 20;
/** With which a packed stream begins. */
constexpr unsigned long MarkSize = 2;
} // namespace

struct InflateReader::State
{
  std::filesystem::path      fileName;
  std::ifstream              file;
  std::vector<unsigned char> chunk = std::vector<unsigned char>(ChunkSize);
  z_stream                   stream{};
  std::uint64_t              bytesRead{ 0 };
  bool                       atEndOfStream{ false };

  [[noreturn]] void
  Refuse(const char * what) const
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), ": its compressed voxels ", what);
  }

  void
  Refill()
  {
    file.read(reinterpret_cast<char *>(chunk.data()), static_cast<std::streamsize>(chunk.size()));
    const std::streamsize count = file.gcount();
    if (count <= 0)
    {
      Refuse("end early");
    }
    stream.next_in = chunk.data();
    stream.avail_in = static_cast<unsigned int>(count);
    bytesRead += static_cast<std::uint64_t>(count);
  }

  /** One call of zlib, which may unpack nothing; a stream that has ended is followed by the next one. */
  void
  Step()
  {
    if (stream.avail_in == 0)
    {
      Refill();
    }
    if (atEndOfStream)
    {
      inflateReset(&stream);
    }
    const int result = inflate(&stream, Z_NO_FLUSH);
    atEndOfStream = result == Z_STREAM_END;
    if (!atEndOfStream && result != Z_OK && result != Z_BUF_ERROR)
    {
      Refuse(stream.total_in <= MarkSize && stream.total_out == 0 ? "are not packed by gzip or zlib" : "are damaged");
    }
  }

  void
  Fill(unsigned char * destination, unsigned int numberOfBytes)
  {
    stream.next_out = destination;
    stream.avail_out = numberOfBytes;
    while (stream.avail_out > 0)
    {
      itk::MedialVoxelCheckAbort();
      Step();
    }
  }
};

InflateReader::InflateReader(const std::filesystem::path & fileName, std::uint64_t offset, bool isBare)
  : m_State(std::make_unique<State>())
{
  m_State->fileName = fileName;
  m_State->file = OpenRegularFile(fileName);
  m_State->file.seekg(static_cast<std::streamoff>(offset));
  if (inflateInit2(&m_State->stream, isBare ? BareWindowBits : WindowBits) != Z_OK)
  {
    Fail(ExitStatus::Failure, "cannot set up zlib to read ", fileName.string());
  }
}

InflateReader::~InflateReader()
{
  inflateEnd(&m_State->stream);
}

void
InflateReader::Read(void * destination, std::uint64_t numberOfBytes)
{
  auto * position = static_cast<unsigned char *>(destination);
  while (numberOfBytes > 0)
  {
    const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, std::uint64_t{ 1 } << 30);
    m_State->Fill(position, static_cast<unsigned int>(count));
    position += count;
    numberOfBytes -= count;
  }
}

void
InflateReader::Skip(std::uint64_t numberOfBytes)
{
  std::vector<unsigned char> dropped(std::min<std::uint64_t>(numberOfBytes, ChunkSize));
  while (numberOfBytes > 0)
  {
    const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, dropped.size());
    this->Read(dropped.data(), count);
    numberOfBytes -= count;
  }
}

void
InflateReader::CheckEnd()
{
  unsigned char surplus = 0;
  m_State->stream.next_out = &surplus;
  m_State->stream.avail_out = 1;
  while (!m_State->atEndOfStream)
  {
    itk::MedialVoxelCheckAbort();
    m_State->Step();
    if (m_State->stream.avail_out == 0)
    {
      m_State->Refuse("are more than its header says");
    }
  }
}

std::uint64_t
InflateReader::GetNumberOfBytesRead() const
{
  return m_State->bytesRead;
}

std::unique_ptr<VoxelStream>
OpenInflatedStream(const VolumeHeader & header)
{
  auto reader = std::make_unique<InflateReader>(header.dataFile, header.dataOffset);
  reader->Skip(header.skipAfterInflation);
  return reader;
}

} // end namespace medialvoxel
