// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffStack.h"

#include "BinaryHeader.h"
#include "HeaderParsing.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MaximumSlices = std::uint64_t{ 1 } << 20;
constexpr std::uint64_t MaximumEntries = std::uint64_t{ 1 } << 16;

/** No way of packing makes one byte out of more than this many. */
constexpr std::uint64_t MaximumRatio = 2048;

enum Tag : std::uint16_t
{
  SubfileType = 254,
  ImageWidth = 256,
  ImageLength = 257,
  BitsPerSample = 258,
  Compression = 259,
  Photometric = 262,
  ImageDescription = 270,
  StripOffsets = 273,
  Orientation = 274,
  SamplesPerPixel = 277,
  RowsPerStrip = 278,
  StripByteCounts = 279,
  XResolution = 282,
  YResolution = 283,
  ResolutionUnit = 296,
  Predictor = 317,
  TileWidth = 322,
  SampleFormat = 339
};

/** Type, bytes of one value, by the numbers of the format: the types that the tags above have. */
unsigned int
GetBytesOfType(unsigned int type)
{
  constexpr std::array<unsigned int, 17> bytes{ 0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 0, 0, 0, 8 };
  return type < bytes.size() ? bytes[type] : 0;
}

struct Entry
{
  unsigned int  type{ 0 };
  std::uint64_t count{ 0 };
  std::uint64_t offset{ 0 }; ///< of the values in the file
};

/** One directory, which describes one slice. */
using Directory = std::map<std::uint16_t, Entry>;

/** \class TiffFile
 * \brief Random access to the numbers of a file, none of which is believed to lie in it before it was read. */
class TiffFile
{
public:
  explicit TiffFile(const std::filesystem::path & fileName)
    : m_FileName(fileName)
    , m_File(OpenRegularFile(fileName))
    , m_Size(GetDataFileSize(fileName, fileName))
  {
    const BinaryHeader start = this->ReadBytes(0, 4);
    const auto         order = start.Get<std::uint16_t>(0);
    if (order != 0x4949 && order != 0x4D4D)
    {
      this->Refuse("it does not begin as a TIFF file does");
    }
    m_BigEndian = order == 0x4D4D;
    const auto version = this->ReadBytes(0, 4).Get<std::uint16_t>(2);
    if (version != 42 && version != 43)
    {
      this->Refuse("it does not begin as a TIFF file does");
    }
    m_IsBig = version == 43;
  }

  [[noreturn]] void
  Refuse(const std::string & what) const
  {
    RefuseHeader(m_FileName, what);
  }

  bool
  IsBigEndian() const
  {
    return m_BigEndian;
  }

  std::uint64_t
  GetSize() const
  {
    return m_Size;
  }

  /** All directories in the order of their chain. */
  std::vector<Directory>
  ReadDirectories()
  {
    std::vector<Directory>  directories;
    std::set<std::uint64_t> offsets;
    for (std::uint64_t offset = this->ReadOffset(m_IsBig ? 8 : 4); offset != 0;)
    {
      if (!offsets.insert(offset).second || offsets.size() > MaximumSlices)
      {
        this->Refuse("its directories form a circle, or are more than " + std::to_string(MaximumSlices));
      }
      directories.push_back(this->ReadDirectory(offset));
    }
    if (directories.empty())
    {
      this->Refuse("it has no directory");
    }
    return directories;
  }

  /** Whole numbers of an entry; \a preset when there is none. */
  std::vector<std::uint64_t>
  GetNumbers(const Directory & directory, Tag tag, const std::vector<std::uint64_t> & preset)
  {
    const auto found = directory.find(tag);
    if (found == directory.end())
    {
      return preset;
    }
    const Entry &              entry = found->second;
    const unsigned int         bytes = GetBytesOfType(entry.type);
    const BinaryHeader         values = this->ReadValues(entry, bytes);
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t i = 0; i < entry.count; ++i)
    {
      const std::uint64_t at = i * bytes;
      numbers.push_back(bytes == 1   ? values.Get<std::uint8_t>(at)
                        : bytes == 2 ? values.Get<std::uint16_t>(at)
                        : bytes == 4 ? values.Get<std::uint32_t>(at)
                                     : values.Get<std::uint64_t>(at));
    }
    return numbers;
  }

  /** The only whole number of an entry. */
  std::uint64_t
  GetNumber(const Directory & directory, Tag tag, std::optional<std::uint64_t> preset = std::nullopt)
  {
    const auto numbers =
      this->GetNumbers(directory, tag, preset ? std::vector<std::uint64_t>{ *preset } : std::vector<std::uint64_t>{});
    if (numbers.size() != 1)
    {
      this->Refuse("its tag " + std::to_string(tag) + " has " + std::to_string(numbers.size()) + " values, not 1");
    }
    return numbers.front();
  }

  /** A ratio of whole numbers, as a number of single precision as other readers have it; 1 when there is none. */
  double
  GetRatio(const Directory & directory, Tag tag)
  {
    constexpr unsigned int rational = 5;
    const auto             found = directory.find(tag);
    if (found == directory.end() || found->second.type != rational || found->second.count != 1)
    {
      return 1.0;
    }
    const BinaryHeader values = this->ReadValues(found->second, 8);
    const auto         denominator = values.Get<std::uint32_t>(4);
    return denominator == 0
             ? 0.0
             : static_cast<double>(static_cast<float>(static_cast<double>(values.Get<std::uint32_t>(0)) / denominator));
  }

  std::string
  GetText(const Directory & directory, Tag tag)
  {
    const auto found = directory.find(tag);
    if (found == directory.end() || GetBytesOfType(found->second.type) != 1)
    {
      return {};
    }
    const BinaryHeader values = this->ReadValues(found->second, 1);
    std::string        text;
    for (std::uint64_t i = 0; i < found->second.count; ++i)
    {
      text += static_cast<char>(values.Get<std::uint8_t>(i));
    }
    return text;
  }

private:
  BinaryHeader
  ReadBytes(std::uint64_t offset, std::uint64_t count)
  {
    if (offset > m_Size || m_Size - offset < count)
    {
      this->Refuse("it has " + std::to_string(m_Size) + " bytes and refers to what would lie behind them");
    }
    std::vector<unsigned char> bytes(count);
    m_File.seekg(static_cast<std::streamoff>(offset));
    m_File.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(count));
    if (!m_File.good())
    {
      this->Refuse("it ends early or cannot be read");
    }
    return { std::move(bytes), m_BigEndian };
  }

  std::uint64_t
  ReadOffset(std::uint64_t offset)
  {
    return m_IsBig ? this->ReadBytes(offset, 8).Get<std::uint64_t>(0)
                   : this->ReadBytes(offset, 4).Get<std::uint32_t>(0);
  }

  /** Reads the directory at an offset, which becomes that of the next one. */
  Directory
  ReadDirectory(std::uint64_t & offset)
  {
    const std::uint64_t bytesOfCount = m_IsBig ? 8 : 2;
    const std::uint64_t bytesOfEntry = m_IsBig ? 20 : 12;
    const BinaryHeader  head = this->ReadBytes(offset, bytesOfCount);
    const std::uint64_t count = m_IsBig ? head.Get<std::uint64_t>(0) : head.Get<std::uint16_t>(0);
    if (count > MaximumEntries)
    {
      this->Refuse("a directory has " + std::to_string(count) + " entries");
    }
    const std::uint64_t begin = offset + bytesOfCount;
    const BinaryHeader  bytes = this->ReadBytes(begin, count * bytesOfEntry);
    Directory           directory;
    for (std::uint64_t at = 0; at < count * bytesOfEntry; at += bytesOfEntry)
    {
      Entry entry;
      entry.type = bytes.Get<std::uint16_t>(at + 2);
      entry.count = m_IsBig ? bytes.Get<std::uint64_t>(at + 4) : bytes.Get<std::uint32_t>(at + 4);
      const std::uint64_t field = m_IsBig ? 12 : 8;
      const std::uint64_t room = m_IsBig ? 8 : 4;
      const bool          isInline = entry.count <= room && entry.count * GetBytesOfType(entry.type) <= room;
      entry.offset = isInline  ? begin + at + field
                     : m_IsBig ? bytes.Get<std::uint64_t>(at + field)
                               : bytes.Get<std::uint32_t>(at + field);
      directory.emplace(bytes.Get<std::uint16_t>(at), entry);
    }
    offset = this->ReadOffset(begin + count * bytesOfEntry);
    return directory;
  }

  BinaryHeader
  ReadValues(const Entry & entry, unsigned int bytesPerValue)
  {
    if (bytesPerValue == 0 || entry.count > m_Size / bytesPerValue)
    {
      this->Refuse("a tag has " + std::to_string(entry.count) + " values of the type " + std::to_string(entry.type));
    }
    return this->ReadBytes(entry.offset, entry.count * bytesPerValue);
  }

  std::filesystem::path m_FileName;
  std::ifstream         m_File;
  std::uint64_t         m_Size;
  bool                  m_BigEndian{ false };
  bool                  m_IsBig{ false };
};

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
    const std::vector<Directory> directories = m_File.ReadDirectories();
    this->ReadFormat(directories.front());
    for (const Directory & directory : directories)
    {
      this->CheckVariant(directory);
      this->AddStrips(directory);
    }
    m_Stack.numberOfSlices = directories.size();
    if (directories.size() == 1)
    {
      this->AddUnlistedSlices(directories.front());
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
  GetFormat(const Directory & directory)
  {
    return { m_File.GetNumber(directory, ImageWidth),       m_File.GetNumber(directory, ImageLength),
             m_File.GetNumber(directory, BitsPerSample, 1), m_File.GetNumber(directory, SampleFormat, 1),
             m_File.GetNumber(directory, Compression, 1),   m_File.GetNumber(directory, Predictor, 1) };
  }

  void
  ReadFormat(const Directory & directory)
  {
    this->CheckVariant(directory);
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
  ReadSpacing(const Directory & directory)
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
  CheckVariant(const Directory & directory)
  {
    const auto require = [&](Tag tag, std::uint64_t value, const char * what) {
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
  AddStrips(const Directory & directory)
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
    if (strip.bytes / (isPlain ? 1 : MaximumRatio) > strip.packedBytes)
    {
      m_File.Refuse("a strip of " + std::to_string(strip.packedBytes) + " bytes cannot hold " +
                    std::to_string(strip.bytes) + " bytes of voxels");
    }
    m_Stack.strips.push_back(strip);
  }

  /** ImageJ lists only the first slice of large stacks and tells the number of those that follow it. */
  void
  AddUnlistedSlices(const Directory & directory)
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
    if (!images || *images < 1 || static_cast<std::uint64_t>(*images) > MaximumSlices)
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
