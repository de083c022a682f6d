// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VoxelStream.h"

#include "Errors.h"
#include "InflateReader.h"
#include "VolumeFormats.h"

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

class PlainStream : public VoxelStream
{
public:
  explicit PlainStream(const VolumeHeader & header)
    : m_Segment{ header.dataFile, header.dataOffset, header.GetVoxelBytes() }
  {}

  void
  Read(void * destination, std::uint64_t numberOfBytes) override
  try
  {
    const itk::MedialVoxelFileRegion region({ m_Segment.numberOfBytes }, { m_Position }, { numberOfBytes }, 1);
    region.Read({ m_Segment }, destination);
    m_Position += numberOfBytes;
  }
  catch (const std::runtime_error & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
  }

  void
  CheckEnd() override
  {}

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Position;
  }

private:
  itk::MedialVoxelFileSegment m_Segment;
  std::uint64_t               m_Position{ 0 };
};

} // namespace

std::unique_ptr<VoxelStream>
OpenVoxelStream(const VolumeHeader & header)
{
  return header.compressed ? header.format->input.openCompressed(header) : std::make_unique<PlainStream>(header);
}

std::unique_ptr<VoxelStream>
OpenInflatedStream(const VolumeHeader & header)
{
  return std::make_unique<InflatedStream>(header);
}

} // end namespace medialvoxel
