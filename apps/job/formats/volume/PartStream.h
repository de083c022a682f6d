// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPartStream_h
#define medialvoxelPartStream_h

#include "VoxelStream.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class PartStream
 * \brief A stream of a file whose parts can only be read whole, each with its own check. */
class PartStream : public VoxelStream
{
public:
  void
  Read(void * destination, std::uint64_t numberOfBytes) override
  {
    auto * position = static_cast<char *>(destination);
    while (numberOfBytes > 0)
    {
      if (m_Done == m_Voxels.size())
      {
        m_BytesRead += this->ReadPart(m_Voxels);
        m_Done = 0;
      }
      const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, m_Voxels.size() - m_Done);
      position = std::copy_n(m_Voxels.data() + m_Done, count, position);
      m_Done += count;
      numberOfBytes -= count;
    }
  }

  void
  CheckEnd() override
  {}

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

private:
  /** Replaces the voxels by those of the next part, at least one. Returns the bytes that it has in the file.
   * \throw JobError CorruptInput */
  virtual std::uint64_t
  ReadPart(std::vector<char> & voxels) = 0;

  std::vector<char> m_Voxels; ///< of one part
  std::uint64_t     m_Done{ 0 };
  std::uint64_t     m_BytesRead{ 0 };
};

} // end namespace medialvoxel

#endif
