// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "WindowsError.h"

#include <algorithm>
#include <cerrno>
#include <iterator>

namespace medialvoxel
{
namespace
{

struct Meaning
{
  DWORD error;
  int   number;
};

constexpr Meaning Meanings[] = {
  { ERROR_FILE_NOT_FOUND, ENOENT },
  { ERROR_PATH_NOT_FOUND, ENOENT },
  { ERROR_INVALID_NAME, ENOENT },
  { ERROR_BAD_PATHNAME, ENOENT },
  { ERROR_BAD_NETPATH, ENOENT },
  { ERROR_INVALID_DRIVE, ENOENT },
  { ERROR_FILE_EXISTS, EEXIST },
  { ERROR_ALREADY_EXISTS, EEXIST },
  { ERROR_ACCESS_DENIED, EACCES },
  { ERROR_SHARING_VIOLATION, EACCES },
  { ERROR_WRITE_PROTECT, EROFS },
  { ERROR_PRIVILEGE_NOT_HELD, EPERM },
  { ERROR_LOCK_VIOLATION, EAGAIN },
  { ERROR_IO_PENDING, EAGAIN },
  { ERROR_NO_SYSTEM_RESOURCES, ENOLCK },
  { ERROR_DISK_FULL, ENOSPC },
  { ERROR_HANDLE_DISK_FULL, ENOSPC },
  { ERROR_NOT_ENOUGH_QUOTA, ENOMEM },
  { ERROR_FILE_TOO_LARGE, EFBIG },
  { ERROR_DIR_NOT_EMPTY, ENOTEMPTY },
  { ERROR_DIRECTORY, ENOTDIR },
  { ERROR_INVALID_HANDLE, EBADF },
  { ERROR_NOT_ENOUGH_MEMORY, ENOMEM },
  { ERROR_OUTOFMEMORY, ENOMEM },
  { ERROR_TOO_MANY_OPEN_FILES, EMFILE },
  { ERROR_HANDLE_EOF, ENODATA },
  { ERROR_NOT_SUPPORTED, ENOSYS },
  { ERROR_INVALID_FUNCTION, ENOSYS },
  { ERROR_NOT_SAME_DEVICE, EXDEV },
  { ERROR_TOO_MANY_LINKS, EMLINK },
  { ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG },
  { ERROR_BROKEN_PIPE, EPIPE },
  { ERROR_NO_DATA, EPIPE },
  { ERROR_INVALID_PARAMETER, EINVAL },
};

} // namespace

bool
FailWithWindowsError()
{
  const DWORD        error = GetLastError();
  const auto * const found = std::find_if(
    std::begin(Meanings), std::end(Meanings), [error](const Meaning & meaning) { return meaning.error == error; });
  errno = found == std::end(Meanings) ? EIO : found->number;
  return false;
}

} // end namespace medialvoxel
