// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "RawImageIO.h"
#include "TiffFile.h"
#include "TiffReaders.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

/** \class TiledTiffImageIO
 * \brief Keeps the row of tiles that was read last, of which the next part may want further rows. */
class TiledTiffImageIO : public itk::StreamingRawImageIO
{
public:
  using Self = TiledTiffImageIO;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  void
  Open(const VolumeHeader & header)
  {
    m_Size = header.geometry.size;
    m_BytesPerVoxel = GetTraits(header.pixelType).bytes;
    m_MaximumBytes = header.unpackBytes;
    m_File = std::make_unique<TiffFile>(header.fileName, std::max(TiffFile::MaximumBytesOfTable, m_MaximumBytes));
    do
    {
      itk::MedialVoxelPoll();
      m_Directories.push_back(m_File->GetDirectoryOffset());
    } while (m_File->NextDirectory());
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

  /** Tiles are checked when they are read. */
  void
  ReadImageInformation() override
  {}

  void
  Read(void * buffer) override
  try
  {
    const itk::ImageIORegion & region = this->GetIORegion();
    const auto                 firstSlice = static_cast<std::uint64_t>(m_Size.size() > 2 ? region.GetIndex(2) : 0);
    const std::uint64_t        slices = m_Size.size() > 2 ? region.GetSize(2) : 1;
    auto *                     position = static_cast<char *>(buffer);
    for (std::uint64_t slice = firstSlice; slice < firstSlice + slices; ++slice)
    {
      itk::MedialVoxelPoll();
      position = this->ReadRows(slice, position);
    }
  }
  catch (const HeaderError & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
  }

private:
  /** Copies the rows of the region in a slice; returns the end of them. */
  char *
  ReadRows(std::uint64_t slice, char * position)
  {
    const itk::ImageIORegion & region = this->GetIORegion();
    const std::uint64_t        skipped = static_cast<std::uint64_t>(region.GetIndex(0)) * m_BytesPerVoxel;
    const auto                 firstRow = static_cast<std::uint64_t>(region.GetIndex(1));
    for (std::uint64_t row = firstRow; row < firstRow + region.GetSize(1); ++row)
    {
      if (slice != m_Slice || row < m_FirstRow || row >= m_FirstRow + m_Rows)
      {
        this->ReadBandOf(slice, row);
      }
      const char * const source = m_Voxels.data() + (row - m_FirstRow) * m_Size[0] * m_BytesPerVoxel + skipped;
      position = std::copy_n(source, region.GetSize(0) * m_BytesPerVoxel, position);
    }
    return position;
  }

  void
  ReadBandOf(std::uint64_t slice, std::uint64_t row)
  {
    m_Rows = 0; // there is none should this fail
    if (slice >= m_Directories.size())
    {
      m_File->Refuse("its slices became less while it was read");
    }
    if (slice != m_Slice)
    {
      m_File->SetDirectory(m_Directories[slice]);
      m_Slice = slice;
    }
    const TiffBands bands = m_File->GetBands();
    if (bands.width != m_Size[0] || bands.height != m_Size[1] || bands.rows == 0 ||
        m_File->GetBytesToRead(row / bands.rows) > m_MaximumBytes)
    {
      m_File->Refuse("its slices changed while it was read");
    }
    const std::uint64_t band = row / bands.rows;
    m_Voxels.resize(bands.GetRows(band) * m_Size[0] * m_BytesPerVoxel);
    m_BytesRead += m_File->ReadBand(band, m_Voxels.data(), m_Voxels.size());
    m_FirstRow = band * bands.rows;
    m_Rows = bands.GetRows(band);
  }

  std::vector<std::uint64_t> m_Size;
  std::uint64_t              m_BytesPerVoxel{ 0 };
  std::uint64_t              m_MaximumBytes{ 0 };
  std::unique_ptr<TiffFile>  m_File;
  std::vector<std::uint64_t> m_Directories; ///< where that of each slice lies
  std::vector<char>          m_Voxels;      ///< of a row of tiles: m_Rows from m_FirstRow on in m_Slice
  std::uint64_t              m_Slice{ ~std::uint64_t{ 0 } };
  std::uint64_t              m_FirstRow{ 0 };
  std::uint64_t              m_Rows{ 0 };
  std::uint64_t              m_BytesRead{ 0 };
};

} // namespace

itk::StreamingRawImageIO::Pointer
MakeTiffImageIO(const VolumeHeader & header)
try
{
  if (header.liesInRows)
  {
    return MakeRawImageIO(header);
  }
  const auto imageIO = TiledTiffImageIO::New();
  imageIO->Open(header);
  return imageIO.GetPointer();
}
catch (const HeaderError & error)
{
  Fail(ExitStatus::CorruptInput, error.what());
}

} // end namespace medialvoxel
