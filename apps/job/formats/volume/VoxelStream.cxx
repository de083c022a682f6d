// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VoxelStream.h"

#include "InflateReader.h"

namespace medialvoxel
{
namespace
{

class InflatedStream : public VoxelStream
{
public:
  explicit InflatedStream(const VolumeHeader & header)
    : m_Reader(header.dataFile, header.dataOffset)
  {
    m_Reader.Skip(header.skipAfterInflation);
  }

  void
  Read(void * destination, std::uint64_t numberOfBytes) override
  {
    m_Reader.Read(destination, numberOfBytes);
  }

  void
  CheckEnd() override
  {
    m_Reader.CheckEnd();
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Reader.GetNumberOfBytesRead();
  }

private:
  InflateReader m_Reader;
};

} // namespace

std::unique_ptr<VoxelStream>
OpenInflatedStream(const VolumeHeader & header)
{
  return std::make_unique<InflatedStream>(header);
}

} // end namespace medialvoxel
