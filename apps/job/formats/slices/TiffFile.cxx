// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffFile.h"

#include "HeaderParsing.h"

#include "itkMedialVoxelProgress.h"

#include <array>
#include <cstdio>

namespace medialvoxel
{

TiffFile::TiffFile(const std::filesystem::path & fileName, std::uint64_t maximumSize)
  : m_FileName(fileName)
  , m_File(OpenRegularFile(fileName))
  , m_Size(GetDataFileSize(fileName, fileName))
{
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(maximumSize));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), KeepComplaint, this);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), DropWarning, nullptr);
  const auto write = [](thandle_t, void *, tmsize_t) -> tmsize_t { return -1; };
  const auto close = [](thandle_t) { return 0; };
  m_Handle.reset(TIFFClientOpenExt(
    fileName.string().c_str(), "rm", this, Read, write, Seek, close, GetSize, nullptr, nullptr, options.get()));
  this->CheckDirectory(m_Handle != nullptr, "it is no TIFF file, or its first directory is damaged");
}

void
TiffFile::Refuse(const std::string & what) const
{
  RefuseHeader(m_FileName, what + (m_Complaint.empty() ? "" : " (libtiff: " + m_Complaint + ")"));
}

bool
TiffFile::NextDirectory()
{
  if (TIFFLastDirectory(m_Handle.get()) != 0)
  {
    return false;
  }
  const bool isRead = TIFFReadDirectory(m_Handle.get()) == 1;
  this->CheckDirectory(isRead, "its directories are damaged, or form a circle");
  return true;
}

std::uint64_t
TiffFile::GetDirectoryOffset() const
{
  return TIFFCurrentDirOffset(m_Handle.get());
}

void
TiffFile::SetDirectory(std::uint64_t offset)
{
  const bool isRead = TIFFSetSubDirectory(m_Handle.get(), offset) == 1;
  this->CheckDirectory(isRead, "its directories are damaged");
}

TiffBands
TiffFile::GetBands() const
{
  const auto width = this->Get<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
  const auto height = this->Get<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
  if (TIFFIsTiled(m_Handle.get()) != 0)
  {
    return {
      width, height, this->Get<std::uint32_t>(TIFFTAG_TILELENGTH, 0), this->Get<std::uint32_t>(TIFFTAG_TILEWIDTH, 0)
    };
  }
  return { width, height, std::min(height, this->Get<std::uint32_t>(TIFFTAG_ROWSPERSTRIP, height)), 0 };
}

std::uint64_t
TiffFile::GetBytesPerVoxel() const
{
  return this->HasBits() ? 1 : this->Get<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1) / 8u;
}

bool
TiffFile::HasBits() const
{
  return this->Get<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1) == 1;
}

std::uint64_t
TiffFile::GetBandMemory(std::uint64_t band) const
{
  const TiffBands     bands = this->GetBands();
  const std::uint64_t striles = bands.GetStriles();
  std::uint64_t       largest = 0;
  for (std::uint64_t strile = band * striles; strile < (band + 1) * striles; ++strile)
  {
    largest = std::max(largest, TIFFGetStrileByteCount(m_Handle.get(), static_cast<std::uint32_t>(strile)));
  }
  const std::uint64_t tile = bands.rows * bands.tileWidth;
  const std::uint64_t bits = this->HasBits() ? bands.rows * (std::max(bands.width, bands.tileWidth) / 8 + 1) : 0;
  return largest + this->GetBytesPerVoxel() * (bands.GetRows(band) * bands.width + tile) + bits;
}

std::uint64_t
TiffFile::ReadBand(std::uint64_t band, char * voxels, std::uint64_t numberOfBytes)
{
  const TiffBands bands = this->GetBands();
  if (bands.GetRows(band) * bands.width * this->GetBytesPerVoxel() != numberOfBytes)
  {
    this->Refuse("its slices changed while it was read");
  }
  const std::uint64_t striles = bands.GetStriles();
  std::uint64_t       packedSize = 0;
  for (std::uint64_t strile = band * striles; strile < (band + 1) * striles; ++strile)
  {
    packedSize += TIFFGetStrileByteCount(m_Handle.get(), static_cast<std::uint32_t>(strile));
  }
  if (bands.tileWidth > 0)
  {
    this->ReadTiles(bands, band, voxels);
    return packedSize;
  }
  this->ReadStrile(band, bands.width, bands.GetRows(band), voxels);
  return packedSize;
}

void
TiffFile::ReadStrile(std::uint64_t strile, std::uint64_t width, std::uint64_t rows, char * voxels)
{
  const bool          isTile = TIFFIsTiled(m_Handle.get()) != 0;
  const bool          hasBits = this->HasBits();
  const std::uint64_t rowSize = hasBits ? (width + 7) / 8 : width * this->GetBytesPerVoxel();
  m_Bits.resize(hasBits ? rows * rowSize : 0);
  void * const target = hasBits ? static_cast<void *>(m_Bits.data()) : voxels;
  const auto   size = static_cast<tmsize_t>(rows * rowSize);
  const auto   number = static_cast<std::uint32_t>(strile);
  const auto   read = isTile ? TIFFReadEncodedTile(m_Handle.get(), number, target, size)
                             : TIFFReadEncodedStrip(m_Handle.get(), number, target, size);
  if (read != size)
  {
    this->Refuse(isTile ? "its tiles are damaged or end early" : "its compressed voxels are damaged or end early");
  }
  for (std::uint64_t row = 0; hasBits && row < rows; ++row)
  {
    for (std::uint64_t x = 0; x < width; ++x)
    {
      voxels[row * width + x] = static_cast<char>(m_Bits[row * rowSize + x / 8] >> (7 - x % 8) & 1);
    }
  }
}

void
TiffFile::ReadTiles(const TiffBands & bands, std::uint64_t band, char * voxels)
{
  const std::uint64_t bytesPerVoxel = this->GetBytesPerVoxel();
  const std::uint64_t bytesPerTileRow = bands.tileWidth * bytesPerVoxel;
  m_Tile.resize(bands.rows * bytesPerTileRow);
  for (std::uint64_t column = 0; column < bands.GetStriles(); ++column)
  {
    itk::MedialVoxelCheckAbort();
    this->ReadStrile(band * bands.GetStriles() + column, bands.tileWidth, bands.rows, m_Tile.data());
    const std::uint64_t first = column * bands.tileWidth;
    const std::uint64_t bytes = std::min(bands.tileWidth, bands.width - first) * bytesPerVoxel;
    for (std::uint64_t row = 0; row < bands.GetRows(band); ++row)
    {
      std::copy_n(m_Tile.data() + row * bytesPerTileRow, bytes, voxels + (row * bands.width + first) * bytesPerVoxel);
    }
  }
}

void
TiffFile::CheckDirectory(bool isRead, const char * what) const
{
  if (m_EndsEarly)
  {
    this->Refuse("it has " + std::to_string(m_Size) + " bytes and refers to what would lie behind them");
  }
  if (!isRead)
  {
    this->Refuse(what);
  }
}

tmsize_t
TiffFile::Read(thandle_t file, void * bytes, tmsize_t numberOfBytes)
{
  auto & self = *static_cast<TiffFile *>(file);
  self.m_File.read(static_cast<char *>(bytes), numberOfBytes);
  self.m_EndsEarly = self.m_EndsEarly || !self.m_File.good();
  self.m_File.clear();
  return self.m_File.gcount();
}

toff_t
TiffFile::Seek(thandle_t file, toff_t offset, int from)
{
  auto & self = *static_cast<TiffFile *>(file);
  self.m_File.seekg(static_cast<std::streamoff>(offset),
                    from == SEEK_SET   ? std::ios::beg
                    : from == SEEK_CUR ? std::ios::cur
                                       : std::ios::end);
  self.m_File.clear();
  return static_cast<toff_t>(self.m_File.tellg());
}

toff_t
TiffFile::GetSize(thandle_t file)
{
  return static_cast<TiffFile *>(file)->m_Size;
}

int
TiffFile::KeepComplaint(TIFF *, void * file, const char *, const char * format, va_list values)
{
  std::string & complaint = static_cast<TiffFile *>(file)->m_Complaint;
  if (complaint.empty())
  {
    std::array<char, 512> text{};
    std::vsnprintf(text.data(), text.size(), format, values);
    complaint = text.data();
  }
  return 1;
}

int
TiffFile::DropWarning(TIFF *, void *, const char *, const char *, va_list)
{
  return 1;
}

} // end namespace medialvoxel
