// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "FileNames.h"
#include "OutputFile.h"
#include "SystemFile.h"
#include "TemporaryName.h"

#include <algorithm>
#include <cerrno>
#include <utility>
#include <vector>

// How an output file gets its name.

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t BlockSize = std::uint64_t{ 1 } << 20;

} // namespace

void
OutputFile::TakeTemporaryName()
{
  const NameMaker makeName = this->GetNameMaker();
  for (int attempt = 0; m_IsNameless; ++attempt)
  {
    const std::filesystem::path name = makeName(attempt);
    if (m_File.GiveName(name))
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

/** For systems that let a program create a file without a name, but not name it. */
void
OutputFile::CopyToTemporaryName()
{
  OutputFile source(m_FileName, m_Overwrite);
  std::swap(source.m_File, m_File);
  m_Uncached.reset();
  m_IsNameless = false;
  this->OpenUnder(this->GetNameMaker());
  this->SetSize(m_Size, false);
  std::vector<char> buffer(BlockSize);
  for (std::uint64_t begin = 0; begin < m_Size; begin += BlockSize)
  {
    const std::uint64_t count = std::min(BlockSize, m_Size - begin);
    source.ReadAt(begin, buffer.data(), count);
    this->WriteSparseAt(begin, buffer.data(), count);
  }
  this->Finish();
}

/** Gives the file its name if none has it. \return false when one has */
bool
OutputFile::TakeFreeName()
{
  if (m_IsNameless && m_File.GiveName(m_FileName))
  {
    m_IsNameless = false;
    return true;
  }
  if (m_IsNameless && errno == EEXIST)
  {
    return false;
  }
  this->TakeTemporaryName();
  if (Rename(m_TemporaryName, m_FileName, TakenName::Stays))
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
  if (m_TemporaryName.empty() || !AddName(m_TemporaryName, m_FileName))
  {
    const bool isTaken = !m_TemporaryName.empty() && errno == EEXIST;
    return !isTaken && this->TakeFreeName();
  }
  RemoveName(m_TemporaryName);
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
  if (!Rename(m_TemporaryName, m_FileName, TakenName::IsLost))
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
  if (!Rename(m_TemporaryName, m_FileName, TakenName::Exchanges))
  {
    return errno == ENOSYS && this->ReplaceLinkedFile();
  }
  const auto status = GetFileStatus(m_TemporaryName, false);
  if (status && status->isFolder)
  {
    Rename(m_TemporaryName, m_FileName, TakenName::Exchanges);
    errno = EISDIR;
    FailWithErrno(ExitStatus::Failure, "give its name to", m_FileName);
  }
  return true;
}

/** The same in two steps, for file systems that have second names. */
bool
OutputFile::ReplaceLinkedFile()
{
  const SystemFile      lock = SystemFile::OpenInTurn(m_FileName);
  const NameMaker       makeName = this->GetNameMaker();
  std::filesystem::path aside;
  for (int attempt = 0; aside.empty(); ++attempt)
  {
    const std::filesystem::path name = makeName(attempt);
    if (AddName(m_FileName, name))
    {
      aside = name;
    }
    else if (errno != EEXIST || attempt == MaximumTemporaryNames)
    {
      return false;
    }
  }
  if (!Rename(m_TemporaryName, m_FileName, TakenName::IsLost))
  {
    const int error = errno;
    RemoveName(aside);
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
  m_IsForNow = AddName(m_TemporaryName, m_FileName);
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
    RemoveName(m_TemporaryName);
    m_TemporaryName.clear();
  }
}

void
OutputFile::SetFileName(const std::filesystem::path & fileName)
{
  m_FileName = fileName;
}

} // end namespace medialvoxel
