// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrDescriptor.h"

#include "Errors.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace medialvoxel
{

ZarrDescriptor::ZarrDescriptor(const std::filesystem::path & file, int flags)
  : m_Number(open(file.c_str(), flags | O_CLOEXEC, 0666))
{}

ZarrDescriptor::~ZarrDescriptor()
{
  if (m_Number >= 0)
  {
    close(m_Number);
  }
}

bool
ZarrDescriptor::Close()
{
  return close(std::exchange(m_Number, -1)) == 0;
}

bool
ZarrDescriptor::IsRegular() const
{
  return S_ISREG(this->GetStatus().st_mode);
}

std::uint64_t
ZarrDescriptor::GetSize() const
{
  return static_cast<std::uint64_t>(this->GetStatus().st_size);
}

struct stat
ZarrDescriptor::GetStatus() const
{
  struct stat status = {};
  fstat(m_Number, &status);
  return status;
}

void
FailWithErrno(const char * action, const std::filesystem::path & file)
{
  Fail(ExitStatus::Failure, "cannot ", action, " ", file.string(), ": ", std::strerror(errno));
}

std::unique_ptr<ZarrDescriptor>
OpenZarrChunks(const std::filesystem::path & chunkFile)
{
  // A pipe would be waited for.
  auto file = std::make_unique<ZarrDescriptor>(chunkFile, O_RDONLY | O_NONBLOCK);
  if (file->Get() < 0 && errno != ENOENT)
  {
    FailWithErrno("read", chunkFile);
  }
  if (file->Get() >= 0 && !file->IsRegular())
  {
    Fail(ExitStatus::Failure, "cannot read ", chunkFile.string(), ": it is not a regular file");
  }
  return file->Get() < 0 ? nullptr : std::move(file);
}

} // end namespace medialvoxel
