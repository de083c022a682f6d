// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VoxelSource.h"

#include "VolumeFormat.h"
#include "VoxelStream.h"

#include <cassert>

namespace medialvoxel
{
namespace
{

class StreamedSource : public VoxelSource
{
public:
  explicit StreamedSource(const VolumeHeader & header)
    : m_Stream(header.format->input.openCompressed(header))
    , m_NumberOfBytes(header.GetDataSize())
    , m_ValueSize(header.bigEndian == itk::MachineIsBigEndian() ? 1 : GetTraits(header.pixelType).bytes)
  {}

  void
  Read([[maybe_unused]] std::uint64_t offset, void * destination, std::uint64_t numberOfBytes) override
  {
    assert(offset == m_Position);
    m_Stream->Read(destination, numberOfBytes);
    itk::SwapComponentBytes(destination, numberOfBytes, m_ValueSize);
    m_Position += numberOfBytes;
    if (m_Position == m_NumberOfBytes)
    {
      m_Stream->CheckEnd();
    }
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Stream->GetNumberOfBytesRead();
  }

private:
  std::unique_ptr<VoxelStream> m_Stream;
  std::uint64_t                m_NumberOfBytes;
  unsigned int                 m_ValueSize; ///< 1: they stay as they are
  std::uint64_t                m_Position{ 0 };
};

} // namespace

std::shared_ptr<VoxelSource>
OpenVoxelSource(const VolumeHeader & header)
{
  return std::make_shared<StreamedSource>(header);
}

} // end namespace medialvoxel
