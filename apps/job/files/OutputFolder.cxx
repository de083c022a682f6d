// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputFolder.h"

#include "Errors.h"
#include "FileNames.h"
#include "TemporaryName.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace medialvoxel
{

OutputFolder::OutputFolder(const std::filesystem::path & name, bool overwrite)
  : m_Name(FollowLinks(name))
  , m_Overwrite(overwrite)
{}

OutputFolder::~OutputFolder()
{
  std::error_code error;
  if (m_RemovesReplaced)
  {
    // The folder that was replaced, under one name or the other.
    std::filesystem::remove_all(m_TemporaryName, error);
    std::filesystem::remove_all(this->GetNameAside(), error);
  }
  else if (!m_IsPublished && m_Suffix.empty() && !m_TemporaryName.empty())
  {
    std::filesystem::remove_all(m_TemporaryName, error);
  }
}

std::filesystem::path
OutputFolder::GetSharedName(const std::string & suffix) const
{
  return m_Name.string() + suffix;
}

std::filesystem::path
OutputFolder::GetNameAside() const
{
  return m_TemporaryName.string() + ".old";
}

void
OutputFolder::Create()
{
  for (int attempt = 0; m_TemporaryName.empty(); ++attempt)
  {
    const std::filesystem::path name = MakeTemporaryName(m_Name, attempt);
    if (mkdir(name.c_str(), 0777) == 0)
    {
      m_TemporaryName = name;
    }
    else if (errno != EEXIST || attempt == MaximumTemporaryNames)
    {
      FailWithErrno(ExitStatus::Refused, "create a folder beside", m_Name);
    }
  }
}

void
OutputFolder::CreateShared(const std::string & suffix)
{
  const std::filesystem::path name = this->GetSharedName(suffix);
  if (mkdir(name.c_str(), 0777) != 0)
  {
    FailWithErrno(ExitStatus::Refused, "create the folder", name);
  }
  m_TemporaryName = name;
  m_Suffix = suffix;
  const int mark = open((name / suffix).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (mark < 0)
  {
    FailWithErrno(ExitStatus::Refused, "create a file in", name);
  }
  close(mark);
}

void
OutputFolder::RemoveShared(const std::string & suffix) const
{
  std::error_code error;
  std::filesystem::remove_all(this->GetSharedName(suffix), error);
}

void
OutputFolder::OpenShared(const std::string & suffix)
{
  m_TemporaryName = this->GetSharedName(suffix);
  m_Suffix = suffix;
  if (access((m_TemporaryName / suffix).c_str(), F_OK) != 0)
  {
    FailWithErrno(ExitStatus::Failure, "open", m_TemporaryName);
  }
}

void
OutputFolder::OpenToPublish(const std::string & suffix, bool hasBegun)
{
  std::error_code error;
  if (hasBegun && !std::filesystem::exists(this->GetSharedName(suffix) / suffix, error))
  {
    m_TemporaryName = this->GetSharedName(suffix);
    m_Suffix = suffix;
    m_IsPublished = true;
  }
  else
  {
    this->OpenShared(suffix);
  }
}

void
OutputFolder::Finish()
{
  for (const auto & entry : std::filesystem::recursive_directory_iterator(this->GetPath()))
  {
    entry.is_directory() ? SyncFolder(entry.path()) : SyncFile(entry.path());
  }
  SyncFolder(this->GetPath());
}

void
OutputFolder::Publish()
{
  if (!m_IsPublished)
  {
    this->GiveName();
    m_IsPublished = true;
    SyncFolder(FolderOf(m_Name));
  }
  if (!m_Suffix.empty())
  {
    std::error_code error;
    std::filesystem::remove(m_Name / m_Suffix, error);
  }
  m_RemovesReplaced = true;
}

void
OutputFolder::GiveName()
{
  if (RenameToFreeName(m_TemporaryName.c_str(), m_Name.c_str()) == 0)
  {
    return;
  }
  if (errno != EEXIST || !m_Overwrite)
  {
    FailWithErrno(errno == EEXIST ? ExitStatus::Refused : ExitStatus::Failure, "give its name to", m_Name);
  }
  this->Replace();
}

void
OutputFolder::Replace()
{
  if (ExchangeNames(m_TemporaryName.c_str(), m_Name.c_str()) == 0)
  {
    return;
  }
  const std::filesystem::path aside = this->GetNameAside();
  if ((errno != EINVAL && errno != ENOSYS) || rename(m_Name.c_str(), aside.c_str()) != 0)
  {
    FailWithErrno(ExitStatus::Failure, "replace", m_Name);
  }
  if (rename(m_TemporaryName.c_str(), m_Name.c_str()) != 0)
  {
    const int error = errno;
    rename(aside.c_str(), m_Name.c_str());
    errno = error;
    FailWithErrno(ExitStatus::Failure, "replace", m_Name);
  }
}

} // end namespace medialvoxel
