// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "TiffFile.h"
#include "TiffReaders.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class TiffStream
 * \brief Unpacks one strip, or row of tiles, after the other. */
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
  {
    auto * position = static_cast<char *>(destination);
    while (numberOfBytes > 0)
    {
      if (m_Done == m_Voxels.size())
      {
        this->ReadBand();
      }
      const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, m_Voxels.size() - m_Done);
      position = std::copy_n(m_Voxels.data() + m_Done, count, position);
      m_Done += count;
      numberOfBytes -= count;
    }
  }

  /** Each band has a check of its own. */
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
  ReadBand()
  try
  {
    if (m_NextBand == m_File.GetBands().GetCount())
    {
      m_NextBand = 0;
      if (!m_File.NextDirectory())
      {
        m_File.Refuse("its slices became less while it was read");
      }
    }
    if (m_File.GetBytesToRead(m_NextBand) > m_MaximumBytes)
    {
      m_File.Refuse("its strips or tiles became larger while it was read");
    }
    m_Voxels.resize(m_File.GetBands().GetRows(m_NextBand) * m_RowBytes);
    m_BytesRead += m_File.ReadBand(m_NextBand++, m_Voxels.data(), m_Voxels.size());
    m_Done = 0;
  }
  catch (const HeaderError & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
  }

  TiffFile          m_File;
  std::uint64_t     m_MaximumBytes;
  std::uint64_t     m_RowBytes;
  std::uint64_t     m_NextBand{ 0 };
  std::vector<char> m_Voxels; ///< of a band
  std::uint64_t     m_Done{ 0 };
  std::uint64_t     m_BytesRead{ 0 };
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
