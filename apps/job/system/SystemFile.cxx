// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FileTransfer.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

/** What is transferred at a time: a fraction of a second, after which the work can stop. */
constexpr std::uint64_t BytesAtATime = std::uint64_t{ 1 } << 23;

/** Repeats a call of the system until all bytes are through. */
template <typename TByte, typename TCall>
bool
Transfer(std::uint64_t offset, TByte * data, std::uint64_t numberOfBytes, TCall call)
{
  for (std::uint64_t done = 0; done < numberOfBytes;)
  {
    if (done > 0)
    {
      itk::MedialVoxelPoll();
    }
    const std::uint64_t wanted = std::min(numberOfBytes - done, BytesAtATime);
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

} // namespace

bool
WriteFully(int descriptor, std::uint64_t offset, const char * data, std::uint64_t numberOfBytes)
{
  return Transfer(
    offset, data, numberOfBytes, [descriptor](auto... arguments) { return pwrite(descriptor, arguments...); });
}

bool
ReadFully(int descriptor, std::uint64_t offset, char * data, std::uint64_t numberOfBytes)
{
  return Transfer(
    offset, data, numberOfBytes, [descriptor](auto... arguments) { return pread(descriptor, arguments...); });
}

bool
ReserveSpace(int descriptor, std::uint64_t numberOfBytes)
{
#ifdef __linux__
  // Not posix_fallocate, which writes a byte into each block where it cannot reserve: hours through a network.
  int error = EINTR;
  while (error == EINTR)
  {
    itk::MedialVoxelPoll();
    error = fallocate(descriptor, 0, 0, static_cast<off_t>(numberOfBytes)) == 0 ? 0 : errno;
  }
#else
  const int error = posix_fallocate(descriptor, 0, static_cast<off_t>(numberOfBytes));
#endif
  errno = error;
  return error == 0 || error == EOPNOTSUPP || error == ENOSYS || error == EINVAL;
}

void
StartWriteBack([[maybe_unused]] int           descriptor,
               [[maybe_unused]] std::uint64_t offset,
               [[maybe_unused]] std::uint64_t numberOfBytes)
{
#ifdef SYNC_FILE_RANGE_WRITE
  sync_file_range(descriptor, static_cast<off64_t>(offset), static_cast<off64_t>(numberOfBytes), SYNC_FILE_RANGE_WRITE);
#endif
}

} // end namespace medialvoxel
