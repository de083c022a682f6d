// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSpaceReserve_h
#define medialvoxelSpaceReserve_h

#include "SystemFile.h"

#include <cstdint>
#include <filesystem>

namespace medialvoxel
{

/** \class SpaceReserve
 * \brief A file that keeps space on the disk for others, and gives it back as they are written. */
class SpaceReserve
{
public:
  /** \throw JobError Refused when the disk has no space. */
  SpaceReserve(const std::filesystem::path & fileName, std::uint64_t numberOfBytes);

  /** Removes the file. */
  ~SpaceReserve();

  SpaceReserve(const SpaceReserve &) = delete;
  SpaceReserve &
  operator=(const SpaceReserve &) = delete;

  void
  GiveBack(std::uint64_t numberOfBytes);

private:
  std::filesystem::path m_FileName;
  std::uint64_t         m_NumberOfBytes;
  SystemFile            m_File;
};

} // end namespace medialvoxel

#endif
