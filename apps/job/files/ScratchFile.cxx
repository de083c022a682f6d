// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ScratchFile.h"

#include "FileNames.h"
#include "Text.h"

namespace medialvoxel
{

ScratchFile::ScratchFile(const std::filesystem::path & folder)
  : m_Folder(folder)
  , m_File(SystemFile::MakeScratch(folder))
{
  if (!m_File.IsOpen())
  {
    FailWithErrno(ExitStatus::Refused, "create a scratch file in", folder);
  }
}

void
ScratchFile::SetSize(std::uint64_t numberOfBytes)
{
  if (!m_File.SetSize(numberOfBytes))
  {
    FailWithErrno(ExitStatus::Failure, "make " + FormatBytes(numberOfBytes) + " of the scratch file in", m_Folder);
  }
}

void
ScratchFile::WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes)
{
  if (!m_File.WriteAt(offset, static_cast<const char *>(data), numberOfBytes))
  {
    FailWithErrno(ExitStatus::Failure, "write the scratch file in", m_Folder);
  }
}

void
ScratchFile::ReadAt(std::uint64_t offset, void * data, std::uint64_t numberOfBytes) const
{
  if (!m_File.ReadAt(offset, static_cast<char *>(data), numberOfBytes))
  {
    FailWithErrno(ExitStatus::Failure, "read the scratch file in", m_Folder);
  }
}

} // end namespace medialvoxel
