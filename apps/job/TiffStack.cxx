// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffStack.h"

#include "Text.h"
#include "TiffFile.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace medialvoxel
{
namespace
{

/** No way of packing makes one byte out of more than this many. */
constexpr std::uint64_t MaximumRatio = 2048;

/** \class StackReader
 * \brief Puts the directories of a file together. */
class StackReader
{
public:
  explicit StackReader(const std::filesystem::path & fileName)
    : m_File(fileName)
  {
    m_Stack.fileName = fileName;
    m_Stack.bigEndian = m_File.IsBigEndian();
  }

  TiffStack
  Read()
  {
    TiffDirectory directory;
    while (m_File.ReadNextDirectory(directory))
    {
      this->CheckVariant(directory);
      if (m_Stack.numberOfSlices++ == 0)
      {
        this->ReadFormat(directory);
      }
      this->AddStrips(directory);
    }
    if (m_Stack.numberOfSlices == 1)
    {
      this->AddUnlistedSlices(directory);
    }
    return std::move(m_Stack);
  }

private:
  /** What all slices share. */
  struct Format
  {
    std::uint64_t width;
    std::uint64_t height;
    std::uint64_t bits;
    std::uint64_t sampleFormat;
    std::uint64_t compression;
    std::uint64_t predictor;

    bool
    operator==(const Format & other) const
    {
      return width == other.width && height == other.height && bits == other.bits &&
             sampleFormat == other.sampleFormat && compression == other.compression && predictor == other.predictor;
    }
  };

  Format
  GetFormat(const TiffDirectory & directory)
  {
    return { m_File.GetNumber(directory, ImageWidth),       m_File.GetNumber(directory, ImageLength),
             m_File.GetNumber(directory, BitsPerSample, 1), m_File.GetNumber(directory, SampleFormat, 1),
             m_File.GetNumber(directory, Compression, 1),   m_File.GetNumber(directory, Predictor, 1) };
  }

  void
  ReadFormat(const TiffDirectory & directory)
  {
    m_Format = this->GetFormat(directory);
    m_Stack.width = m_Format.width;
    m_Stack.height = m_Format.height;
    m_Stack.pixelType = this->GetPixelType();
    m_Stack.compression = this->GetCompression();
    m_Stack.differences = m_Format.predictor == 2;
    if (m_Format.predictor != 1 && m_Format.predictor != 2)
    {
      m_File.Refuse("its predictor is " + std::to_string(m_Format.predictor) + "; only 1 and 2 are read");
    }
    if (itk::CheckedFileSize({ m_Format.width, m_Format.height, 8 }) == 0)
    {
      m_File.Refuse("a slice of " + FormatSize({ m_Format.width, m_Format.height }) + " voxels is empty or too large");
    }
    this->ReadSpacing(directory);
  }

  PixelType
  GetPixelType() const
  {
    const std::array<const char *, 3> kinds{ "uint", "int", "float" };
    std::string                       name = "unknown";
    if (m_Format.sampleFormat >= 1 && m_Format.sampleFormat <= kinds.size())
    {
      name = kinds[m_Format.sampleFormat - 1] + std::to_string(m_Format.bits);
    }
    const std::optional<PixelType> type = PixelTypeFromName(name);
    if (!type)
    {
      m_File.Refuse("its voxels have " + std::to_string(m_Format.bits) + " bits of the sample format " +
                    std::to_string(m_Format.sampleFormat) +
                    "; only whole numbers of 8 to 64 bits and reals of 32 and 64 bits are read");
    }
    return *type;
  }

  TiffCompression
  GetCompression() const
  {
    for (const TiffCompression known : { TiffCompression::None,
                                         TiffCompression::Lzw,
                                         TiffCompression::Deflate,
                                         TiffCompression::OldDeflate,
                                         TiffCompression::PackBits })
    {
      if (m_Format.compression == static_cast<std::uint64_t>(known))
      {
        return known;
      }
    }
    m_File.Refuse("its compression is number " + std::to_string(m_Format.compression) +
                  "; only none, LZW, Deflate and PackBits are read");
  }

  void
  ReadSpacing(const TiffDirectory & directory)
  {
    constexpr std::uint64_t inch = 2;
    constexpr std::uint64_t centimeter = 3;
    const std::uint64_t     unit = m_File.GetNumber(directory, ResolutionUnit, 1);
    const double            x = m_File.GetRatio(directory, XResolution);
    const double            y = m_File.GetRatio(directory, YResolution);
    if ((unit == inch || unit == centimeter) && x > 0 && y > 0)
    {
      const double millimeters = unit == inch ? 25.4 : 10.0;
      m_Stack.spacingX = millimeters / x;
      m_Stack.spacingY = millimeters / y;
    }
  }

  void
  CheckVariant(const TiffDirectory & directory)
  {
    const auto require = [&](TiffTag tag, std::uint64_t value, const char * what) {
      const std::uint64_t found = m_File.GetNumber(directory, tag, value);
      if (found != value)
      {
        m_File.Refuse(std::string(what) + " (tag " + std::to_string(tag) + " is " + std::to_string(found) + ")");
      }
    };
    require(SamplesPerPixel, 1, "only one value per voxel is read");
    require(Photometric, 1, "only gray values that grow from black to white are read");
    require(Orientation, 1, "only rows from top to bottom, and from left to right, are read");
    if (directory.count(TileWidth) != 0)
    {
      m_File.Refuse("its slices are stored in tiles; only strips are read");
    }
    constexpr std::uint64_t reducedOrMask = 1 | 4;
    if ((m_File.GetNumber(directory, SubfileType, 0) & reducedOrMask) != 0)
    {
      m_File.Refuse("it has reduced images or masks beside its slices, which are not read");
    }
  }

  void
  AddStrips(const TiffDirectory & directory)
  {
    if (!(this->GetFormat(directory) == m_Format))
    {
      m_File.Refuse("its slices differ in size, type or compression");
    }
    const std::uint64_t rowBytes = m_Format.width * GetTraits(m_Stack.pixelType).bytes;
    const std::uint64_t rowsPerStrip =
      std::min(m_Format.height, m_File.GetNumber(directory, RowsPerStrip, m_Format.height));
    const std::uint64_t strips = rowsPerStrip == 0 ? 0 : (m_Format.height + rowsPerStrip - 1) / rowsPerStrip;
    const auto          offsets = m_File.GetNumbers(directory, StripOffsets, {});
    const auto          counts = m_File.GetNumbers(directory, StripByteCounts, {});
    if (strips == 0 || offsets.size() != strips || counts.size() != strips)
    {
      m_File.Refuse("a slice has " + std::to_string(offsets.size()) + " strips of " + std::to_string(counts.size()) +
                    " sizes; there must be " + std::to_string(strips));
    }
    for (std::uint64_t strip = 0; strip < strips; ++strip)
    {
      const std::uint64_t rows = std::min(rowsPerStrip, m_Format.height - strip * rowsPerStrip);
      this->AddStrip({ offsets[strip], counts[strip], rows * rowBytes });
    }
  }

  void
  AddStrip(const TiffStrip & strip)
  {
    const std::uint64_t size = m_File.GetSize();
    if (strip.offset > size || size - strip.offset < strip.packedBytes)
    {
      m_File.Refuse("it has " + std::to_string(size) + " bytes; " + std::to_string(strip.packedBytes) +
                    " bytes of voxels should lie at " + std::to_string(strip.offset));
    }
    const bool isPlain = m_Stack.compression == TiffCompression::None;
    if (strip.bytes > strip.packedBytes * (isPlain ? 1 : MaximumRatio))
    {
      m_File.Refuse("a strip of " + std::to_string(strip.packedBytes) + " bytes cannot hold " +
                    std::to_string(strip.bytes) + " bytes of voxels");
    }
    m_Stack.strips.push_back(strip);
  }

  /** ImageJ lists only the first slice of large stacks and tells the number of those that follow it. */
  void
  AddUnlistedSlices(const TiffDirectory & directory)
  {
    constexpr std::string_view field = "\nimages=";
    const std::string          text = m_File.GetText(directory, ImageDescription);
    const size_t               begin = text.find(field);
    if (text.rfind("ImageJ=", 0) != 0 || begin == std::string::npos)
    {
      return;
    }
    const size_t end = text.find('\n', begin + field.size());
    const auto   images = ParseInteger(text.substr(begin + field.size(), end - begin - field.size()));
    if (!images || *images < 1 || static_cast<std::uint64_t>(*images) > MaximumTiffSlices)
    {
      m_File.Refuse("its description has no valid number of images");
    }
    if (*images > 1 && (m_Stack.compression != TiffCompression::None || m_Stack.strips.size() != 1))
    {
      m_File.Refuse("its description tells of " + std::to_string(*images) + " images, of which only one is listed");
    }
    m_Stack.numberOfSlices = static_cast<std::uint64_t>(*images);
    const TiffStrip first = m_Stack.strips.front();
    for (std::uint64_t slice = 1; slice < m_Stack.numberOfSlices; ++slice)
    {
      this->AddStrip({ first.offset + slice * first.bytes, first.bytes, first.bytes });
    }
  }

  TiffFile  m_File;
  TiffStack m_Stack;
  Format    m_Format{};
};

} // namespace

TiffStack
ReadTiffStack(const std::filesystem::path & fileName)
{
  return StackReader(fileName).Read();
}

} // end namespace medialvoxel
