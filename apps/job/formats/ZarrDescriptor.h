// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrDescriptor_h
#define medialvoxelZarrDescriptor_h

#include <cstdint>
#include <filesystem>
#include <memory>
#include <sys/stat.h>

namespace medialvoxel
{

/** \class ZarrDescriptor
 * \brief An open file of a Zarr folder. */
class ZarrDescriptor
{
public:
  /** \param flags of open() */
  ZarrDescriptor(const std::filesystem::path & file, int flags);
  ~ZarrDescriptor();

  ZarrDescriptor(const ZarrDescriptor &) = delete;
  ZarrDescriptor &
  operator=(const ZarrDescriptor &) = delete;

  /** Negative when the file could not be opened, with errno. */
  int
  Get() const
  {
    return m_Number;
  }

  /** False when bytes were lost that seemed to be written, with errno: file systems of a network may tell only now. */
  bool
  Close();

  bool
  IsRegular() const;

  std::uint64_t
  GetSize() const;

private:
  /** Zeros when the system does not tell. */
  struct stat
  GetStatus() const;

  int m_Number;
};

/** \throw JobError Failure, with the error of the system. */
[[noreturn]] void
FailWithErrno(const char * action, const std::filesystem::path & file);

/** Opens a file of chunks to be read; null when there is none.
 * \throw JobError Failure, also for what is not a regular file */
std::unique_ptr<ZarrDescriptor>
OpenZarrChunks(const std::filesystem::path & chunkFile);

} // end namespace medialvoxel

#endif
