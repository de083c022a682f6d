// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelReaderPool_h
#define medialvoxelReaderPool_h

#include "ValueReader.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace medialvoxel
{

/** \class ReaderPool
 * \brief Readers of a volume, one for each thread that reads. */
class ReaderPool
{
public:
  /** Arguments as of MakeValueReader(). */
  ReaderPool(const VolumeHeader & header, Interpolation interpolation, std::uint64_t bytesToKeep);

  /** Calls function(reader) with one that no other thread has meanwhile. */
  template <typename TFunction>
  void
  With(TFunction && function)
  {
    ValueReader * const reader = this->Take();
    function(*reader);
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_FreeReaders.push_back(reader);
  }

  std::int64_t
  GetRowsReadTogether() const
  {
    return m_Readers.front()->GetRowsReadTogether();
  }

  std::uint64_t
  GetNumberOfBytesRead() const;

private:
  /** The one that was used last goes on, so that one thread reads ahead in the file. */
  ValueReader *
  Take();

  std::shared_ptr<VoxelSource>              m_Unpacked; ///< all readers share what is unpacked, and its bytes
  std::mutex                                m_Mutex;    // of what follows
  std::vector<std::unique_ptr<ValueReader>> m_Readers;
  std::vector<ValueReader *>                m_FreeReaders;
};

} // end namespace medialvoxel

#endif
