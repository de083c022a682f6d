// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelScratchFile_h
#define medialvoxelScratchFile_h

#include "SystemFile.h"

#include <cstdint>
#include <filesystem>

namespace medialvoxel
{

/** \class ScratchFile
 * \brief A file without a name, which vanishes with the process however it ends. */
class ScratchFile
{
public:
  /** \throw JobError Refused when the folder is missing or cannot be written. */
  explicit ScratchFile(const std::filesystem::path & folder);

  /** Makes it a hole of so many bytes, which reads as zeros. \throw JobError Failure. */
  void
  SetSize(std::uint64_t numberOfBytes);

  /** \throw JobError Failure. */
  void
  WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes);

  /** Reads bytes that were written. \throw JobError Failure. */
  void
  ReadAt(std::uint64_t offset, void * data, std::uint64_t numberOfBytes) const;

private:
  std::filesystem::path m_Folder;
  SystemFile            m_File;
};

} // end namespace medialvoxel

#endif
