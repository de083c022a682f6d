// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ScratchFile.h"

#include "Errors.h"
#include "FileTransfer.h"
#include "TemporaryName.h"
#include "Text.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

/** A new file that no folder lists. */
int
OpenScratchFile(const std::filesystem::path & folder)
{
  const int descriptor = OpenNamelessFile(folder, 0600);
  if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR))
  {
    return descriptor;
  }
  std::string name = (folder / "medialvoxel-XXXXXX").string();
  const int   named = mkstemp(name.data());
  if (named >= 0)
  {
    unlink(name.c_str());
  }
  return named;
}

} // namespace

ScratchFile::ScratchFile(const std::filesystem::path & folder)
  : m_Folder(folder)
  , m_Descriptor(OpenScratchFile(folder))
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
ScratchFile::SetSize(std::uint64_t numberOfBytes)
{
  if (ftruncate(m_Descriptor, static_cast<off_t>(numberOfBytes)) != 0)
  {
    Fail(ExitStatus::Failure,
         "cannot make a scratch file of ",
         FormatBytes(numberOfBytes),
         " in ",
         m_Folder.string(),
         ": ",
         std::strerror(errno));
  }
}

void
ScratchFile::WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes)
{
  if (!WriteFully(m_Descriptor, offset, static_cast<const char *>(data), numberOfBytes))
  {
    Fail(ExitStatus::Failure, "cannot write the scratch file in ", m_Folder.string(), ": ", std::strerror(errno));
  }
}

void
ScratchFile::ReadAt(std::uint64_t offset, void * data, std::uint64_t numberOfBytes) const
{
  if (!ReadFully(m_Descriptor, offset, static_cast<char *>(data), numberOfBytes))
  {
    Fail(ExitStatus::Failure, "cannot read the scratch file in ", m_Folder.string(), ": ", std::strerror(errno));
  }
}

} // end namespace medialvoxel
