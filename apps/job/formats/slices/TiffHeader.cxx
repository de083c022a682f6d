// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FormatRows.h"
#include "HeaderParsing.h"
#include "LengthUnits.h"
#include "Text.h"
#include "TiffDescription.h"
#include "TiffFile.h"
#include "TiffReaders.h"

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

/** Memory that a tile may take, however small the part of it is that a slice uses. */
constexpr std::uint64_t MaximumTileSize = std::uint64_t{ 1 } << 26;

/** A way of packing that loses nothing and unpacks a part in little more memory than the part takes. */
struct Packing
{
  std::uint16_t    number;
  std::string_view name;
  std::uint64_t    maximumRatio; ///< it makes one byte out of no more than this many
};

constexpr std::array<Packing, 6> Packings{ { { COMPRESSION_NONE, "none", 1 },
                                             { COMPRESSION_LZW, "LZW", 4096 },
                                             { COMPRESSION_ADOBE_DEFLATE, "Deflate", 4096 },
                                             { COMPRESSION_DEFLATE, "Deflate", 4096 },
                                             { COMPRESSION_PACKBITS, "PackBits", 4096 },
                                             { COMPRESSION_ZSTD, "Zstandard", 32768 } } };

/** Properties that all slices share. */
struct SliceFormat
{
  std::uint32_t width;
  std::uint32_t height;
  std::uint16_t bits;
  std::uint16_t sampleFormat;
  std::uint16_t compression;
  bool          isTiled;

  bool
  operator==(const SliceFormat & other) const
  {
    return width == other.width && height == other.height && bits == other.bits && sampleFormat == other.sampleFormat &&
           compression == other.compression && isTiled == other.isTiled;
  }
};

SliceFormat
GetFormat(const TiffFile & file)
{
  return { file.Get<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0),
           file.Get<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0),
           file.Get<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1),
           file.Get<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT),
           file.Get<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE),
           TIFFIsTiled(file.GetHandle()) != 0 };
}

template <typename TValue = std::uint16_t>
void
Require(const TiffFile & file, std::uint32_t tag, TValue value, const char * what)
{
  const auto found = file.Get<TValue>(tag, value);
  if (found != value)
  {
    file.Refuse(std::string(what) + " (tag " + std::to_string(tag) + " is " + std::to_string(found) + ")");
  }
}

void
CheckVariant(const TiffFile & file)
{
  Require<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL, 1, "only one value per voxel is read");
  // Masks of ImageJ have 0 for white, and label images a palette: their numbers are the values.
  const auto meaning = file.Get<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  if (meaning != PHOTOMETRIC_MINISWHITE && meaning != PHOTOMETRIC_PALETTE)
  {
    Require<std::uint16_t>(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK, "only gray values are read");
  }
  Require<std::uint16_t>(
    file, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT, "only rows from top to bottom, and left to right, are read");
  Require<std::uint16_t>(file, TIFFTAG_FILLORDER, FILLORDER_MSB2LSB, "only bytes with the highest bit first are read");
  Require<std::uint32_t>(file, TIFFTAG_IMAGEDEPTH, 1, "only directories of one slice are read");
  Require<std::uint32_t>(file, TIFFTAG_TILEDEPTH, 1, "only tiles of one slice are read");
  if ((file.Get<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0) & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0)
  {
    file.Refuse("it has reduced images or masks beside its slices, which are not read");
  }
}

const Packing &
FindPacking(const TiffFile & file, std::uint16_t compression)
{
  const auto found =
    std::find_if(Packings.begin(), Packings.end(), [&](const Packing & known) { return known.number == compression; });
  if (found == Packings.end() || TIFFIsCODECConfigured(compression) == 0)
  {
    file.Refuse("its compression is number " + std::to_string(compression) +
                "; only none, LZW, Deflate, PackBits and, with a libtiff that has it, Zstandard (50000) are read");
  }
  return *found;
}

PixelType
GetPixelType(const TiffFile & file, const SliceFormat & format)
{
  const std::array<const char *, 3> kinds{ "uint", "int", "float" };
  std::string                       name = "unknown";
  if (format.bits == 1)
  {
    return PixelType::UInt8; // they are unpacked
  }
  if (format.sampleFormat >= SAMPLEFORMAT_UINT && format.sampleFormat <= SAMPLEFORMAT_IEEEFP)
  {
    name = kinds[format.sampleFormat - 1u] + std::to_string(format.bits);
  }
  const std::optional<PixelType> type = PixelTypeFromName(name);
  if (!type)
  {
    file.Refuse("its voxels have " + std::to_string(format.bits) + " bits of the sample format " +
                std::to_string(format.sampleFormat) +
                "; only whole numbers of 1 bit or 8 to 64 bits and reals of 32 and 64 bits are read");
  }
  return *type;
}

/** Distances of voxels, and why they are a guess; empty: the file gives them in millimeters. */
struct TiffSpacing
{
  std::array<double, 3> lengths{ { 1.0, 1.0, 1.0 } };
  std::string           doubt;
  bool                  inMillimeters{ false };
};

/** The spacing in millimeters. Without a known unit the numbers stay as they are written, so that their ratios hold. */
TiffSpacing
GetSpacing(const TiffFile & file, const TiffDescription & description, bool isStack)
{
  const auto                  unit = file.Get<std::uint16_t>(TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
  const std::optional<double> unitOfTag = unit == RESUNIT_INCH         ? std::optional<double>(25.4)
                                          : unit == RESUNIT_CENTIMETER ? std::optional<double>(10.0)
                                                                       : std::nullopt;
  const std::array<double, 2> perUnit{ { static_cast<double>(file.Get<float>(TIFFTAG_XRESOLUTION, 0.0F)),
                                         static_cast<double>(file.Get<float>(TIFFTAG_YRESOLUTION, 0.0F)) } };
  TiffSpacing                 spacing;
  const std::size_t           axes = isStack ? 3 : 2;
  bool                        isKnown = description.unknownUnit.empty();
  bool                        isTold = true;
  std::array<double, 3>       units{ { 1.0, 1.0, 1.0 } };
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    std::optional<double> length = description.lengths[axis];
    std::optional<double> millimeters = description.units[axis];
    // Without a unit the resolution of other programs means nothing.
    if (!length && axis < 2 && perUnit[axis] > 0.0 && (description.isOfImageJ || unitOfTag))
    {
      length = 1.0 / perUnit[axis];
      millimeters = description.isOfImageJ && millimeters ? millimeters : unitOfTag;
    }
    millimeters = millimeters || !description.isOfImageJ ? millimeters : unitOfTag;
    spacing.lengths[axis] = length.value_or(1.0);
    units[axis] = millimeters.value_or(1.0);
    isKnown = isKnown && length && millimeters;
    isTold = isTold && length;
  }
  if (!description.unknownUnit.empty())
  {
    spacing.doubt = "its lengths are in the unknown unit '" + description.unknownUnit + "'";
    return isTold ? spacing : TiffSpacing{ { { 1.0, 1.0, 1.0 } }, spacing.doubt, false };
  }
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    spacing.lengths[axis] *= units[axis];
  }
  spacing.inMillimeters = isKnown;
  if (!isKnown && isStack)
  {
    spacing.doubt = "the file does not tell all distances of its voxels in a unit of length";
  }
  return spacing;
}

/** \class StackReader
 * \brief Puts the directories of a file together. */
class StackReader
{
public:
  /** \param isSlice of a series, which may have a description of all of them */
  StackReader(const std::filesystem::path & fileName, bool isSlice)
    : m_File(fileName)
    , m_IsSlice(isSlice)
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
      itk::MedialVoxelCheckAbort();
      this->AddSlice();
      ++slices;
    } while (m_File.NextDirectory());
    this->SetGeometry(slices == 1 && m_Description.isOfImageJ && !m_IsSlice ? this->AddUnlistedSlices() : slices);
    this->CheckNumberOfSlices();
    return std::move(m_Header);
  }

private:
  void
  ReadFormat()
  {
    m_Format = GetFormat(m_File);
    CheckVariant(m_File);
    m_Packing = FindPacking(m_File, m_Format.compression);
    m_Description = ReadTiffDescription(m_File.Get<const char *>(TIFFTAG_IMAGEDESCRIPTION, ""));
    if (!m_Description.refusal.empty())
    {
      m_File.Refuse(m_Description.refusal);
    }
    if (itk::CheckedFileSize({ m_Format.width, m_Format.height, 8 }) == 0)
    {
      m_File.Refuse("a slice of " + FormatSize({ m_Format.width, m_Format.height }) + " voxels is empty or too large");
    }
    m_Header.pixelType = GetPixelType(m_File, m_Format);
    m_Meaning = m_File.Get<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    m_Spacing = { GetSpacing(m_File, m_Description, false), GetSpacing(m_File, m_Description, true) };
    m_Header.compressed = m_Format.compression != COMPRESSION_NONE;
    m_Header.liesInRows = !m_Format.isTiled && m_Format.bits > 1;
    // libtiff unpacks into the order of the machine.
    m_IsUnpacked = m_Header.compressed || !m_Header.liesInRows;
    m_Header.bigEndian = m_IsUnpacked ? itk::MachineIsBigEndian() : TIFFIsBigEndian(m_File.GetHandle()) != 0;
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
    const TiffBands     bands = m_File.GetBands();
    const std::uint64_t striles = bands.GetCount() * bands.GetStriles();
    const std::uint32_t found = m_Format.isTiled ? TIFFNumberOfTiles(handle) : TIFFNumberOfStrips(handle);
    if (striles == 0 || striles != found)
    {
      m_File.Refuse("a slice of " + FormatSize({ bands.width, bands.height }) + " voxels has " + std::to_string(found) +
                    (m_Format.isTiled ? " tiles of " + FormatSize({ bands.tileWidth, bands.rows }) + " voxels"
                                      : " strips of " + std::to_string(bands.rows) + " rows"));
    }
    for (std::uint32_t strile = 0; strile < found; ++strile)
    {
      this->AddBlock(
        TIFFGetStrileOffset(handle, strile), TIFFGetStrileByteCount(handle, strile), this->GetBytes(bands, strile));
    }
    for (std::uint64_t band = 0; m_IsUnpacked && band < bands.GetCount(); ++band)
    {
      m_Header.decoderMemory = std::max(m_Header.decoderMemory, m_File.GetBandMemory(band));
    }
  }

  /** Bytes of a strip or tile; tiles are whole at the ends of a slice too. */
  std::uint64_t
  GetBytes(const TiffBands & bands, std::uint64_t strile) const
  {
    if (!m_Format.isTiled)
    {
      return bands.GetRows(strile) * this->GetRowSize();
    }
    const std::uint64_t bytes =
      itk::CheckedFileSize({ bands.tileWidth, bands.rows, GetTraits(m_Header.pixelType).bytes });
    if (bytes == 0 || bytes > MaximumTileSize)
    {
      m_File.Refuse("a tile of " + FormatSize({ bands.tileWidth, bands.rows }) + " voxels is empty or has more than " +
                    FormatBytes(MaximumTileSize));
    }
    return bytes;
  }

  void
  AddBlock(std::uint64_t offset, std::uint64_t packedSize, std::uint64_t bytes)
  {
    const std::uint64_t size = m_Header.dataFileSize;
    // libtiff puts strips that a table does not list at 0, where the file has its own header.
    if (offset == 0 || offset > size || size - offset < packedSize)
    {
      m_File.Refuse("it has " + std::to_string(size) + " bytes; " + std::to_string(packedSize) +
                    " bytes of voxels should lie at " + std::to_string(offset));
    }
    if (bytes / m_Packing.maximumRatio / this->GetVoxelsPerByte() > packedSize || packedSize == 0)
    {
      m_File.Refuse((m_Format.isTiled ? "a tile of " : "a strip of ") + std::to_string(packedSize) +
                    " bytes cannot hold " + std::to_string(bytes) + " bytes of voxels");
    }
    if (!m_IsUnpacked)
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

  /** ImageJ lists only the first slice of large stacks, with the number of the others.
   * \return number of all slices */
  std::uint64_t
  AddUnlistedSlices()
  {
    if (m_Description.images.empty())
    {
      return 1;
    }
    const std::optional<std::int64_t> images = ParseInteger(m_Description.images);
    if (!images || *images < 1 || *images > MaximumUnlistedSlices)
    {
      m_File.Refuse("its description has no valid number of images");
    }
    if (*images > 1 && m_Header.segments.size() != 1)
    {
      m_File.Refuse("its description announces " + std::to_string(*images) + " images, but only one is listed");
    }
    const std::uint64_t bytes = m_Format.height * this->GetRowSize();
    for (std::int64_t slice = 1; slice < *images; ++slice)
    {
      const itk::MedialVoxelFileSegment & known = m_Header.segments.back();
      this->AddBlock(known.offset + known.numberOfBytes, bytes, bytes);
    }
    return static_cast<std::uint64_t>(*images);
  }

  /** Planes of a stack that were lost, or lie in other files, are missed. */
  void
  CheckNumberOfSlices() const
  {
    const std::uint64_t slices = m_Header.geometry.GetDimension() == 3 ? m_Header.geometry.size[2] : 1;
    if (!m_IsSlice && !m_Description.images.empty() && m_Description.images != std::to_string(slices))
    {
      m_File.Refuse("its description tells of " + itk::MedialVoxelText::MakePrintable(m_Description.images) +
                    " slices, and it has " + std::to_string(slices) +
                    (slices == 1 ? "; a series with a file for each slice is named by its folder" : ""));
    }
  }

  void
  SetGeometry(std::uint64_t slices)
  {
    VolumeGeometry &    geometry = m_Header.geometry;
    const TiffSpacing & spacing = m_Spacing[slices > 1 ? 1 : 0];
    geometry.size = { m_Format.width, m_Format.height };
    if (slices > 1)
    {
      geometry.size.push_back(slices);
    }
    geometry.spacing.assign(spacing.lengths.begin(), spacing.lengths.begin() + geometry.GetDimension());
    geometry.inMillimeters = spacing.inMillimeters;
    if (!spacing.doubt.empty())
    {
      WarnOfUnknownSpacing(m_Header, spacing.doubt);
    }
    if (const std::string shown = this->DescribeShown(); !shown.empty())
    {
      m_Header.warnings.push_back(
        { HeaderWarnings::StoredValues, shown + "; thresholds compare the numbers that are stored", {} });
    }
    geometry.origin.assign(geometry.size.size(), 0.0);
    geometry.SetIdentityDirection();
    // Tiles may lie in one place; without this, a small file could stand for a large volume.
    const std::uint64_t bytes = slices * m_Format.height * this->GetRowSize();
    if (m_IsUnpacked && !m_Header.compressed && bytes / this->GetVoxelsPerByte() > m_Header.dataFileSize)
    {
      m_File.Refuse("it has " + std::to_string(m_Header.dataFileSize) + " bytes, its voxels have " +
                    std::to_string(bytes));
    }
  }

  /** Whether other programs show other values than the stored ones. */
  std::string
  DescribeShown() const
  {
    return m_Meaning == PHOTOMETRIC_MINISWHITE ? "0 is white in this file"
           : m_Meaning == PHOTOMETRIC_PALETTE  ? "the numbers are those of colors in a palette"
           : m_Description.isCalibrated        ? "ImageJ shows calibrated values of this file"
                                               : "";
  }

  std::uint64_t
  GetVoxelsPerByte() const
  {
    return m_Format.bits == 1 ? 8 : 1;
  }

  std::uint64_t
  GetRowSize() const
  {
    return std::uint64_t{ m_Format.width } * GetTraits(m_Header.pixelType).bytes;
  }

  TiffFile        m_File;
  bool            m_IsSlice;
  std::uint16_t   m_Meaning{ PHOTOMETRIC_MINISBLACK };
  SliceFormat     m_Format{};
  Packing         m_Packing{};
  bool            m_IsUnpacked{ false }; ///< by libtiff, which puts tiles together too
  TiffDescription m_Description;
  VolumeHeader    m_Header;

  std::array<TiffSpacing, 2> m_Spacing; ///< of an image, and of a stack
};

VolumeHeader
ReadTiffHeader(const std::filesystem::path & fileName)
{
  return StackReader(fileName, false).Read();
}

} // namespace

VolumeHeader
ReadTiffSliceHeader(const std::filesystem::path & fileName)
{
  return StackReader(fileName, true).Read();
}

VolumeFormat
MakeTiffFormat()
{
  return { "TIFF",
           { { ".tif" }, { ".tiff" } },
           { ReadTiffHeader, DataSizeCheck::ByReader, OpenTiffStream, MakeTiffImageIO } };
}

} // end namespace medialvoxel
