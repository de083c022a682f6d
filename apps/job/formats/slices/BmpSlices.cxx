// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// BMP of 8 bits without packing: rows behind a header. ITK's reader trusts the header, and misses the end of cut files.

#include "BinaryHeader.h"
#include "HeaderParsing.h"
#include "SliceFormats.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace medialvoxel
{
namespace
{

constexpr std::size_t   HeaderSize = 54;
constexpr std::uint32_t InformationSize = 40;
constexpr std::uint32_t MostColors = 256;
constexpr std::int64_t  LargestSize = 1 << 20;

/** Offsets of the fields that are used. */
enum Field : std::size_t
{
  FirstVoxel = 10,
  SizeOfInformation = 14,
  Columns = 18,
  Rows = 22,
  Bits = 28,
  Compression = 30,
  Colors = 46
};

/** \class BmpFile
 * \brief An opened file whose header was read. */
class BmpFile
{
public:
  explicit BmpFile(const std::filesystem::path & fileName)
    : m_FileName(fileName)
    , m_File(OpenRegularFile(fileName))
    , m_Header(this->ReadBytes(HeaderSize), false)
  {}

  SliceHeader
  GetHeader()
  {
    this->CheckVariant();
    const std::int64_t columns = m_Header.Get<std::int32_t>(Columns);
    const std::int64_t rows = m_Header.Get<std::int32_t>(Rows);
    if (columns < 1 || columns > LargestSize || rows == 0 || std::abs(rows) > LargestSize)
    {
      RefuseHeader(m_FileName,
                   "its size is " + std::to_string(columns) + " x " + std::to_string(rows) + "; 1 to " +
                     std::to_string(LargestSize) + " are read");
    }
    SliceHeader header;
    header.fileName = m_FileName;
    header.size = { { static_cast<std::uint64_t>(columns), static_cast<std::uint64_t>(std::abs(rows)) } };
    header.decoderMemory = std::uint64_t{ 1 } << 16;
    const std::uint64_t needed = m_Header.Get<std::uint32_t>(FirstVoxel) + GetRowSize(header) * header.size[1];
    const std::uint64_t available = GetDataFileSize(m_FileName, m_FileName);
    if (needed > available)
    {
      RefuseHeader(m_FileName,
                   "it has " + std::to_string(available) + " bytes; its size needs " + std::to_string(needed));
    }
    this->CheckPalette();
    return header;
  }

  /** The lowest row is the first one of the file, unless the number of rows is negative. */
  void
  ReadVoxels(const SliceHeader & header, void * voxels)
  {
    const bool isFromBelow = m_Header.Get<std::int32_t>(Rows) > 0;
    for (std::uint64_t row = 0; row < header.size[1]; ++row)
    {
      const std::uint64_t inFile = isFromBelow ? header.size[1] - 1 - row : row;
      m_File.seekg(static_cast<std::streamoff>(m_Header.Get<std::uint32_t>(FirstVoxel) + inFile * GetRowSize(header)));
      const std::vector<unsigned char> bytes = this->ReadBytes(header.size[0]);
      std::copy(bytes.begin(), bytes.end(), static_cast<unsigned char *>(voxels) + row * header.size[0]);
    }
  }

private:
  /** Rows begin at multiples of four bytes. */
  static std::uint64_t
  GetRowSize(const SliceHeader & header)
  {
    return (header.size[0] + 3) / 4 * 4;
  }

  std::vector<unsigned char>
  ReadBytes(std::size_t count)
  {
    std::vector<unsigned char> bytes(count);
    if (!m_File.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(count)))
    {
      RefuseHeader(m_FileName, "it is no BMP file, or it ends early");
    }
    return bytes;
  }

  void
  CheckVariant() const
  {
    if (m_Header.Get<char>(0) != 'B' || m_Header.Get<char>(1) != 'M')
    {
      RefuseHeader(m_FileName, "it does not begin as a BMP file does");
    }
    const auto information = m_Header.Get<std::uint32_t>(SizeOfInformation);
    const auto bits = m_Header.Get<std::uint16_t>(Bits);
    const auto compression = m_Header.Get<std::uint32_t>(Compression);
    if (information != InformationSize || bits != 8 || compression != 0)
    {
      RefuseHeader(m_FileName,
                   "only BMP with a header of 40 bytes, 8 bits per voxel and no compression is read; it has " +
                     std::to_string(information) + " bytes, " + std::to_string(bits) + " bits and the compression " +
                     std::to_string(compression),
                   HeaderError::Kind::Unsupported);
    }
  }

  /** Gray BMP have a palette, whose colors must be the numbers of the voxels. */
  void
  CheckPalette()
  {
    const auto                       told = m_Header.Get<std::uint32_t>(Colors);
    const std::size_t                colors = told == 0 ? MostColors : std::min(told, MostColors);
    const std::vector<unsigned char> palette = this->ReadBytes(4 * colors);
    for (std::size_t color = 0; color < colors; ++color)
    {
      const auto begin = palette.begin() + static_cast<std::ptrdiff_t>(4 * color);
      if (std::any_of(begin, begin + 3, [color](unsigned char part) { return part != color; }))
      {
        RefuseHeader(m_FileName,
                     "it is a color image: color " + std::to_string(color) + " of its palette is not the gray value " +
                       std::to_string(color),
                     HeaderError::Kind::Unsupported);
      }
    }
  }

  std::filesystem::path m_FileName;
  std::ifstream         m_File;
  BinaryHeader          m_Header;
};

} // namespace

SliceFormat
MakeBmpSliceFormat()
{
  return MakeSliceFormat<BmpFile>("BMP", { ".bmp" });
}

} // end namespace medialvoxel
