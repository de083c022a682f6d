// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputFile.h"

#include "Errors.h"
#include "FileNames.h"
#include "TemporaryName.h"
#include "Text.h"
#include "Zeros.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t SparseBlockSize = std::uint64_t{ 1 } << 16;

} // namespace

OutputFile::OutputFile(const std::filesystem::path & fileName, bool overwrite)
  : m_FileName(FollowLinks(fileName))
  , m_BelongsTo(m_FileName)
  , m_Overwrite(overwrite)
{}

OutputFile::~OutputFile()
{
  m_File.Close();
  if (m_IsForNow)
  {
    RemoveName(m_FileName);
  }
  if (!m_TemporaryName.empty() && !m_IsShared)
  {
    RemoveName(m_TemporaryName);
  }
}

void
OutputFile::Create(std::uint64_t numberOfBytes, bool reserve)
{
  this->CheckLengthOfName();
  m_File = SystemFile::MakeNameless(FolderOf(m_FileName));
  m_IsNameless = m_File.IsOpen();
  m_KeepsOrder = m_IsNameless;
  if (!m_IsNameless)
  {
    this->OpenUnder(this->GetNameMaker());
  }
  this->SetSize(numberOfBytes, reserve);
}

void
OutputFile::CreateNamed(std::uint64_t numberOfBytes, bool reserve, const std::string & suffix)
{
  this->OpenUnder([this, &suffix](int attempt) {
    return m_FileName.string() + "." + std::to_string(GetThisProcess().number) + "-" + std::to_string(attempt) + suffix;
  });
  this->SetSize(numberOfBytes, reserve);
}

/** Now, and not at the end of the work, which needs the name only then. */
void
OutputFile::CheckLengthOfName() const
{
  if (!GetFileStatus(m_FileName, false) && errno == ENAMETOOLONG)
  {
    FailWithErrno(ExitStatus::Refused, "create a file in the folder of", m_FileName);
  }
}

OutputFile::NameMaker
OutputFile::GetNameMaker() const
{
  return [this](int attempt) { return MakeTemporaryName(m_BelongsTo, attempt); };
}

void
OutputFile::OpenUnder(const NameMaker & makeName)
{
  for (int attempt = 0; !m_File.IsOpen(); ++attempt)
  {
    const std::filesystem::path name = makeName(attempt);
    m_File = SystemFile(name, FileAccess::MakeNew);
    if (m_File.IsOpen())
    {
      m_TemporaryName = name;
    }
    else if (errno != EEXIST || attempt == MaximumTemporaryNames)
    {
      FailWithErrno(ExitStatus::Refused, "create a file in the folder of", m_FileName);
    }
  }
}

void
OutputFile::CreateShared(const std::filesystem::path & temporaryName, std::uint64_t numberOfBytes)
{
  m_File = SystemFile(temporaryName, FileAccess::MakeNew);
  if (!m_File.IsOpen())
  {
    FailWithErrno(ExitStatus::Refused, "create", temporaryName);
  }
  m_TemporaryName = temporaryName;
  this->SetSize(numberOfBytes, true);
  m_IsShared = true; // not before: a file without space is of no use to others
}

void
OutputFile::RemoveLeftovers(const std::string & suffix) const
{
  const std::string                         begin = m_FileName.filename().string() + ".";
  std::error_code                           error;
  std::filesystem::directory_iterator       entry(FolderOf(m_FileName), error);
  const std::filesystem::directory_iterator end;
  std::vector<std::filesystem::path>        leftovers;
  for (; !error && entry != end; entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    const bool        isLonger = name.size() > begin.size() + suffix.size();
    const std::size_t numbers = isLonger ? name.size() - begin.size() - suffix.size() : 0;
    if (isLonger && name.compare(0, begin.size(), begin) == 0 &&
        name.compare(begin.size() + numbers, suffix.size(), suffix) == 0 &&
        name.substr(begin.size(), numbers).find_first_not_of("0123456789-") == std::string::npos)
    {
      leftovers.push_back(entry->path());
    }
  }
  std::for_each(leftovers.begin(), leftovers.end(), RemoveName);
}

void
OutputFile::OpenShared(const std::filesystem::path & temporaryName, std::uint64_t numberOfBytes, bool forWriting)
{
  if (!GetFileStatus(temporaryName))
  {
    const int error = errno;
    Fail(ExitStatus::Failure,
         "cannot open ",
         temporaryName.string(),
         ": ",
         std::strerror(error),
         error == ENOENT ? "; the output of the job is missing; put it back, or plan the job again" : "");
  }
  this->OpenExisting(temporaryName, numberOfBytes, forWriting ? FileAccess::Write : FileAccess::Read);
  m_TemporaryName = temporaryName;
  m_IsShared = true;
}

void
OutputFile::OpenPublished(std::uint64_t numberOfBytes)
{
  this->OpenExisting(m_FileName, numberOfBytes, FileAccess::Read);
}

void
OutputFile::OpenExisting(const std::filesystem::path & name, std::uint64_t numberOfBytes, FileAccess access)
{
  m_File = SystemFile(name, access);
  const auto status = m_File.IsOpen() ? m_File.GetStatus() : std::nullopt;
  if (!status)
  {
    FailWithErrno(ExitStatus::Failure, "open", name);
  }
  if (status->numberOfBytes != numberOfBytes)
  {
    Fail(ExitStatus::Failure, name.string(), " has ", status->numberOfBytes, " bytes, not ", numberOfBytes);
  }
  m_Size = numberOfBytes;
}

void
OutputFile::Sync()
{
  if (!m_File.SyncData() || !this->SyncUncached())
  {
    FailWithErrno(ExitStatus::Failure, "bring to the disk", m_FileName);
  }
}

/** Some file systems tell of bytes that they lost only there where they were written. */
bool
OutputFile::SyncUncached() const
{
  return !m_Uncached || m_Uncached->Sync();
}

void
OutputFile::SetSize(std::uint64_t numberOfBytes, bool reserve)
{
  m_Size = numberOfBytes;
  if (reserve && numberOfBytes > 0)
  {
    this->Reserve(numberOfBytes);
  }
  if (!m_File.SetSize(numberOfBytes))
  {
    FailWithErrno(ExitStatus::Refused, "set the size of", m_FileName);
  }
}

void
OutputFile::Reserve(std::uint64_t numberOfBytes)
{
  if (!m_File.Reserve(numberOfBytes))
  {
    FailWithErrno(ExitStatus::Refused,
                  "reserve " + std::to_string(numberOfBytes) + " bytes (" + FormatBytes(numberOfBytes) + ") for",
                  m_FileName);
  }
}

void
OutputFile::BypassPageCache()
{
  m_Uncached = std::make_unique<UncachedWriter>(m_IsNameless ? m_File.GetOwnName() : m_TemporaryName);
  if (!m_Uncached->IsOpen())
  {
    m_Uncached.reset();
  }
}

void
OutputFile::WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes)
{
  constexpr std::uint64_t block = UncachedWriter::BlockSize;
  const auto * const      bytes = static_cast<const char *>(data);
  const std::uint64_t     head = std::min(numberOfBytes, (block - offset % block) % block);
  const std::uint64_t     blocks = (numberOfBytes - head) / block * block;
  if (m_Uncached && blocks > 0 && this->WriteUncachedAt(offset + head, bytes + head, blocks))
  {
    // A block that two pieces share waits in the cache for the second one.
    const std::uint64_t tail = head + blocks;
    this->WriteCachedAt(offset, bytes, head);
    this->WriteCachedAt(offset + tail, bytes + tail, numberOfBytes - tail);
  }
  else
  {
    this->WriteCachedAt(offset, bytes, numberOfBytes);
  }
}

bool
OutputFile::WriteUncachedAt(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes)
{
  if (m_Uncached->WriteAt(offset, data, numberOfBytes))
  {
    return true;
  }
  if (errno != EINVAL || !m_Uncached->Sync())
  {
    FailWithErrno(ExitStatus::Failure, "write", m_FileName);
  }
  m_Uncached.reset();
  return false;
}

void
OutputFile::WriteCachedAt(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes)
{
  if (!m_File.WriteAt(offset, data, numberOfBytes))
  {
    FailWithErrno(ExitStatus::Failure, "write", m_FileName);
  }
  m_File.StartSync(offset, numberOfBytes);
}

void
OutputFile::WriteSparseAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes)
{
  const auto *  bytes = static_cast<const char *>(data);
  std::uint64_t begin = 0;
  while (begin < numberOfBytes)
  {
    const std::uint64_t toBlockEnd = SparseBlockSize - (offset + begin) % SparseBlockSize;
    const std::uint64_t count = std::min(numberOfBytes - begin, toBlockEnd);
    if (!IsAllZero(bytes + begin, count))
    {
      this->WriteAt(offset + begin, bytes + begin, count);
    }
    begin += count;
  }
}

void
OutputFile::ReadAt(std::uint64_t offset, void * data, std::uint64_t numberOfBytes) const
{
  if (!m_File.ReadAt(offset, static_cast<char *>(data), numberOfBytes))
  {
    FailWithErrno(ExitStatus::Failure, "read back", m_FileName);
  }
}

void
OutputFile::AcceptSize()
{
  const auto status = m_File.GetStatus();
  if (!status)
  {
    FailWithErrno(ExitStatus::Failure, "read the size of", m_FileName);
  }
  m_Size = status->numberOfBytes;
}

void
OutputFile::Finish()
{
  if (!m_File.Sync() || !this->SyncUncached())
  {
    FailWithErrno(ExitStatus::Failure, "bring to the disk", m_FileName);
  }
  if (m_File.GetSize() != m_Size)
  {
    Fail(ExitStatus::Failure, m_FileName.string(), " has ", m_File.GetSize(), " bytes after writing, not ", m_Size);
  }
}

void
WriteText(OutputFile & file, std::string_view text)
{
  file.SetSize(text.size(), false);
  file.WriteAt(0, text.data(), text.size());
  file.Finish();
}

void
WriteTextFile(const std::filesystem::path & fileName, std::string_view text, bool overwrite)
{
  OutputFile file(fileName, overwrite);
  file.CreateNamed(0, false);
  WriteText(file, text);
  file.Publish();
}

} // end namespace medialvoxel
