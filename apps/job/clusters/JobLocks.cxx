// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobLocks.h"

#include "FileNames.h"

#include <cerrno>

namespace medialvoxel
{

JobLocks::Lock::~Lock()
{
  if (m_File != nullptr)
  {
    m_File->UnlockByte(m_Thing);
  }
}

JobLocks::JobLocks(const std::filesystem::path & fileName)
  : m_FileName(fileName)
  , m_File(fileName, FileAccess::Make)
{
  if (!m_File.IsOpen())
  {
    FailWithErrno(ExitStatus::Failure, "open", fileName);
  }
}

std::optional<JobLocks::Lock>
JobLocks::TryLock(std::uint64_t thing)
{
  if (m_File.LockByte(thing))
  {
    return Lock(&m_File, thing);
  }
  if (errno == EAGAIN)
  {
    return std::nullopt;
  }
  // Others are the errors of a server that cannot be reached.
  if (errno != ENOLCK)
  {
    FailWithErrno(ExitStatus::Failure, "lock", m_FileName);
  }
  return Lock(nullptr, thing);
}

bool
IsLocked(const std::filesystem::path & fileName, std::uint64_t thing)
{
  return SystemFile(fileName, FileAccess::Read).IsByteLocked(thing);
}

} // end namespace medialvoxel
