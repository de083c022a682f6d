// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputFolder.h"

#include "Errors.h"
#include "FileNames.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

constexpr int MaximumTemporaryNames = 1000;

[[noreturn]] void
FailWithErrno(ExitStatus status, const char * action, const std::filesystem::path & name)
{
  Fail(status, "cannot ", action, " ", name.string(), ": ", std::strerror(errno));
}

/** Lets two folders change their names at once; false with EINVAL or ENOSYS where the system cannot. */
bool
ExchangeNames([[maybe_unused]] const std::filesystem::path & a, [[maybe_unused]] const std::filesystem::path & b)
{
#ifdef RENAME_EXCHANGE
  return renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  errno = ENOSYS;
  return false;
#endif
}

void
SyncFile(const std::filesystem::path & file)
{
  const int  descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool isSynced = descriptor >= 0 && fsync(descriptor) == 0;
  const int  error = errno;
  if (descriptor >= 0)
  {
    close(descriptor);
  }
  if (!isSynced)
  {
    errno = error;
    FailWithErrno(ExitStatus::Failure, "bring to the disk", file);
  }
}

} // namespace

OutputFolder::OutputFolder(const std::filesystem::path & name, bool overwrite)
  : m_Name(FollowLinks(name))
  , m_Overwrite(overwrite)
{}

OutputFolder::~OutputFolder()
{
  if (!m_TemporaryName.empty())
  {
    std::error_code error;
    std::filesystem::remove_all(m_TemporaryName, error);
  }
}

void
OutputFolder::Create()
{
  for (int attempt = 0; m_TemporaryName.empty(); ++attempt)
  {
    std::filesystem::path name = m_Name;
    name += "." + std::to_string(getpid()) + "-" + std::to_string(attempt) + ".partial";
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
OutputFolder::Finish()
{
  for (const auto & entry : std::filesystem::recursive_directory_iterator(m_TemporaryName))
  {
    entry.is_directory() ? SyncFolder(entry.path()) : SyncFile(entry.path());
  }
  SyncFolder(m_TemporaryName);
}

void
OutputFolder::Publish()
{
  if (RenameToFreeName(m_TemporaryName.c_str(), m_Name.c_str()) == 0)
  {
    m_TemporaryName.clear();
  }
  else if (errno == EEXIST && m_Overwrite)
  {
    this->Replace();
  }
  else
  {
    FailWithErrno(errno == EEXIST ? ExitStatus::Refused : ExitStatus::Failure, "give its name to", m_Name);
  }
  SyncFolder(FolderOf(m_Name));
}

/** The destructor removes the replaced folder, which then has the temporary name. */
void
OutputFolder::Replace()
{
  if (ExchangeNames(m_TemporaryName, m_Name))
  {
    return;
  }
  std::filesystem::path aside = m_TemporaryName;
  aside += ".old";
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
  m_TemporaryName = aside;
}

} // end namespace medialvoxel
