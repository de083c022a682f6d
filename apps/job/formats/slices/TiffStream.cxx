// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "PartStream.h"
#include "TiffFile.h"
#include "TiffReaders.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class TiffStream
 * \brief Unpacks one strip, or row of tiles, after the other. */
class TiffStream : public PartStream
{
public:
  explicit TiffStream(const VolumeHeader & header)
    : m_File(header.fileName, std::max(TiffFile::MaximumBytesOfTable, header.unpackBytes))
    , m_MaximumBytes(header.unpackBytes)
    , m_RowBytes(header.geometry.size.front() * GetTraits(header.pixelType).bytes)
  {}

private:
  std::uint64_t
  ReadPart(std::vector<char> & voxels) override
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
    voxels.resize(m_File.GetBands().GetRows(m_NextBand) * m_RowBytes);
    return m_File.ReadBand(m_NextBand++, voxels.data(), voxels.size());
  }
  catch (const HeaderError & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
  }

  TiffFile      m_File;
  std::uint64_t m_MaximumBytes;
  std::uint64_t m_RowBytes;
  std::uint64_t m_NextBand{ 0 };
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
