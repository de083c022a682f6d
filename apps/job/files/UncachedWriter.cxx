// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "UncachedWriter.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cstring>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t BufferSize = std::uint64_t{ 1 } << 21;

} // namespace

UncachedWriter::UncachedWriter(const std::filesystem::path & fileName)
  : m_File(fileName, FileAccess::WriteUncached)
  , m_Buffer(static_cast<char *>(operator new(BufferSize, Alignment, std::nothrow)))
{}

bool
UncachedWriter::WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes)
{
  const auto * bytes = static_cast<const char *>(data);
  for (std::uint64_t done = 0; done < numberOfBytes; done += BufferSize)
  {
    if (done > 0)
    {
      itk::MedialVoxelCheckAbort();
    }
    const std::uint64_t length = std::min(BufferSize, numberOfBytes - done);
    std::memcpy(m_Buffer.get(), bytes + done, length);
    // After a part of a block, nothing that begins there is aligned, and the system refuses the rest by EINVAL.
    if (!m_File.WriteAt(offset + done, m_Buffer.get(), length))
    {
      return false;
    }
  }
  return true;
}

} // end namespace medialvoxel
