// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FileNames.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <random>
#include <unistd.h>

namespace medialvoxel
{

void
FailWithErrno(ExitStatus status, const char * action, const std::filesystem::path & name)
{
  Fail(status, "cannot ", action, " ", name.string(), ": ", std::strerror(errno));
}

std::filesystem::path
FollowLinks(const std::filesystem::path & fileName)
{
  constexpr int         maximumLinks = 40;
  std::filesystem::path target = fileName;
  std::error_code       error;
  for (int link = 0; link < maximumLinks && std::filesystem::is_symlink(target, error); ++link)
  {
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
  }
  return target;
}

std::filesystem::path
FolderOf(const std::filesystem::path & fileName)
{
  return fileName.has_parent_path() ? fileName.parent_path() : std::filesystem::path(".");
}

int
RenameToFreeName(const char * from, const char * to)
{
#ifdef RENAME_NOREPLACE
  const int result = renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
  if (result == 0 || (errno != EINVAL && errno != ENOSYS))
  {
    return result;
  }
#endif
  // File systems without such a rename: a moment remains between the question and the answer.
  if (access(to, F_OK) == 0)
  {
    errno = EEXIST;
    return -1;
  }
  return rename(from, to);
}

int
ExchangeNames([[maybe_unused]] const char * a, [[maybe_unused]] const char * b)
{
#ifdef RENAME_EXCHANGE
  return renameat2(AT_FDCWD, a, AT_FDCWD, b, RENAME_EXCHANGE);
#else
  errno = ENOSYS;
  return -1;
#endif
}

std::string
MakeUniqueDigits()
{
  std::random_device  source;
  std::array<char, 9> digits{};
  std::string         text;
  for (int half = 0; half < 2; ++half)
  {
    std::snprintf(digits.data(), digits.size(), "%08x", source() & 0xffffffffu);
    text += digits.data();
  }
  return text;
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
    Fail(ExitStatus::Failure, "cannot write to the disk ", file.string(), ": ", std::strerror(error));
  }
}

void
SyncFolder(const std::filesystem::path & folder)
{
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0)
  {
    fsync(descriptor);
    close(descriptor);
  }
}

} // end namespace medialvoxel
