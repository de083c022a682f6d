// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobLocks.h"

#include "Errors.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

// Locks of an open file, where the system has them, belong to one JobLocks and not to all of a process.
#ifdef F_OFD_SETLK
constexpr int SetLock = F_OFD_SETLK;
constexpr int GetLock = F_OFD_GETLK;
#else
constexpr int SetLock = F_SETLK;
constexpr int GetLock = F_GETLK;
#endif

struct flock
DescribeByte(int type, std::uint64_t thing)
{
  struct flock lock = {};
  lock.l_type = static_cast<short>(type);
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(thing);
  lock.l_len = 1;
  return lock;
}

/** True when the file system has no locks; other errors are those of a server that cannot be reached. */
bool
HasNoLocks(int error)
{
  return error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP || error == EINVAL;
}

} // namespace

JobLocks::Lock::~Lock()
{
  if (m_Descriptor >= 0)
  {
    struct flock lock = DescribeByte(F_UNLCK, m_Thing);
    fcntl(m_Descriptor, SetLock, &lock);
  }
}

JobLocks::JobLocks(const std::filesystem::path & fileName)
  : m_FileName(fileName)
  , m_Descriptor(open(fileName.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
{
  if (m_Descriptor < 0)
  {
    Fail(ExitStatus::Failure, "cannot open ", fileName.string(), ": ", std::strerror(errno));
  }
}

JobLocks::~JobLocks()
{
  close(m_Descriptor);
}

std::optional<JobLocks::Lock>
JobLocks::TryLock(std::uint64_t thing)
{
  struct flock lock = DescribeByte(F_WRLCK, thing);
  int          result = 0;
  do
  {
    result = fcntl(m_Descriptor, SetLock, &lock);
  } while (result != 0 && errno == EINTR);
  if (result == 0)
  {
    return Lock(m_Descriptor, thing);
  }
  if (errno == EAGAIN || errno == EACCES)
  {
    return std::nullopt;
  }
  if (!HasNoLocks(errno))
  {
    Fail(ExitStatus::Failure, "cannot lock ", m_FileName.string(), ": ", std::strerror(errno));
  }
  return Lock(-1, thing);
}

bool
IsLocked(const std::filesystem::path & fileName, std::uint64_t thing)
{
  const int descriptor = open(fileName.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    return false;
  }
  struct flock lock = DescribeByte(F_WRLCK, thing);
  const bool   isKnown = fcntl(descriptor, GetLock, &lock) == 0;
  close(descriptor);
  return isKnown && lock.l_type != F_UNLCK;
}

} // end namespace medialvoxel
