// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ReaderPool.h"

#include "VoxelSource.h"

namespace medialvoxel
{

ReaderPool::ReaderPool(const VolumeHeader & header, Interpolation interpolation, std::uint64_t bytesToKeep)
  : m_Unpacked(header.GetStored().unpacked)
{
  m_Readers.push_back(MakeValueReader(header, interpolation, bytesToKeep));
  m_FreeReaders.push_back(m_Readers.front().get());
}

std::uint64_t
ReaderPool::GetNumberOfBytesRead() const
{
  if (m_Unpacked)
  {
    return m_Unpacked->GetNumberOfBytesRead();
  }
  std::uint64_t bytes = 0;
  for (const auto & reader : m_Readers)
  {
    bytes += reader->GetNumberOfBytesRead();
  }
  return bytes;
}

ValueReader *
ReaderPool::Take()
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (m_FreeReaders.empty())
  {
    m_Readers.push_back(m_Readers.front()->MakeAnother());
    return m_Readers.back().get();
  }
  ValueReader * const reader = m_FreeReaders.back();
  m_FreeReaders.pop_back();
  return reader;
}

} // end namespace medialvoxel
