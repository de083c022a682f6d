// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffStream.h"

#include "HeaderParsing.h"
#include "TiffFile.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class TiffStream
 * \brief Unpacks one strip after the other. */
class TiffStream : public VoxelStream
{
public:
  explicit TiffStream(const VolumeHeader & header)
    : m_File(header.fileName, std::max(TiffFile::MaximumBytesOfTable, header.unpackBytes))
    , m_MaximumBytes(header.unpackBytes)
    , m_RowBytes(header.geometry.size.front() * GetTraits(header.pixelType).bytes)
  {}

  void
  Read(void * destination, std::uint64_t numberOfBytes) override
  try
  {
    auto * position = static_cast<unsigned char *>(destination);
    while (numberOfBytes > 0)
    {
      if (m_Done == m_Voxels.size())
      {
        this->NextStrip();
      }
      const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, m_Voxels.size() - m_Done);
      position = std::copy_n(m_Voxels.data() + m_Done, count, position);
      m_Done += count;
      numberOfBytes -= count;
    }
  }
  catch (const HeaderError & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
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
  void
  NextStrip()
  {
    if (m_NextStrip == TIFFNumberOfStrips(m_File.GetHandle()))
    {
      m_NextStrip = 0;
      if (!m_File.NextDirectory())
      {
        m_File.Refuse("its slices became less while it was read");
      }
    }
    const std::uint64_t packedBytes = TIFFGetStrileByteCount(m_File.GetHandle(), m_NextStrip);
    const std::uint64_t bytes = m_File.GetRows().Of(m_NextStrip) * m_RowBytes;
    if (bytes + packedBytes > m_MaximumBytes)
    {
      m_File.Refuse("its strips became larger while it was read");
    }
    m_Voxels.resize(bytes);
    m_File.ReadStrip(m_NextStrip, m_Voxels.data(), bytes);
    m_Done = 0;
    m_BytesRead += packedBytes;
    ++m_NextStrip;
  }

  TiffFile                   m_File;
  std::uint64_t              m_MaximumBytes;
  std::uint64_t              m_RowBytes;
  std::uint32_t              m_NextStrip{ 0 };
  std::vector<unsigned char> m_Voxels; ///< of one strip
  std::uint64_t              m_Done{ 0 };
  std::uint64_t              m_BytesRead{ 0 };
};

} // namespace

std::unique_ptr<VoxelStream>
OpenTiffStream(const VolumeHeader & header)
try
{
  return std::make_unique<TiffStream>(header);
}
catch (const HeaderError & error)
{
  Fail(ExitStatus::CorruptInput, error.what());
}

} // end namespace medialvoxel
