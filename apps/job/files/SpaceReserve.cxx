// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SpaceReserve.h"

#include "Errors.h"
#include "FileTransfer.h"
#include "Text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace medialvoxel
{

SpaceReserve::SpaceReserve(const std::filesystem::path & fileName, std::uint64_t numberOfBytes)
  : m_FileName(fileName)
  , m_NumberOfBytes(numberOfBytes)
  , m_Descriptor(open(fileName.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
{
  if (m_Descriptor < 0 || !ReserveSpace(m_Descriptor, numberOfBytes))
  {
    const int error = errno;
    close(m_Descriptor);
    Fail(ExitStatus::Refused,
         "cannot reserve ",
         numberOfBytes,
         " bytes (",
         FormatBytes(numberOfBytes),
         ") in ",
         fileName.parent_path().string(),
         ": ",
         std::strerror(error));
  }
}

SpaceReserve::~SpaceReserve()
{
  close(m_Descriptor);
  std::error_code error;
  std::filesystem::remove(m_FileName, error);
}

void
SpaceReserve::GiveBack(std::uint64_t numberOfBytes)
{
  m_NumberOfBytes -= std::min(m_NumberOfBytes, numberOfBytes);
  if (ftruncate(m_Descriptor, static_cast<off_t>(m_NumberOfBytes)) != 0)
  {
    Fail(ExitStatus::Failure, "cannot set the size of ", m_FileName.string(), ": ", std::strerror(errno));
  }
}

} // end namespace medialvoxel
