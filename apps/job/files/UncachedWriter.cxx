// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "UncachedWriter.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t BufferBytes = std::uint64_t{ 1 } << 21;

} // namespace

UncachedWriter::UncachedWriter([[maybe_unused]] const std::filesystem::path & fileName)
{
#ifdef O_DIRECT
  m_Buffer.reset(static_cast<char *>(std::aligned_alloc(BlockBytes, BufferBytes)));
  if (m_Buffer)
  {
    m_Descriptor = open(fileName.c_str(), O_WRONLY | O_DIRECT | O_CLOEXEC);
  }
#endif
}

UncachedWriter::~UncachedWriter()
{
  if (m_Descriptor >= 0)
  {
    close(m_Descriptor);
  }
}

bool
UncachedWriter::Sync() const
{
  return fsync(m_Descriptor) == 0;
}

bool
UncachedWriter::WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes)
{
  const auto * bytes = static_cast<const char *>(data);
  for (std::uint64_t done = 0; done < numberOfBytes;)
  {
    if (done > 0)
    {
      itk::MedialVoxelPoll();
    }
    const std::uint64_t length = std::min(BufferBytes, numberOfBytes - done);
    std::memcpy(m_Buffer.get(), bytes + done, length);
    const ssize_t count = pwrite(m_Descriptor, m_Buffer.get(), length, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR)
    {
      continue;
    }
    if (count < 0)
    {
      return false;
    }
    // After a part of a block, nothing that begins there is aligned.
    const std::uint64_t written = static_cast<std::uint64_t>(count) / BlockBytes * BlockBytes;
    if (written == 0)
    {
      errno = EINVAL;
      return false;
    }
    done += written;
  }
  return true;
}

} // end namespace medialvoxel
