// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SpaceReserve.h"

#include "FileNames.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{

SpaceReserve::SpaceReserve(const std::filesystem::path & fileName, std::uint64_t numberOfBytes)
  : m_FileName(fileName)
  , m_NumberOfBytes(numberOfBytes)
  , m_File(fileName, FileAccess::Make)
{
  if (!m_File.IsOpen() || !m_File.Reserve(numberOfBytes))
  {
    FailWithErrno(ExitStatus::Refused,
                  "reserve " + std::to_string(numberOfBytes) + " bytes (" + FormatBytes(numberOfBytes) + ") in",
                  fileName.parent_path());
  }
}

SpaceReserve::~SpaceReserve()
{
  m_File.Close();
  RemoveName(m_FileName);
}

void
SpaceReserve::GiveBack(std::uint64_t numberOfBytes)
{
  m_NumberOfBytes -= std::min(m_NumberOfBytes, numberOfBytes);
  if (!m_File.SetSize(m_NumberOfBytes))
  {
    FailWithErrno(ExitStatus::Failure, "set the size of", m_FileName);
  }
}

} // end namespace medialvoxel
