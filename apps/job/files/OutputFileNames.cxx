// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "FileNames.h"
#include "OutputFile.h"
#include "TemporaryName.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

// How an output file gets its name.

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t CopiedBytes = std::uint64_t{ 1 } << 20;

/** \class FileLock
 * \brief Holds off others that have this lock until its end, where the file system can and the file may be written. */
class FileLock
{
public:
  explicit FileLock(const std::filesystem::path & fileName)
  {
    for (int attempt = 0; !this->Open(fileName) && attempt < MaximumTemporaryNames; ++attempt)
    {
      // Another process replaced the file before this one had the lock.
    }
  }
  ~FileLock()
  {
    if (m_Descriptor >= 0)
    {
      close(m_Descriptor);
    }
  }
  FileLock(const FileLock &) = delete;
  FileLock &
  operator=(const FileLock &) = delete;

private:
  /** False when it locked a file that has lost its name. */
  bool
  Open(const std::filesystem::path & fileName)
  {
    if (m_Descriptor >= 0)
    {
      close(m_Descriptor);
    }
    struct stat locked = {};
    struct stat named = {};
    m_Descriptor = open(fileName.c_str(), O_RDWR | O_CLOEXEC);
    if (m_Descriptor < 0 || flock(m_Descriptor, LOCK_EX) != 0 || fstat(m_Descriptor, &locked) != 0 ||
        stat(fileName.c_str(), &named) != 0)
    {
      return true;
    }
    return locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
  }

  int m_Descriptor{ -1 };
};

} // namespace

void
OutputFile::TakeTemporaryName()
{
  const NameMaker makeName = this->GetNameMaker();
  for (int attempt = 0; m_IsNameless; ++attempt)
  {
    const std::filesystem::path name = makeName(attempt);
    if (LinkNamelessFile(m_Descriptor, name) == 0)
    {
      m_TemporaryName = name;
      m_IsNameless = false;
    }
    else if (errno != EEXIST || attempt == MaximumTemporaryNames)
    {
      this->CopyToTemporaryName();
    }
  }
}

/** For systems that let a program create such a file, but not give it a name. */
void
OutputFile::CopyToTemporaryName()
{
  OutputFile source(m_FileName, m_Overwrite);
  std::swap(source.m_Descriptor, m_Descriptor);
  m_Uncached.reset();
  m_IsNameless = false;
  this->OpenUnder(this->GetNameMaker());
  this->SetSize(m_Size, false);
  std::vector<char> buffer(CopiedBytes);
  for (std::uint64_t begin = 0; begin < m_Size; begin += CopiedBytes)
  {
    const std::uint64_t count = std::min(CopiedBytes, m_Size - begin);
    source.ReadAt(begin, buffer.data(), count);
    this->WriteSparseAt(begin, buffer.data(), count);
  }
  this->Finish();
}

/** Gives the file its name if none has it. \return false when one has */
bool
OutputFile::TakeFreeName()
{
  if (m_IsNameless && LinkNamelessFile(m_Descriptor, m_FileName) == 0)
  {
    m_IsNameless = false;
    return true;
  }
  if (m_IsNameless && errno == EEXIST)
  {
    return false;
  }
  this->TakeTemporaryName();
  if (RenameToFreeName(m_TemporaryName.c_str(), m_FileName.c_str()) == 0)
  {
    m_TemporaryName.clear();
    return true;
  }
  if (errno != EEXIST)
  {
    FailWithErrno(ExitStatus::Failure, "give its name to", m_FileName);
  }
  return false;
}

/** As TakeFreeName(), but surer where the file system cannot rename to a free name only. */
bool
OutputFile::LinkFreeName()
{
  if (m_TemporaryName.empty() || link(m_TemporaryName.c_str(), m_FileName.c_str()) != 0)
  {
    const bool isTaken = !m_TemporaryName.empty() && errno == EEXIST;
    return !isTaken && this->TakeFreeName();
  }
  unlink(m_TemporaryName.c_str());
  m_TemporaryName.clear();
  return true;
}

void
OutputFile::Publish()
{
  if (!m_IsNameless && m_TemporaryName.empty())
  {
    return;
  }
  const bool mayBeFree = m_IsNameless || !m_Overwrite;
  if (!mayBeFree || !this->TakeFreeName())
  {
    this->Replace();
  }
  SyncFolder(FolderOf(m_FileName));
}

void
OutputFile::Replace()
{
  if (!m_Overwrite)
  {
    errno = EEXIST;
    FailWithErrno(ExitStatus::Refused, "give its name to", m_FileName);
  }
  this->TakeTemporaryName();
  if (rename(m_TemporaryName.c_str(), m_FileName.c_str()) != 0)
  {
    FailWithErrno(ExitStatus::Failure, "give its name to", m_FileName);
  }
  m_TemporaryName.clear();
}

bool
OutputFile::PublishByExchange()
{
  bool isExchanged = false;
  bool hasName = this->LinkFreeName();
  while (!hasName && m_Overwrite)
  {
    this->TakeTemporaryName();
    isExchanged = this->ExchangeWithFile();
    // The file that had the name may be gone meanwhile.
    hasName = isExchanged || errno != ENOENT || this->LinkFreeName();
  }
  const bool needsName = m_IsNameless || !m_TemporaryName.empty();
  if (!isExchanged && needsName)
  {
    this->Replace();
  }
  this->SyncNamesWithoutOrder();
  return isExchanged;
}

/** False with errno, as where the file system cannot. */
bool
OutputFile::ExchangeWithFile()
{
  if (ExchangeNames(m_TemporaryName.c_str(), m_FileName.c_str()) != 0)
  {
    return (errno == EINVAL || errno == ENOSYS) && this->ReplaceLinkedFile();
  }
  struct stat status = {};
  if (lstat(m_TemporaryName.c_str(), &status) == 0 && S_ISDIR(status.st_mode))
  {
    ExchangeNames(m_TemporaryName.c_str(), m_FileName.c_str());
    errno = EISDIR;
    FailWithErrno(ExitStatus::Failure, "give its name to", m_FileName);
  }
  return true;
}

/** The same in two steps, for file systems that have second names. */
bool
OutputFile::ReplaceLinkedFile()
{
  const FileLock        lock(m_FileName);
  const NameMaker       makeName = this->GetNameMaker();
  std::filesystem::path aside;
  for (int attempt = 0; aside.empty(); ++attempt)
  {
    const std::filesystem::path name = makeName(attempt);
    if (link(m_FileName.c_str(), name.c_str()) == 0)
    {
      aside = name;
    }
    else if (errno != EEXIST || attempt == MaximumTemporaryNames)
    {
      return false;
    }
  }
  const bool isReplaced = rename(m_TemporaryName.c_str(), m_FileName.c_str()) == 0;
  const int  error = errno;
  if (!isReplaced)
  {
    unlink(aside.c_str());
    errno = error;
    FailWithErrno(ExitStatus::Failure, "give its name to", m_FileName);
  }
  m_TemporaryName = aside;
  return true;
}

/** File systems that have files without a name bring names to the disk in the order in which they are given: a journal
 * has them. For the others, each name waits for the one before. */
void
OutputFile::SyncNamesWithoutOrder() const
{
  if (!m_KeepsOrder)
  {
    SyncFolder(FolderOf(m_FileName));
  }
}

bool
OutputFile::PublishForNow()
{
  this->TakeTemporaryName();
  m_IsForNow = link(m_TemporaryName.c_str(), m_FileName.c_str()) == 0;
  if (!m_IsForNow && errno != EEXIST)
  {
    // The file system has no second names.
    m_IsForNow = this->TakeFreeName();
  }
  this->SyncNamesWithoutOrder();
  return m_IsForNow;
}

void
OutputFile::KeepName()
{
  m_IsForNow = false;
  if (!m_TemporaryName.empty())
  {
    unlink(m_TemporaryName.c_str());
    m_TemporaryName.clear();
  }
}

void
OutputFile::SetFileName(const std::filesystem::path & fileName)
{
  m_FileName = fileName;
}

} // end namespace medialvoxel
