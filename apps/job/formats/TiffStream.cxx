// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffStream.h"

#include "HeaderParsing.h"
#include "PartStream.h"
#include "TiffFile.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class TiffStream
 * \brief Unpacks one strip after the other. */
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
    voxels.resize(bytes);
    m_File.ReadStrip(m_NextStrip++, voxels.data(), bytes);
    return packedBytes;
  }
  catch (const HeaderError & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
  }

  TiffFile      m_File;
  std::uint64_t m_MaximumBytes;
  std::uint64_t m_RowBytes;
  std::uint32_t m_NextStrip{ 0 };
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
