// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrChunkFile.h"

#include "FileNames.h"
#include "Zeros.h"

#include <algorithm>
#include <cerrno>

namespace medialvoxel
{
namespace
{

/** Bytes of a packed chunk at most. */
std::uint64_t
GetPackedSize(ZarrCompression compression, std::uint64_t numberOfBytes)
{
  const ZarrCodec * const codec = GetZarrCodec(compression);
  return codec == nullptr ? 0 : codec->getMaximumSize(numberOfBytes);
}

/** Makes a folder and its parents; false on failure, with errno. The folder of the whole volume is not made: when it
 * is gone, another process has published or removed it, and it must not come back. */
bool
MakeFolders(const std::filesystem::path & folder)
{
  if (MakeFolder(folder) || errno == EEXIST)
  {
    return true;
  }
  const auto parent = errno == ENOENT ? folder.parent_path() : std::filesystem::path();
  return !parent.empty() && parent.extension() != PartialExtension && MakeFolders(parent) &&
         (MakeFolder(folder) || errno == EEXIST);
}

/** Opens a file to be written, and makes the folder that it is the first one of. */
SystemFile
MakeFile(const std::filesystem::path & name, FileAccess access)
{
  MakeFolders(name.parent_path()); // the file fails where the folder does
  SystemFile file(name, access);
  if (!file.IsOpen())
  {
    FailWithErrno(ExitStatus::Failure, "create", name);
  }
  return file;
}

} // namespace

ZarrChunkWriter::ZarrChunkWriter(ZarrCompression     compression,
                                 std::uint64_t       numberOfBytes,
                                 std::uint64_t       valueSize,
                                 const std::string & process)
  : m_Compression(compression)
  , m_NumberOfBytes(numberOfBytes)
  , m_ValueSize(valueSize)
  , m_PartialExtension((process.empty() ? "" : "." + process) + PartialExtension)
  , m_Packed(GetPackedSize(compression, numberOfBytes))
{}

std::filesystem::path
ZarrChunkWriter::GetPartialName(const std::filesystem::path & chunkFile) const
{
  return chunkFile.string() + m_PartialExtension;
}

void
ZarrChunkWriter::GiveName(const std::filesystem::path & chunkFile) const
{
  if (!Rename(this->GetPartialName(chunkFile), chunkFile, TakenName::IsLost))
  {
    FailWithErrno(ExitStatus::Failure, "give its name to", chunkFile);
  }
}

std::uint64_t
ZarrChunkWriter::GetMemory(ZarrCompression compression, std::uint64_t numberOfBytes)
{
  // Memory of zlib and zstd at their levels, measured on whole runs.
  constexpr std::uint64_t workspace = std::uint64_t{ 1 } << 22;
  return compression == ZarrCompression::None ? 0 : GetPackedSize(compression, numberOfBytes) + workspace;
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
  const auto bytes = codec->pack({ chunk, m_NumberOfBytes }, m_ValueSize, m_Packed.data(), m_Packed.size());
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
    SystemFile file = MakeFile(this->GetPartialName(chunkFile), FileAccess::MakeEmpty);
    const bool isWritten = file.WriteAt(0, bytes, numberOfBytes);
    if (isWritten)
    {
      file.StartSync(0, numberOfBytes);
    }
    if (!isWritten || !file.Close())
    {
      FailWithErrno(ExitStatus::Failure, "write", chunkFile);
    }
  }
  this->GiveName(chunkFile);
  if (m_Checksum)
  {
    m_Checksum->Add(bytes, numberOfBytes);
  }
}

void
ZarrChunkWriter::WriteSpan(const std::filesystem::path & chunkFile,
                           const ZarrChunkSpan &         span,
                           const char *                  bytes,
                           bool                          isFirst) const
{
  SystemFile file = MakeFile(this->GetPartialName(chunkFile), isFirst ? FileAccess::MakeEmpty : FileAccess::Make);
  if ((isFirst && !file.SetSize(span.chunkSize)) || !file.WriteAt(span.offset, bytes, span.numberOfBytes) ||
      !file.Close())
  {
    FailWithErrno(ExitStatus::Failure, "write", chunkFile);
  }
}

void
ZarrChunkWriter::CompleteSpans(const std::filesystem::path & chunkFile, char * chunk)
{
  const bool isPacked = m_Compression != ZarrCompression::None;
  {
    const SystemFile spans(this->GetPartialName(chunkFile), FileAccess::Change);
    if (!spans.IsOpen() || ((isPacked || m_Checksum) && !spans.ReadAt(0, chunk, m_NumberOfBytes)))
    {
      FailWithErrno(ExitStatus::Failure, "read back", chunkFile);
    }
    if (!isPacked)
    {
      spans.StartSync(0, m_NumberOfBytes);
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

std::optional<SystemFile>
OpenZarrChunks(const std::filesystem::path & chunkFile)
{
  SystemFile file(chunkFile, FileAccess::Read);
  if (!file.IsOpen() && errno != ENOENT)
  {
    FailWithErrno(ExitStatus::Failure, "read", chunkFile);
  }
  const auto status = file.IsOpen() ? file.GetStatus() : std::nullopt;
  if (file.IsOpen() && !(status && status->isFile))
  {
    Fail(ExitStatus::Failure, "cannot read ", chunkFile.string(), ": it is not a regular file");
  }
  return file.IsOpen() ? std::optional(std::move(file)) : std::nullopt;
}

void
AddZarrChunk(const std::filesystem::path & chunkFile, Checksum & checksum)
{
  constexpr std::uint64_t bufferSize = std::uint64_t{ 1 } << 20;
  const auto              file = OpenZarrChunks(chunkFile);
  const std::uint64_t     numberOfBytes = file ? file->GetSize() : 0;
  std::vector<char>       buffer(std::min(numberOfBytes, bufferSize));
  for (std::uint64_t offset = 0; offset < numberOfBytes; offset += buffer.size())
  {
    const std::uint64_t count = std::min<std::uint64_t>(buffer.size(), numberOfBytes - offset);
    if (!file->ReadAt(offset, buffer.data(), count))
    {
      FailWithErrno(ExitStatus::Failure, "read", chunkFile);
    }
    checksum.Add(buffer.data(), count);
  }
}

} // end namespace medialvoxel
