// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "Text.h"
#include "TiffFile.h"

#include "itkMedialVoxelFileRegion.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace medialvoxel
{
namespace
{

/** No more slices than this are believed to be in a file that lists only the first. */
constexpr std::int64_t MaximumUnlistedSlices = std::int64_t{ 1 } << 20;

/** No way of packing makes one byte out of more than this many. */
constexpr std::uint64_t MaximumRatio = 4096;

/** What all slices share. */
struct SliceFormat
{
  std::uint32_t width;
  std::uint32_t height;
  std::uint16_t bits;
  std::uint16_t sampleFormat;
  std::uint16_t compression;

  bool
  operator==(const SliceFormat & other) const
  {
    return width == other.width && height == other.height && bits == other.bits && sampleFormat == other.sampleFormat &&
           compression == other.compression;
  }
};

SliceFormat
GetFormat(const TiffFile & file)
{
  return { file.Get<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0),
           file.Get<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0),
           file.Get<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1),
           file.Get<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT),
           file.Get<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE) };
}

void
Require(const TiffFile & file, std::uint32_t tag, std::uint16_t value, const char * what)
{
  const auto found = file.Get<std::uint16_t>(tag, value);
  if (found != value)
  {
    file.Refuse(std::string(what) + " (tag " + std::to_string(tag) + " is " + std::to_string(found) + ")");
  }
}

void
CheckVariant(const TiffFile & file)
{
  Require(file, TIFFTAG_SAMPLESPERPIXEL, 1, "only one value per voxel is read");
  Require(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK, "only gray values that grow from black to white are read");
  Require(file, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT, "only rows from top to bottom, and left to right, are read");
  Require(file, TIFFTAG_FILLORDER, FILLORDER_MSB2LSB, "only bytes with the highest bit first are read");
  if (TIFFIsTiled(file.GetHandle()) != 0)
  {
    file.Refuse("its slices are stored in tiles; only strips are read");
  }
  if ((file.Get<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0) & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0)
  {
    file.Refuse("it has reduced images or masks beside its slices, which are not read");
  }
}

/** Those that unpack a strip in little more memory than the strip takes, and lose nothing. */
void
CheckCompression(const TiffFile & file, std::uint16_t compression)
{
  constexpr std::array<std::uint16_t, 5> known{
    COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE, COMPRESSION_PACKBITS
  };
  if (std::find(known.begin(), known.end(), compression) == known.end() || TIFFIsCODECConfigured(compression) == 0)
  {
    file.Refuse("its compression is number " + std::to_string(compression) +
                "; only none, LZW, Deflate and PackBits are read");
  }
}

PixelType
GetPixelType(const TiffFile & file, const SliceFormat & format)
{
  const std::array<const char *, 3> kinds{ "uint", "int", "float" };
  std::string                       name = "unknown";
  if (format.sampleFormat >= SAMPLEFORMAT_UINT && format.sampleFormat <= SAMPLEFORMAT_IEEEFP)
  {
    name = kinds[format.sampleFormat - 1u] + std::to_string(format.bits);
  }
  const std::optional<PixelType> type = PixelTypeFromName(name);
  if (!type)
  {
    file.Refuse("its voxels have " + std::to_string(format.bits) + " bits of the sample format " +
                std::to_string(format.sampleFormat) +
                "; only whole numbers of 8 to 64 bits and reals of 32 and 64 bits are read");
  }
  return *type;
}

/** Millimeters; 1 where the file has none. */
std::vector<double>
GetSpacing(const TiffFile & file)
{
  const auto   unit = file.Get<std::uint16_t>(TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
  const double x = static_cast<double>(file.Get<float>(TIFFTAG_XRESOLUTION, 1.0F));
  const double y = static_cast<double>(file.Get<float>(TIFFTAG_YRESOLUTION, 1.0F));
  if ((unit != RESUNIT_INCH && unit != RESUNIT_CENTIMETER) || !(x > 0) || !(y > 0))
  {
    return { 1.0, 1.0 };
  }
  const double millimeters = unit == RESUNIT_INCH ? 25.4 : 10.0;
  return { millimeters / x, millimeters / y };
}

/** \class StackReader
 * \brief Puts the directories of a file together. */
class StackReader
{
public:
  explicit StackReader(const std::filesystem::path & fileName)
    : m_File(fileName)
  {
    m_Header.fileName = fileName;
    m_Header.dataFile = fileName;
    m_Header.dataFileSize = GetDataFileSize(fileName, fileName);
  }

  VolumeHeader
  Read()
  {
    this->ReadFormat();
    std::uint64_t slices = 0;
    do
    {
      itk::MedialVoxelPoll();
      this->AddSlice();
      ++slices;
    } while (m_File.NextDirectory());
    this->SetGeometry(slices == 1 ? this->AddUnlistedSlices() : slices);
    return std::move(m_Header);
  }

private:
  void
  ReadFormat()
  {
    m_Format = GetFormat(m_File);
    CheckVariant(m_File);
    CheckCompression(m_File, m_Format.compression);
    if (itk::CheckedFileSize({ m_Format.width, m_Format.height, 8 }) == 0)
    {
      m_File.Refuse("a slice of " + FormatSize({ m_Format.width, m_Format.height }) + " voxels is empty or too large");
    }
    m_Header.pixelType = GetPixelType(m_File, m_Format);
    m_Header.geometry.spacing = GetSpacing(m_File);
    m_Header.compressed = m_Format.compression != COMPRESSION_NONE;
    // libtiff unpacks into the order of the machine.
    m_Header.bigEndian = m_Header.compressed ? itk::MachineIsBigEndian() : TIFFIsBigEndian(m_File.GetHandle()) != 0;
  }

  void
  AddSlice()
  {
    CheckVariant(m_File);
    if (!(GetFormat(m_File) == m_Format))
    {
      m_File.Refuse("its slices differ in size, type or compression");
    }
    TIFF * const        handle = m_File.GetHandle();
    const std::uint32_t strips = TIFFNumberOfStrips(handle);
    const TiffRows      rows = m_File.GetRows();
    if (rows.perStrip == 0 || strips != (rows.height - 1) / rows.perStrip + 1)
    {
      m_File.Refuse("a slice of " + std::to_string(rows.height) + " rows has " + std::to_string(strips) +
                    " strips of " + std::to_string(rows.perStrip) + " rows");
    }
    for (std::uint32_t strip = 0; strip < strips; ++strip)
    {
      this->AddStrip(TIFFGetStrileOffset(handle, strip),
                     TIFFGetStrileByteCount(handle, strip),
                     rows.Of(strip) * this->GetRowBytes());
    }
  }

  void
  AddStrip(std::uint64_t offset, std::uint64_t packedBytes, std::uint64_t bytes)
  {
    const std::uint64_t size = m_Header.dataFileSize;
    // libtiff puts strips that a table does not list at 0, where the file has its own header.
    if (offset == 0 || offset > size || size - offset < packedBytes)
    {
      m_File.Refuse("it has " + std::to_string(size) + " bytes; " + std::to_string(packedBytes) +
                    " bytes of voxels should lie at " + std::to_string(offset));
    }
    if (bytes / (m_Header.compressed ? MaximumRatio : 1) > packedBytes || packedBytes == 0)
    {
      m_File.Refuse("a strip of " + std::to_string(packedBytes) + " bytes cannot hold " + std::to_string(bytes) +
                    " bytes of voxels");
    }
    if (m_Header.compressed)
    {
      m_Header.unpackBytes = std::max(m_Header.unpackBytes, packedBytes + bytes);
    }
    else
    {
      this->AddSegment(offset, bytes);
    }
  }

  /** Strips that follow each other are one stretch. */
  void
  AddSegment(std::uint64_t offset, std::uint64_t bytes)
  {
    auto & segments = m_Header.segments;
    if (!segments.empty() && segments.back().offset + segments.back().numberOfBytes == offset)
    {
      segments.back().numberOfBytes += bytes;
    }
    else
    {
      segments.push_back({ m_Header.fileName, offset, bytes });
    }
  }

  /** ImageJ lists only the first slice of large stacks and tells the number of those that follow it.
   * \return number of all slices */
  std::uint64_t
  AddUnlistedSlices()
  {
    constexpr std::string_view field = "\nimages=";
    const std::string          text = m_File.Get<const char *>(TIFFTAG_IMAGEDESCRIPTION, "");
    const size_t               begin = text.find(field);
    if (text.rfind("ImageJ=", 0) != 0 || begin == std::string::npos)
    {
      return 1;
    }
    const size_t end = text.find('\n', begin + field.size());
    const auto   images = ParseInteger(text.substr(begin + field.size(), end - begin - field.size()));
    if (!images || *images < 1 || *images > MaximumUnlistedSlices)
    {
      m_File.Refuse("its description has no valid number of images");
    }
    if (*images > 1 && m_Header.segments.size() != 1)
    {
      m_File.Refuse("its description announces " + std::to_string(*images) + " images, but only one is listed");
    }
    const std::uint64_t bytes = m_Format.height * this->GetRowBytes();
    for (std::int64_t slice = 1; slice < *images; ++slice)
    {
      const itk::MedialVoxelFileSegment & known = m_Header.segments.back();
      this->AddStrip(known.offset + known.numberOfBytes, bytes, bytes);
    }
    return static_cast<std::uint64_t>(*images);
  }

  void
  SetGeometry(std::uint64_t slices)
  {
    VolumeGeometry & geometry = m_Header.geometry;
    geometry.size = { m_Format.width, m_Format.height };
    if (slices > 1)
    {
      // The format has no distance of slices.
      geometry.size.push_back(slices);
      geometry.spacing.push_back(1.0);
    }
    geometry.origin.assign(geometry.size.size(), 0.0);
    geometry.SetIdentityDirection();
  }

  std::uint64_t
  GetRowBytes() const
  {
    return std::uint64_t{ m_Format.width } * GetTraits(m_Header.pixelType).bytes;
  }

  TiffFile     m_File;
  SliceFormat  m_Format{};
  VolumeHeader m_Header;
};

} // namespace

VolumeHeader
ReadTiffHeader(const std::filesystem::path & fileName)
{
  return StackReader(fileName).Read();
}

} // end namespace medialvoxel
