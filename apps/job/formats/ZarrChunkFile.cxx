// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrChunkFile.h"

#include "FileNames.h"
#include "FileTransfer.h"
#include "ZarrDescriptor.h"
#include "Zeros.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

/** Bytes of a packed chunk at most. */
std::uint64_t
GetPackedBytes(ZarrCompression compression, std::uint64_t numberOfBytes)
{
  const ZarrCodec * const codec = GetZarrCodec(compression);
  return codec == nullptr ? 0 : codec->getMostBytes(numberOfBytes);
}

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
class NewFile : public ZarrDescriptor
{
public:
  NewFile(const std::filesystem::path & file, int flags)
    : ZarrDescriptor((MakeFolder(file.parent_path()), file), flags | O_RDWR | O_CREAT) // fails where the folder does
  {
    if (this->Get() < 0)
    {
      FailWithErrno("create", file);
    }
  }
};

} // namespace

ZarrChunkWriter::ZarrChunkWriter(ZarrCompression     compression,
                                 std::uint64_t       numberOfBytes,
                                 std::uint64_t       valueBytes,
                                 const std::string & process)
  : m_Compression(compression)
  , m_NumberOfBytes(numberOfBytes)
  , m_ValueBytes(valueBytes)
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
  // Measured on whole runs: what zlib and zstd take at their levels.
  constexpr std::uint64_t workspace = std::uint64_t{ 1 } << 22;
  return compression == ZarrCompression::None ? 0 : GetPackedBytes(compression, numberOfBytes) + workspace;
}

std::pair<const char *, std::uint64_t>
ZarrChunkWriter::Pack(const std::filesystem::path & chunkFile, const char * chunk)
{
  const ZarrCodec * const codec = GetZarrCodec(m_Compression);
  if (codec == nullptr)
  {
    return { chunk, m_NumberOfBytes };
  }
  const bool isZero = IsAllZero(chunk, m_NumberOfBytes);
  if (isZero && !m_PackedZeros.empty())
  {
    return { m_PackedZeros.data(), m_PackedZeros.size() };
  }
  const auto bytes = codec->pack({ chunk, m_NumberOfBytes }, m_ValueBytes, m_Packed.data(), m_Packed.size());
  if (!bytes)
  {
    Fail(ExitStatus::Failure, "cannot pack ", chunkFile.string(), ": out of memory");
  }
  if (isZero)
  {
    m_PackedZeros.assign(m_Packed.begin(), m_Packed.begin() + static_cast<std::ptrdiff_t>(*bytes));
  }
  return { m_Packed.data(), *bytes };
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
    const ZarrDescriptor parts(this->GetPartialName(chunkFile), O_RDWR);
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
  const auto              file = OpenZarrChunks(chunkFile);
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

} // end namespace medialvoxel
