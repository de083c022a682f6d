// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffReaders.h"

#include "Errors.h"
#include "HeaderParsing.h"
#include "RawImageIO.h"
#include "TiffFile.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <vector>

namespace medialvoxel
{
namespace
{

/** \class TiffRows
 * \brief Rows of a stack, which libtiff reads in bands. The last band is kept, as its next row may be wanted. */
class TiffRows
{
public:
  /** \throw JobError CorruptInput, as the other functions */
  explicit TiffRows(const VolumeHeader & header)
  try
    : m_Size(header.geometry.size)
    , m_RowSize(m_Size[0] * GetTraits(header.pixelType).bytes)
    , m_MaximumMemory(header.decoderMemory)
    , m_File(header.fileName, std::max(TiffFile::MaximumTableSize, header.decoderMemory))
  {
    do
    {
      itk::MedialVoxelCheckAbort();
      m_Directories.push_back(m_File.GetDirectoryOffset());
    } while (m_File.NextDirectory());
  }
  catch (const HeaderError & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
  }

  /** It stays until the next one is asked for. */
  const char *
  Get(std::uint64_t slice, std::uint64_t row)
  {
    if (slice != m_Slice || row < m_FirstRow || row >= m_FirstRow + m_Rows)
    {
      this->ReadBandOf(slice, row);
    }
    return m_Voxels.data() + (row - m_FirstRow) * m_RowSize;
  }

  /** The same, of all slices. */
  const char *
  Get(std::uint64_t row)
  {
    return this->Get(row / m_Size[1], row % m_Size[1]);
  }

  std::uint64_t
  GetRowSize() const
  {
    return m_RowSize;
  }

  std::uint64_t
  GetNumberOfBytesRead() const
  {
    return m_NumberOfBytesRead;
  }

private:
  void
  ReadBandOf(std::uint64_t slice, std::uint64_t row)
  try
  {
    itk::MedialVoxelCheckAbort();
    m_Rows = 0; // there is none should this fail
    if (slice >= m_Directories.size())
    {
      m_File.Refuse("its slices became less while it was read");
    }
    if (slice != m_Slice)
    {
      m_File.SetDirectory(m_Directories[slice]);
      m_Slice = slice;
    }
    const TiffBands bands = m_File.GetBands();
    if (bands.width != m_Size[0] || bands.height != m_Size[1] || bands.rows == 0 ||
        m_File.GetBandMemory(row / bands.rows) > m_MaximumMemory)
    {
      m_File.Refuse("its slices changed while it was read");
    }
    const std::uint64_t band = row / bands.rows;
    m_Voxels.resize(bands.GetRows(band) * m_RowSize);
    m_NumberOfBytesRead += m_File.ReadBand(band, m_Voxels.data(), m_Voxels.size());
    m_FirstRow = band * bands.rows;
    m_Rows = bands.GetRows(band);
  }
  catch (const HeaderError & error)
  {
    Fail(ExitStatus::CorruptInput, error.what());
  }

  std::vector<std::uint64_t> m_Size;
  std::uint64_t              m_RowSize;
  std::uint64_t              m_MaximumMemory;
  TiffFile                   m_File;
  std::vector<std::uint64_t> m_Directories; ///< where that of each slice lies
  std::vector<char>          m_Voxels;      ///< of a band: m_Rows from m_FirstRow on in m_Slice
  std::uint64_t              m_Slice{ ~std::uint64_t{ 0 } };
  std::uint64_t              m_FirstRow{ 0 };
  std::uint64_t              m_Rows{ 0 };
  std::uint64_t              m_NumberOfBytesRead{ 0 };
};

/** \class TiffStream
 * \brief All rows one after the other; each band has a check of its own. */
class TiffStream : public VoxelStream
{
public:
  explicit TiffStream(const VolumeHeader & header)
    : m_Rows(header)
  {}

  void
  Read(void * destination, std::uint64_t numberOfBytes) override
  {
    const std::uint64_t rowSize = m_Rows.GetRowSize();
    auto *              position = static_cast<char *>(destination);
    for (const std::uint64_t end = m_Done + numberOfBytes; m_Done < end;)
    {
      const std::uint64_t inRow = m_Done % rowSize;
      const std::uint64_t count = std::min(end - m_Done, rowSize - inRow);
      position = std::copy_n(m_Rows.Get(m_Done / rowSize) + inRow, count, position);
      m_Done += count;
    }
  }

  void
  CheckEnd() override
  {}

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Rows.GetNumberOfBytesRead();
  }

private:
  TiffRows      m_Rows;
  std::uint64_t m_Done{ 0 };
};

/** \class TiledTiffImageIO
 * \brief The reader of MakeTiffImageIO() for tiles, which are checked when they are read. */
class TiledTiffImageIO : public itk::StreamingRawImageIO
{
public:
  using Self = TiledTiffImageIO;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  void
  Open(const VolumeHeader & header)
  {
    m_Rows = std::make_unique<TiffRows>(header);
    m_ValueSize = GetTraits(header.pixelType).bytes;
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Rows->GetNumberOfBytesRead();
  }

  void
  ReadImageInformation() override
  {}

  void
  Read(void * buffer) override
  {
    const itk::ImageIORegion & region = this->GetIORegion();
    const bool                 isVolume = region.GetImageDimension() > 2;
    const auto          first = [&](unsigned int axis) { return static_cast<std::uint64_t>(region.GetIndex(axis)); };
    const std::uint64_t firstSlice = isVolume ? first(2) : 0;
    auto *              position = static_cast<char *>(buffer);
    for (std::uint64_t slice = firstSlice; slice < firstSlice + (isVolume ? region.GetSize(2) : 1); ++slice)
    {
      for (std::uint64_t row = first(1); row < first(1) + region.GetSize(1); ++row)
      {
        const char * const source = m_Rows->Get(slice, row) + first(0) * m_ValueSize;
        position = std::copy_n(source, region.GetSize(0) * m_ValueSize, position);
      }
    }
  }

private:
  std::unique_ptr<TiffRows> m_Rows;
  std::uint64_t             m_ValueSize{ 0 };
};

} // namespace

std::unique_ptr<VoxelStream>
OpenTiffStream(const VolumeHeader & header)
{
  return std::make_unique<TiffStream>(header);
}

itk::StreamingRawImageIO::Pointer
MakeTiffImageIO(const VolumeHeader & header)
{
  if (header.liesInRows)
  {
    return MakeRawImageIO(header);
  }
  const auto imageIO = TiledTiffImageIO::New();
  imageIO->Open(header);
  return imageIO.GetPointer();
}

} // end namespace medialvoxel
