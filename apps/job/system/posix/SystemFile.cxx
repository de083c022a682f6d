// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SystemFile.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

/** Transferred at a time: a fraction of a second, after which the work can stop. */
constexpr std::uint64_t BlockSize = std::uint64_t{ 1 } << 23;

constexpr int Unopened = -1;

// Locks of an open file, where the system has them, belong to it and not to all of the process.
#ifdef F_OFD_SETLK
constexpr int SetLock = F_OFD_SETLK;
constexpr int GetLock = F_OFD_GETLK;
#else
constexpr int SetLock = F_SETLK;
constexpr int GetLock = F_GETLK;
#endif

FileStatus
MakeStatus(const struct stat & status)
{
#ifdef __APPLE__
  const timespec & time = status.st_mtimespec;
#else
  const timespec & time = status.st_mtim;
#endif
  constexpr std::int64_t perSecond = 1000000000;
  FileStatus             result;
  result.isFile = S_ISREG(status.st_mode);
  result.isFolder = S_ISDIR(status.st_mode);
  result.isOfThisUser = status.st_uid == geteuid();
  result.numberOfBytes = static_cast<std::uint64_t>(status.st_size);
  result.numberOfNames = status.st_nlink;
  result.disk = status.st_dev;
  result.number = status.st_ino;
  result.modified = static_cast<std::int64_t>(time.tv_sec) * perSecond + static_cast<std::int64_t>(time.tv_nsec);
  return result;
}

int
GetFlags(FileAccess access)
{
  switch (access)
  {
    case FileAccess::Read:
      return O_RDONLY | O_NONBLOCK;
    case FileAccess::Write:
      return O_WRONLY;
    case FileAccess::WriteUncached:
#ifdef O_DIRECT
      return O_WRONLY | O_DIRECT;
#else
      break;
#endif
    case FileAccess::Change:
      return O_RDWR;
    case FileAccess::Make:
      return O_RDWR | O_CREAT;
    case FileAccess::MakeEmpty:
      return O_RDWR | O_CREAT | O_TRUNC;
    case FileAccess::MakeNew:
      return O_RDWR | O_CREAT | O_EXCL;
    case FileAccess::MakeLog:
      return O_RDWR | O_CREAT | O_APPEND | O_NOCTTY;
  }
  return -1;
}

int
Open(const std::filesystem::path & name, FileAccess access)
{
  const int flags = GetFlags(access);
  errno = ENOTSUP;
  return flags < 0 ? Unopened : open(name.c_str(), flags | O_CLOEXEC, 0666);
}

/** A new file that no folder lists. */
int
OpenNameless([[maybe_unused]] const std::filesystem::path & folder, [[maybe_unused]] mode_t mode)
{
#ifdef O_TMPFILE
  return open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
#else
  errno = EOPNOTSUPP;
  return Unopened;
#endif
}

/** Repeats a call of the system until all bytes are through. */
template <typename TByte, typename TCall>
bool
Transfer(std::uint64_t offset, TByte * data, std::uint64_t numberOfBytes, TCall call)
{
  for (std::uint64_t done = 0; done < numberOfBytes;)
  {
    if (done > 0)
    {
      itk::MedialVoxelCheckAbort();
    }
    const std::uint64_t wanted = std::min(numberOfBytes - done, BlockSize);
    const ssize_t       count = call(data + done, wanted, static_cast<off_t>(offset + done));
    if (count > 0)
    {
      done += static_cast<std::uint64_t>(count);
    }
    else if (count == 0)
    {
      errno = ENODATA;
      return false;
    }
    else if (errno != EINTR)
    {
      return false;
    }
  }
  return true;
}

struct flock
DescribeByte(int type, std::uint64_t position)
{
  struct flock lock = {};
  lock.l_type = static_cast<short>(type);
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(position);
  lock.l_len = 1;
  return lock;
}

} // namespace

std::optional<FileStatus>
GetFileStatus(const std::filesystem::path & name, bool followsLinks)
{
  struct stat status = {};
  const int   result = followsLinks ? stat(name.c_str(), &status) : lstat(name.c_str(), &status);
  return result == 0 ? std::optional(MakeStatus(status)) : std::nullopt;
}

bool
Rename(const std::filesystem::path & from, const std::filesystem::path & to, TakenName taken)
{
  if (taken == TakenName::IsLost)
  {
    return rename(from.c_str(), to.c_str()) == 0;
  }
#if defined(RENAME_EXCHANGE) || defined(RENAME_SWAP)
#  ifdef RENAME_EXCHANGE
  const unsigned int flag = taken == TakenName::Stays ? RENAME_NOREPLACE : RENAME_EXCHANGE;
  const int          result = renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flag);
#  else
  const unsigned int flag = taken == TakenName::Stays ? RENAME_EXCL : RENAME_SWAP;
  const int          result = renamex_np(from.c_str(), to.c_str(), flag);
#  endif
  if (result == 0 || (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP))
  {
    return result == 0;
  }
#endif
  // File systems without these renames: a moment remains between the question and the answer.
  if (taken == TakenName::Exchanges || access(to.c_str(), F_OK) == 0)
  {
    errno = taken == TakenName::Exchanges ? ENOSYS : EEXIST;
    return false;
  }
  return rename(from.c_str(), to.c_str()) == 0;
}

bool
AddName(const std::filesystem::path & file, const std::filesystem::path & name)
{
  return link(file.c_str(), name.c_str()) == 0;
}

void
RemoveName(const std::filesystem::path & name)
{
  unlink(name.c_str());
}

bool
MakeFolder(const std::filesystem::path & name)
{
  return mkdir(name.c_str(), 0777) == 0;
}

std::FILE *
OpenStream(const std::filesystem::path & name)
{
  return std::fopen(name.c_str(), "rb");
}

SystemFile::SystemFile(const std::filesystem::path & name, FileAccess access)
  : m_Descriptor(Open(name, access))
{}

SystemFile::~SystemFile()
{
  const int error = errno;
  this->Close();
  errno = error;
}

SystemFile
SystemFile::MakeNameless(const std::filesystem::path & folder)
{
  SystemFile file(OpenNameless(folder, 0666));
  // Without /proc, it could get no name.
  return file.IsOpen() && access(file.GetOwnName().c_str(), F_OK) == 0 ? std::move(file) : SystemFile();
}

SystemFile
SystemFile::MakeScratch(const std::filesystem::path & folder)
{
  SystemFile file(OpenNameless(folder, 0600));
  if (file.IsOpen() || (errno != EOPNOTSUPP && errno != EISDIR))
  {
    return file;
  }
  std::string name = (folder / "medialvoxel-XXXXXX").string();
  SystemFile  named(mkstemp(name.data()));
  if (named.IsOpen())
  {
    unlink(name.c_str());
  }
  return named;
}

SystemFile
SystemFile::OpenInTurn(const std::filesystem::path & name)
{
  // Another process may replace the file before this one has the lock.
  constexpr int mostAttempts = 1000;
  SystemFile    file;
  for (int attempt = 0; attempt < mostAttempts; ++attempt)
  {
    file = SystemFile(name, FileAccess::Change);
    const bool isLocked = file.IsOpen() && flock(file.m_Descriptor, LOCK_EX) == 0;
    const auto locked = file.GetStatus();
    const auto named = GetFileStatus(name);
    if (!isLocked || !locked || !named || (locked->disk == named->disk && locked->number == named->number))
    {
      break;
    }
  }
  return file;
}

bool
SystemFile::Close()
{
  const int descriptor = std::exchange(m_Descriptor, Unopened);
  return descriptor < 0 || close(descriptor) == 0;
}

std::optional<FileStatus>
SystemFile::GetStatus() const
{
  struct stat status = {};
  return fstat(m_Descriptor, &status) == 0 ? std::optional(MakeStatus(status)) : std::nullopt;
}

std::uint64_t
SystemFile::GetSize() const
{
  return this->GetStatus().value_or(FileStatus{}).numberOfBytes;
}

std::filesystem::path
SystemFile::GetOwnName() const
{
  return "/proc/self/fd/" + std::to_string(m_Descriptor);
}

bool
SystemFile::GiveName(const std::filesystem::path & name) const
{
  return linkat(AT_FDCWD, this->GetOwnName().c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

bool
SystemFile::ReadAt(std::uint64_t offset, char * data, std::uint64_t numberOfBytes) const
{
  return Transfer(offset, data, numberOfBytes, [this](auto... arguments) { return pread(m_Descriptor, arguments...); });
}

bool
SystemFile::WriteAt(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes)
{
  return Transfer(
    offset, data, numberOfBytes, [this](auto... arguments) { return pwrite(m_Descriptor, arguments...); });
}

bool
SystemFile::Append(const char * data, std::uint64_t numberOfBytes)
{
  return write(m_Descriptor, data, numberOfBytes) == static_cast<ssize_t>(numberOfBytes);
}

bool
SystemFile::SetSize(std::uint64_t numberOfBytes)
{
  return ftruncate(m_Descriptor, static_cast<off_t>(numberOfBytes)) == 0;
}

bool
SystemFile::Reserve(std::uint64_t numberOfBytes)
{
#ifdef __linux__
  // Not posix_fallocate, which writes a byte into each block where it cannot reserve: hours through a network.
  int error = EINTR;
  while (error == EINTR)
  {
    itk::MedialVoxelCheckAbort();
    error = fallocate(m_Descriptor, 0, 0, static_cast<off_t>(numberOfBytes)) == 0 ? 0 : errno;
  }
#elif defined(__APPLE__)
  const std::uint64_t size = std::min(this->GetSize(), numberOfBytes);
  fstore_t            space = {};
  space.fst_flags = F_ALLOCATEALL;
  space.fst_posmode = F_PEOFPOSMODE;
  space.fst_length = static_cast<off_t>(numberOfBytes - size);
  const bool isReserved =
    size == numberOfBytes || (fcntl(m_Descriptor, F_PREALLOCATE, &space) != -1 && this->SetSize(numberOfBytes));
  const int error = isReserved ? 0 : errno;
#else
  const int error = posix_fallocate(m_Descriptor, 0, static_cast<off_t>(numberOfBytes));
#endif
  errno = error;
  // Apple has two numbers for "not supported".
  return error == 0 || error == ENOTSUP || error == EOPNOTSUPP || error == ENOSYS || error == EINVAL;
}

bool
SystemFile::SyncData() const
{
#ifdef __APPLE__
  return this->Sync();
#else
  return fdatasync(m_Descriptor) == 0;
#endif
}

bool
SystemFile::Sync() const
{
#ifdef F_FULLFSYNC
  // There fsync leaves data in the cache of the disk; file systems of networks know fsync alone.
  if (m_Descriptor >= 0 && fcntl(m_Descriptor, F_FULLFSYNC) != -1)
  {
    return true;
  }
#endif
  return m_Descriptor >= 0 && fsync(m_Descriptor) == 0;
}

void
SystemFile::StartSync([[maybe_unused]] std::uint64_t offset, [[maybe_unused]] std::uint64_t numberOfBytes) const
{
#ifdef SYNC_FILE_RANGE_WRITE
  sync_file_range(
    m_Descriptor, static_cast<off64_t>(offset), static_cast<off64_t>(numberOfBytes), SYNC_FILE_RANGE_WRITE);
#endif
}

bool
SystemFile::LockByte(std::uint64_t position)
{
  struct flock lock = DescribeByte(F_WRLCK, position);
  while (fcntl(m_Descriptor, SetLock, &lock) != 0)
  {
    if (errno == EINTR)
    {
      continue;
    }
    if (errno == EACCES)
    {
      errno = EAGAIN;
    }
    else if (errno == ENOSYS || errno == EOPNOTSUPP || errno == EINVAL)
    {
      errno = ENOLCK;
    }
    return false;
  }
  return true;
}

void
SystemFile::UnlockByte(std::uint64_t position)
{
  struct flock lock = DescribeByte(F_UNLCK, position);
  fcntl(m_Descriptor, SetLock, &lock);
}

bool
SystemFile::IsByteLocked(std::uint64_t position) const
{
  struct flock lock = DescribeByte(F_WRLCK, position);
  return fcntl(m_Descriptor, GetLock, &lock) == 0 && lock.l_type != F_UNLCK;
}

} // end namespace medialvoxel
