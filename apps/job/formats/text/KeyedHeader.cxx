// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FormatRows.h"
#include "HeaderParsing.h"
#include "LengthUnits.h"
#include "Text.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace medialvoxel
{
namespace
{

/** Extension of the file beside the header. */
constexpr const char * VoxelExtension = ".vol";

constexpr size_t        MaximumBytesPerLine = 1 << 16;
constexpr std::uint64_t MaximumBytesOfHeader = 1 << 20;

/** Names that programs of scanners give the fields of a header. Names are "[section]key", or "key" where a header has
 * no sections; an empty name is a field that a dialect lacks. */
struct Dialect
{
  const char *              extension;  ///< of the header
  const char *              program;    ///< that writes it
  std::vector<const char *> sizes;      ///< one field with all sizes, or one for each axis
  std::vector<const char *> types;      ///< whose values make up the name of a type
  const char *              presetType; ///< where the header has none; null: it must have one

  std::vector<std::pair<const char *, PixelType>> typeNames;

  const char * spacing; ///< one value for each axis, or one for all
  const char * unit;
  double       presetUnit; ///< millimeters
  const char * bytesBefore;
  const char * byteOrder;
  const char * dataFile;   ///< without one: named as the header, with another extension
  const char * fileFormat; ///< must be raw

  std::vector<const char *> refusedSections; ///< of voxels in several files
};

const std::vector<Dialect> &
GetDialects()
{
  static const std::vector<Dialect> dialects{
    { ".vol.info",
      "PyHST",
      { "num_x", "num_y", "num_z" },
      { "data_type" },
      "float32",
      { { "uint8", PixelType::UInt8 },
        { "uint16", PixelType::UInt16 },
        { "int16", PixelType::Int16 },
        { "uint32", PixelType::UInt32 },
        { "int32", PixelType::Int32 },
        { "float32", PixelType::Float32 },
        { "float64", PixelType::Float64 } },
      "voxelsize",
      nullptr,
      1e-3,
      nullptr,
      "byteorder",
      nullptr,
      nullptr,
      {} },
    { ".vgi",
      "VGStudio",
      { "[file1]size" },
      { "[file1]datatype", "[file1]bitsperelement" },
      nullptr,
      { { "unsigned integer 8", PixelType::UInt8 },
        { "unsigned integer 16", PixelType::UInt16 },
        { "unsigned integer 32", PixelType::UInt32 },
        { "signed integer 8", PixelType::Int8 },
        { "signed integer 16", PixelType::Int16 },
        { "signed integer 32", PixelType::Int32 },
        { "float 32", PixelType::Float32 } },
      "[geometry]resolution",
      "[geometry]unit",
      1.0,
      "[file1]skipheader",
      nullptr,
      "[file1]name",
      "[file1]fileformat",
      { "[file2]" } },
    { ".pcr",
      "phoenix datos|x",
      { "[volumedata]volume_sizex", "[volumedata]volume_sizey", "[volumedata]volume_sizez" },
      { "[volumedata]format" },
      nullptr,
      { { "1", PixelType::UInt8 }, { "5", PixelType::UInt16 }, { "10", PixelType::Float32 } },
      "[volumedata]voxelsizerec",
      nullptr,
      1.0,
      nullptr,
      nullptr,
      "[volumedata]vol_file",
      nullptr,
      {} },
  };
  return dialects;
}

/** The rest of a name before an extension; nothing when the name has another one. */
std::optional<std::string>
GetStem(const std::filesystem::path & fileName, const std::string & extension)
{
  const std::string name = fileName.filename().string();
  const size_t      length = name.size() - std::min(name.size(), extension.size());
  return ToLower(name.substr(length)) == extension ? std::optional<std::string>(name.substr(0, length)) : std::nullopt;
}

/** \class KeyedFields
 * \brief The fields of a header; a repeated field must have the same value. */
class KeyedFields
{
public:
  explicit KeyedFields(const std::filesystem::path & fileName)
    : m_FileName(fileName)
  {
    HeaderLines lines(fileName, MaximumBytesPerLine);
    std::string section;
    std::string line;
    while (lines.Next(line))
    {
      if (lines.GetPosition() > MaximumBytesOfHeader)
      {
        RefuseHeader(fileName, "it has more than " + std::to_string(MaximumBytesOfHeader) + " bytes; no header has");
      }
      line = Trim(line);
      const size_t separator = line.find('=');
      if (!line.empty() && line.front() == '[' && line.back() == ']')
      {
        section = ToLower(line);
        m_Sections.insert(section);
      }
      else if (separator != std::string::npos)
      {
        this->Add(section + ToLower(Trim(line.substr(0, separator))), Trim(line.substr(separator + 1)));
      }
    }
  }

  bool
  HasSection(const std::string & section) const
  {
    return m_Sections.count(section) > 0;
  }

  /** Nothing for a null name. */
  std::optional<std::string>
  Find(const char * name) const
  {
    if (!name)
    {
      return std::nullopt;
    }
    const auto other = m_OtherValues.find(name);
    if (other != m_OtherValues.end())
    {
      RefuseHeader(m_FileName,
                   std::string(name) + " is '" + m_Fields.values.at(name) + "' and '" + other->second +
                     "'; only headers of one volume are read");
    }
    return m_Fields.Find(name);
  }

  std::string
  Require(const char * name) const
  {
    this->Find(name);
    return RequireField(m_FileName, m_Fields, name);
  }

private:
  void
  Add(const std::string & name, const std::string & value)
  {
    const auto [field, isNew] = m_Fields.values.emplace(name, value);
    if (!isNew && field->second != value)
    {
      m_OtherValues[name] = value;
    }
  }

  std::filesystem::path              m_FileName;
  HeaderFields                       m_Fields;
  std::map<std::string, std::string> m_OtherValues;
  std::set<std::string>              m_Sections;
};

/** \class KeyedHeaderReader
 * \brief Puts the fields of a header together. */
class KeyedHeaderReader
{
public:
  KeyedHeaderReader(const std::filesystem::path & fileName, const Dialect & dialect)
    : m_FileName(fileName)
    , m_Dialect(dialect)
    , m_Fields(fileName)
  {}

  VolumeHeader
  Read() const
  {
    this->CheckVariant();
    VolumeHeader header;
    header.fileName = m_FileName;
    header.geometry.size = this->ReadSize();
    header.geometry.spacing = this->ReadSpacing();
    header.geometry.inMillimeters = m_Fields.Find(m_Dialect.spacing).has_value();
    header.geometry.origin.assign(header.geometry.size.size(), 0.0);
    header.geometry.SetIdentityDirection();
    header.pixelType = this->ReadPixelType();
    header.bigEndian = this->ReadByteOrder();
    header.dataOffset = this->ReadDataOffset();
    header.dataFile = this->LocateData();
    header.dataFileSize = GetDataFileSize(m_FileName, header.dataFile);
    return header;
  }

private:
  void
  CheckVariant() const
  {
    for (const char * const section : m_Dialect.refusedSections)
    {
      if (m_Fields.HasSection(section))
      {
        RefuseHeader(m_FileName, std::string("it has the section ") + section + "; only voxels in one file are read");
      }
    }
    const std::string format = m_Fields.Find(m_Dialect.fileFormat).value_or("raw");
    if (ToLower(format) != "raw")
    {
      RefuseHeader(m_FileName, std::string(m_Dialect.fileFormat) + " is '" + format + "'; only raw is read");
    }
  }

  std::vector<std::uint64_t>
  ReadSize() const
  {
    const std::string text = Join(m_Dialect.sizes, " ", [this](const char * name) { return m_Fields.Require(name); });
    return ParseSizes(m_FileName, m_Dialect.sizes.front(), text, 3);
  }

  std::vector<double>
  ReadSpacing() const
  {
    const std::optional<std::string> text = m_Fields.Find(m_Dialect.spacing);
    const double                     unit = this->ReadUnit();
    if (!text)
    {
      return { 1.0, 1.0, 1.0 };
    }
    const bool          isOfAll = SplitAtBlanks(*text).size() == 1;
    std::vector<double> spacing = ParseSpacings(m_FileName, m_Dialect.spacing, *text, isOfAll ? 1 : 3);
    spacing.resize(3, spacing.front());
    std::transform(spacing.begin(), spacing.end(), spacing.begin(), [unit](double length) { return unit * length; });
    return spacing;
  }

  double
  ReadUnit() const
  {
    const std::optional<std::string> text = m_Fields.Find(m_Dialect.unit);
    const std::optional<double>      unit = text ? GetMillimeters(*text) : m_Dialect.presetUnit;
    if (!unit)
    {
      RefuseHeader(m_FileName, std::string(m_Dialect.unit) + " is '" + *text + "'; it must be a unit of length, as mm");
    }
    return *unit;
  }

  PixelType
  ReadPixelType() const
  {
    const bool isPreset = m_Dialect.presetType && !m_Fields.Find(m_Dialect.types.front());
    const auto name = isPreset
                        ? m_Dialect.presetType
                        : Join(m_Dialect.types, " ", [this](const char * field) { return m_Fields.Require(field); });
    const auto found = std::find_if(m_Dialect.typeNames.begin(), m_Dialect.typeNames.end(), [&name](const auto & type) {
      return ToLower(name) == type.first;
    });
    if (found == m_Dialect.typeNames.end())
    {
      const std::string known =
        Join(m_Dialect.typeNames, ", ", [](const auto & type) { return std::string(type.first); });
      RefuseHeader(m_FileName,
                   Join(m_Dialect.types, " ", [](const char * field) { return std::string(field); }) + " is '" + name +
                     "'; these are read: " + known);
    }
    return found->second;
  }

  bool
  ReadByteOrder() const
  {
    const std::string order = m_Fields.Find(m_Dialect.byteOrder).value_or("LOWBYTEFIRST");
    if (order != "LOWBYTEFIRST" && order != "HIGHBYTEFIRST")
    {
      RefuseHeader(m_FileName,
                   std::string(m_Dialect.byteOrder) + " is '" + order + "'; it must be LOWBYTEFIRST or HIGHBYTEFIRST");
    }
    return order == "HIGHBYTEFIRST";
  }

  std::uint64_t
  ReadDataOffset() const
  {
    const std::string                 text = m_Fields.Find(m_Dialect.bytesBefore).value_or("0");
    const std::optional<std::int64_t> bytes = ParseInteger(text);
    if (!bytes || *bytes < 0)
    {
      RefuseHeader(m_FileName,
                   std::string(m_Dialect.bytesBefore) + " is '" + text + "'; it must be a whole number from 0 on");
    }
    return static_cast<std::uint64_t>(*bytes);
  }

  /** Programs write where the file was on their machine; it is looked for beside the header. */
  std::filesystem::path
  LocateData() const
  {
    std::string name = m_Fields.Find(m_Dialect.dataFile).value_or("");
    name = name.substr(name.find_last_of("/\\") + 1);
    return FindDataFile(m_FileName, name.empty() ? *GetStem(m_FileName, m_Dialect.extension) + VoxelExtension : name);
  }

  std::filesystem::path m_FileName;
  const Dialect &       m_Dialect;
  KeyedFields           m_Fields;
};

/** The header of a file of voxels that has a name of its own. */
VolumeHeader
ReadHeaderBeside(const std::filesystem::path & dataFile, const std::string & stem)
{
  std::string names;
  for (const Dialect & dialect : GetDialects())
  {
    const std::filesystem::path fileName = dataFile.parent_path() / (stem + dialect.extension);
    std::error_code             error;
    if (std::filesystem::exists(fileName, error))
    {
      const VolumeHeader header = KeyedHeaderReader(fileName, dialect).Read();
      if (!std::filesystem::equivalent(header.dataFile, dataFile, error))
      {
        RefuseHeader(fileName, "its data file is " + header.dataFile.string() + ", not " + dataFile.string());
      }
      return header;
    }
    names += (names.empty() ? "" : ", ") + fileName.filename().string() + " of " + dialect.program;
  }
  RefuseHeader(dataFile, "its header is missing; beside it there must be one of " + names);
}

VolumeHeader
ReadKeyedHeader(const std::filesystem::path & fileName)
{
  for (const Dialect & dialect : GetDialects())
  {
    if (GetStem(fileName, dialect.extension))
    {
      return KeyedHeaderReader(fileName, dialect).Read();
    }
  }
  OpenRegularFile(fileName);
  return ReadHeaderBeside(fileName, *GetStem(fileName, VoxelExtension));
}

} // namespace

VolumeFormat
MakeKeyedFormat()
{
  std::vector<VolumeExtension> extensions{ { VoxelExtension } };
  for (const Dialect & dialect : GetDialects())
  {
    extensions.push_back({ dialect.extension });
  }
  return { "VOL", extensions, MakePlainInput(ReadKeyedHeader, DataSizeCheck::Exactly) };
}

} // end namespace medialvoxel
