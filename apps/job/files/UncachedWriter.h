// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelUncachedWriter_h
#define medialvoxelUncachedWriter_h

#include "SystemFile.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>

namespace medialvoxel
{

/** \class UncachedWriter
 * \brief Writes whole blocks of a file past the page cache.
 *
 * A large result then does not push data that programs still need out of memory, and costs no copy in the kernel.
 * Some file systems cannot do it. */
class UncachedWriter
{
public:
  /** Positions and lengths are multiples of it. */
  static constexpr std::uint64_t BlockSize = 4096;

  /** Opens an existing file. */
  explicit UncachedWriter(const std::filesystem::path & fileName);

  /** False where the file system cannot write past the page cache. */
  bool
  IsOpen() const
  {
    return m_Buffer && m_File.IsOpen();
  }

  /** \return false on failure, with errno; EINVAL where the file system cannot after all */
  bool
  WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes);

  /** Waits for bytes that the file system kept back nevertheless. \return false on failure, with errno */
  bool
  Sync() const
  {
    return m_File.Sync();
  }

private:
  static constexpr std::align_val_t Alignment{ BlockSize };

  struct Free
  {
    void
    operator()(void * memory) const
    {
      operator delete(memory, Alignment);
    }
  };

  SystemFile                  m_File;
  std::unique_ptr<char, Free> m_Buffer; ///< as the memory must be aligned, too
};

} // end namespace medialvoxel

#endif
