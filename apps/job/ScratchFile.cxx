// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ScratchFile.h"

#include "Errors.h"
#include "Text.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

/** A new file that no folder lists. */
int
OpenNamelessFile(const std::filesystem::path & folder)
{
#ifdef O_TMPFILE
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR))
  {
    return descriptor;
  }
#endif
  std::string name = (folder / "medialvoxel-XXXXXX").string();
  const int   named = mkstemp(name.data());
  if (named >= 0)
  {
    unlink(name.c_str());
  }
  return named;
}

/** Repeats a call of the system until all bytes are through. */
template <typename TByte, typename TCall>
void
Transfer(TByte *                       data,
         std::uint64_t                 numberOfBytes,
         std::uint64_t                 offset,
         const char *                  action,
         const std::filesystem::path & folder,
         TCall                         call)
{
  for (std::uint64_t done = 0; done < numberOfBytes;)
  {
    const ssize_t count = call(data + done, numberOfBytes - done, static_cast<off_t>(offset + done));
    if (count > 0)
    {
      done += static_cast<std::uint64_t>(count);
    }
    else if (count == 0 || errno != EINTR)
    {
      Fail(ExitStatus::Failure,
           "cannot ",
           action,
           " the scratch file in ",
           folder.string(),
           ": ",
           count == 0 ? "it ends early" : std::strerror(errno));
    }
  }
}

} // namespace

ScratchFile::ScratchFile(const std::filesystem::path & folder)
  : m_Folder(folder)
  , m_Descriptor(OpenNamelessFile(folder))
{
  if (m_Descriptor < 0)
  {
    Fail(ExitStatus::Refused, "cannot create a scratch file in ", folder.string(), ": ", std::strerror(errno));
  }
}

ScratchFile::~ScratchFile()
{
  close(m_Descriptor);
}

void
ScratchFile::Reserve(std::uint64_t numberOfBytes)
{
  const int error = posix_fallocate(m_Descriptor, 0, static_cast<off_t>(numberOfBytes));
  // A file system that cannot reserve is asked again with every write.
  if (error != 0 && error != EOPNOTSUPP && error != EINVAL)
  {
    Fail(ExitStatus::Refused,
         "cannot reserve ",
         FormatBytes(numberOfBytes),
         " for the scratch file in ",
         m_Folder.string(),
         ": ",
         std::strerror(error));
  }
}

void
ScratchFile::WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes)
{
  Transfer(static_cast<const char *>(data), numberOfBytes, offset, "write", m_Folder, [this](auto... arguments) {
    return pwrite(m_Descriptor, arguments...);
  });
}

void
ScratchFile::ReadAt(std::uint64_t offset, void * data, std::uint64_t numberOfBytes) const
{
  Transfer(static_cast<char *>(data), numberOfBytes, offset, "read", m_Folder, [this](auto... arguments) {
    return pread(m_Descriptor, arguments...);
  });
}

} // end namespace medialvoxel
