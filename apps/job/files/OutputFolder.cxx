// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputFolder.h"

#include "Errors.h"
#include "FileNames.h"
#include "SystemFile.h"
#include "TemporaryName.h"

#include <cerrno>

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
    if (MakeFolder(name))
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
  if (!MakeFolder(name))
  {
    FailWithErrno(ExitStatus::Refused, "create the folder", name);
  }
  m_TemporaryName = name;
  m_Suffix = suffix;
  if (!SystemFile(name / suffix, FileAccess::Make).IsOpen())
  {
    FailWithErrno(ExitStatus::Refused, "create a file in", name);
  }
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
  if (!GetFileStatus(m_TemporaryName / suffix))
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
  if (Rename(m_TemporaryName, m_Name, TakenName::Stays))
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
  if (Rename(m_TemporaryName, m_Name, TakenName::Exchanges))
  {
    return;
  }
  const std::filesystem::path aside = this->GetNameAside();
  if (errno != ENOSYS || !Rename(m_Name, aside, TakenName::IsLost))
  {
    FailWithErrno(ExitStatus::Failure, "replace", m_Name);
  }
  if (!Rename(m_TemporaryName, m_Name, TakenName::IsLost))
  {
    const int error = errno;
    Rename(aside, m_Name, TakenName::IsLost);
    errno = error;
    FailWithErrno(ExitStatus::Failure, "replace", m_Name);
  }
}

} // end namespace medialvoxel
