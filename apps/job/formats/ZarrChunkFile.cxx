// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrChunkFile.h"

#include "FileNames.h"
#include "FileTransfer.h"
#include "InflateReader.h"

#include "itkByteSwapper.h"
#include "itk_zlib.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace medialvoxel
{
namespace
{

// Window of 2^15 bytes and gzip's header, whose time is left out.
constexpr int WindowBitsOfGzip = 15 + 16;
constexpr int MemoryLevel = 8;

/** Bytes of a packed chunk at most. */
std::uint64_t
GetPackedBytes(ZarrCompression compression, std::uint64_t numberOfBytes)
{
  constexpr std::uint64_t bytesOfGzipHeader = 32;
  return compression == ZarrCompression::Gzip ? compressBound(numberOfBytes) + bytesOfGzipHeader : 0;
}

[[noreturn]] void
FailWithErrno(const char * action, const std::filesystem::path & file)
{
  Fail(ExitStatus::Failure, "cannot ", action, " ", file.string(), ": ", std::strerror(errno));
}

/** \class Descriptor
 * \brief An open file. */
class Descriptor
{
public:
  Descriptor(const std::filesystem::path & file, int flags)
    : m_Number(open(file.c_str(), flags | O_CLOEXEC, 0666))
  {}

  ~Descriptor()
  {
    if (m_Number >= 0)
    {
      close(m_Number);
    }
  }

  Descriptor(const Descriptor &) = delete;
  Descriptor &
  operator=(const Descriptor &) = delete;

  int
  Get() const
  {
    return m_Number;
  }

  /** False when bytes were lost that seemed to be written, with errno: file systems of a network may tell only now. */
  bool
  Close()
  {
    return close(std::exchange(m_Number, -1)) == 0;
  }

  bool
  IsRegular() const
  {
    return S_ISREG(this->GetStatus().st_mode);
  }

  std::uint64_t
  GetSize() const
  {
    return static_cast<std::uint64_t>(this->GetStatus().st_size);
  }

private:
  /** Zeros when the system does not tell. */
  struct stat
  GetStatus() const
  {
    struct stat status = {};
    fstat(m_Number, &status);
    return status;
  }

  int m_Number;
};

bool
MakeOneFolder(const std::filesystem::path & folder)
{
  return mkdir(folder.c_str(), 0777) == 0 || errno == EEXIST;
}

/** Makes a folder and those that it is in; false on failure, with errno. The folder of the whole volume is not made:
 * when it is gone, another process has published or removed it, and it must not come back. */
bool
MakeFolder(const std::filesystem::path & folder)
{
  if (MakeOneFolder(folder))
  {
    return true;
  }
  const auto parent = errno == ENOENT ? folder.parent_path() : std::filesystem::path();
  return !parent.empty() && parent.extension() != PartialExtension && MakeFolder(parent) && MakeOneFolder(folder);
}

/** Opens a file to be written, and makes the folder that it is the first one of. */
class NewFile : public Descriptor
{
public:
  NewFile(const std::filesystem::path & file, int flags)
    : Descriptor((MakeFolder(file.parent_path()), file), flags | O_RDWR | O_CREAT) // fails where the folder does
  {
    if (this->Get() < 0)
    {
      FailWithErrno("create", file);
    }
  }
};

/** Opens a chunk to be read; null when it has no file. */
std::unique_ptr<Descriptor>
OpenChunk(const std::filesystem::path & chunkFile)
{
  // A pipe would be waited for.
  auto file = std::make_unique<Descriptor>(chunkFile, O_RDONLY | O_NONBLOCK);
  if (file->Get() < 0 && errno != ENOENT)
  {
    FailWithErrno("read", chunkFile);
  }
  if (file->Get() >= 0 && !file->IsRegular())
  {
    Fail(ExitStatus::Failure, "cannot read ", chunkFile.string(), ": it is not a regular file");
  }
  return file->Get() < 0 ? nullptr : std::move(file);
}

} // namespace

ZarrChunkWriter::ZarrChunkWriter(ZarrCompression compression, std::uint64_t numberOfBytes, const std::string & process)
  : m_Compression(compression)
  , m_NumberOfBytes(numberOfBytes)
  , m_PartialExtension((process.empty() ? "" : "." + process) + PartialExtension)
  , m_Packed(GetPackedBytes(compression, numberOfBytes))
{}

std::filesystem::path
ZarrChunkWriter::GetPartialName(const std::filesystem::path & chunkFile) const
{
  return chunkFile.string() + m_PartialExtension;
}

void
ZarrChunkWriter::GiveName(const std::filesystem::path & chunkFile) const
{
  if (rename(this->GetPartialName(chunkFile).c_str(), chunkFile.c_str()) != 0)
  {
    FailWithErrno("give its name to", chunkFile);
  }
}

std::uint64_t
ZarrChunkWriter::GetMemoryBytes(ZarrCompression compression, std::uint64_t numberOfBytes)
{
  constexpr std::uint64_t bytesOfZlib = std::uint64_t{ 1 } << 18;
  return compression == ZarrCompression::Gzip ? GetPackedBytes(compression, numberOfBytes) + bytesOfZlib : 0;
}

std::pair<const char *, std::uint64_t>
ZarrChunkWriter::Pack(const std::filesystem::path & chunkFile, const char * chunk)
{
  if (m_Compression == ZarrCompression::None)
  {
    return { chunk, m_NumberOfBytes };
  }
  // Chunks are far from the 4 GiB that zlib takes at once.
  z_stream stream = {};
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(chunk));
  stream.avail_in = static_cast<uInt>(m_NumberOfBytes);
  stream.next_out = reinterpret_cast<Bytef *>(m_Packed.data());
  stream.avail_out = static_cast<uInt>(m_Packed.size());
  const bool isReady =
    deflateInit2(&stream, ZarrGzipLevel, Z_DEFLATED, WindowBitsOfGzip, MemoryLevel, Z_DEFAULT_STRATEGY) == Z_OK;
  const bool isPacked = isReady && deflate(&stream, Z_FINISH) == Z_STREAM_END;
  deflateEnd(&stream);
  if (!isPacked)
  {
    Fail(ExitStatus::Failure, "cannot pack ", chunkFile.string(), ": out of memory");
  }
  return { m_Packed.data(), stream.total_out };
}

void
ZarrChunkWriter::Write(const std::filesystem::path & chunkFile, const char * chunk)
{
  const auto [bytes, numberOfBytes] = this->Pack(chunkFile, chunk);
  {
    NewFile file(this->GetPartialName(chunkFile), O_TRUNC);
    if (!WriteFully(file.Get(), 0, bytes, numberOfBytes))
    {
      FailWithErrno("write", chunkFile);
    }
    StartWriteBack(file.Get(), 0, numberOfBytes);
    if (!file.Close())
    {
      FailWithErrno("write", chunkFile);
    }
  }
  this->GiveName(chunkFile);
  if (m_Checksum)
  {
    m_Checksum->Add(bytes, numberOfBytes);
  }
}

void
ZarrChunkWriter::WritePart(const std::filesystem::path & chunkFile,
                           const ZarrChunkPart &         part,
                           const char *                  bytes,
                           bool                          isFirst) const
{
  NewFile file(this->GetPartialName(chunkFile), isFirst ? O_TRUNC : 0);
  if ((isFirst && ftruncate(file.Get(), static_cast<off_t>(part.chunkBytes)) != 0) ||
      !WriteFully(file.Get(), part.offset, bytes, part.numberOfBytes) || !file.Close())
  {
    FailWithErrno("write", chunkFile);
  }
}

void
ZarrChunkWriter::CompleteParts(const std::filesystem::path & chunkFile, char * chunk)
{
  const bool isPacked = m_Compression != ZarrCompression::None;
  {
    const Descriptor parts(this->GetPartialName(chunkFile), O_RDWR);
    if (parts.Get() < 0 || ((isPacked || m_Checksum) && !ReadFully(parts.Get(), 0, chunk, m_NumberOfBytes)))
    {
      FailWithErrno("read back", chunkFile);
    }
    if (!isPacked)
    {
      StartWriteBack(parts.Get(), 0, m_NumberOfBytes);
    }
  }
  if (isPacked)
  {
    this->Write(chunkFile, chunk);
    return;
  }
  this->GiveName(chunkFile);
  if (m_Checksum)
  {
    m_Checksum->Add(chunk, m_NumberOfBytes);
  }
}

void
AddZarrChunk(const std::filesystem::path & chunkFile, Checksum & checksum)
{
  constexpr std::uint64_t bufferBytes = std::uint64_t{ 1 } << 20;
  const auto              file = OpenChunk(chunkFile);
  const std::uint64_t     numberOfBytes = file ? file->GetSize() : 0;
  std::vector<char>       buffer(std::min(numberOfBytes, bufferBytes));
  for (std::uint64_t offset = 0; offset < numberOfBytes; offset += buffer.size())
  {
    const std::uint64_t count = std::min<std::uint64_t>(buffer.size(), numberOfBytes - offset);
    if (!ReadFully(file->Get(), offset, buffer.data(), count))
    {
      FailWithErrno("read", chunkFile);
    }
    checksum.Add(buffer.data(), count);
  }
}

bool
ReadZarrChunk(const std::filesystem::path & chunkFile,
              ZarrCompression               compression,
              void *                        chunk,
              std::uint64_t                 numberOfBytes)
{
  if (compression == ZarrCompression::None)
  {
    return ReadZarrChunkPart(chunkFile, { 0, numberOfBytes, numberOfBytes }, chunk);
  }
  if (!OpenChunk(chunkFile))
  {
    return false;
  }
  InflateReader reader(chunkFile, 0);
  reader.Read(chunk, numberOfBytes);
  reader.CheckEnd();
  return true;
}

bool
ReadZarrChunkPart(const std::filesystem::path & chunkFile, const ZarrChunkPart & part, void * bytes)
{
  const auto file = OpenChunk(chunkFile);
  if (!file)
  {
    return false;
  }
  if (file->GetSize() != part.chunkBytes)
  {
    Fail(ExitStatus::CorruptInput,
         chunkFile.string(),
         " has ",
         file->GetSize(),
         " bytes; the chunks of its array have ",
         part.chunkBytes);
  }
  if (!ReadFully(file->Get(), part.offset, static_cast<char *>(bytes), part.numberOfBytes))
  {
    FailWithErrno("read", chunkFile);
  }
  return true;
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
