// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"

#include "Text.h"

#include "itkByteSwapper.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr size_t        MaximumBytesPerLine = size_t{ 1 } << 20;
constexpr std::uint64_t MaximumBytesOfHeader = std::uint64_t{ 1 } << 24;

// Names of the format's definition beside the ones written.
constexpr std::array<std::pair<const char *, PixelType>, 32> TypeNames{ {
  { "signed char", PixelType::Int8 },
  { "int8", PixelType::Int8 },
  { "int8_t", PixelType::Int8 },
  { "uchar", PixelType::UInt8 },
  { "unsigned char", PixelType::UInt8 },
  { "uint8", PixelType::UInt8 },
  { "uint8_t", PixelType::UInt8 },
  { "short", PixelType::Int16 },
  { "short int", PixelType::Int16 },
  { "signed short", PixelType::Int16 },
  { "signed short int", PixelType::Int16 },
  { "int16", PixelType::Int16 },
  { "int16_t", PixelType::Int16 },
  { "ushort", PixelType::UInt16 },
  { "unsigned short", PixelType::UInt16 },
  { "unsigned short int", PixelType::UInt16 },
  { "uint16", PixelType::UInt16 },
  { "uint16_t", PixelType::UInt16 },
  { "int", PixelType::Int32 },
  { "signed int", PixelType::Int32 },
  { "int32", PixelType::Int32 },
  { "int32_t", PixelType::Int32 },
  { "uint", PixelType::UInt32 },
  { "unsigned int", PixelType::UInt32 },
  { "uint32", PixelType::UInt32 },
  { "uint32_t", PixelType::UInt32 },
  { "float", PixelType::Float32 },
  { "double", PixelType::Float64 },
  { "int64", PixelType::Int64 },
  { "int64_t", PixelType::Int64 },
  { "uint64", PixelType::UInt64 },
  { "uint64_t", PixelType::UInt64 },
} };

constexpr std::array<std::pair<const char *, PixelType>, 8> LongTypeNames{ {
  { "longlong", PixelType::Int64 },
  { "long long", PixelType::Int64 },
  { "long long int", PixelType::Int64 },
  { "signed long long", PixelType::Int64 },
  { "signed long long int", PixelType::Int64 },
  { "ulonglong", PixelType::UInt64 },
  { "unsigned long long", PixelType::UInt64 },
  { "unsigned long long int", PixelType::UInt64 },
} };

/** Field names are told apart without regard to case and blanks: "data file" is "datafile". */
std::string
CanonicalName(const std::string & name)
{
  std::string canonical = ToLower(name);
  canonical.erase(std::remove(canonical.begin(), canonical.end(), ' '), canonical.end());
  return canonical;
}

HeaderFields
ReadFields(const std::filesystem::path & fileName)
{
  HeaderLines  lines(fileName, MaximumBytesPerLine);
  HeaderFields fields;
  std::string  line;
  if (!lines.Next(line) || line.size() != 8 || line.compare(0, 7, "NRRD000") != 0)
  {
    RefuseHeader(fileName, "it does not begin with 'NRRD000', as a NRRD file does");
  }
  while (lines.GetPosition() < MaximumBytesOfHeader && lines.Next(line))
  {
    if (line.empty())
    {
      fields.endOfHeader = lines.GetPosition();
      return fields;
    }
    const size_t separator = line.find(':');
    if (line.front() == '#' || (separator != std::string::npos && line.compare(separator, 2, ":=") == 0))
    {
      continue;
    }
    if (separator == std::string::npos)
    {
      RefuseHeader(fileName, "line " + std::to_string(lines.GetLineNumber()) + " of its header is not 'field: value'");
    }
    fields.values[CanonicalName(line.substr(0, separator))] = Trim(line.substr(separator + 1));
  }
  if (lines.GetPosition() >= MaximumBytesOfHeader)
  {
    RefuseHeader(fileName, "its header is longer than " + FormatBytes(MaximumBytesOfHeader));
  }
  // A detached header may end with the file instead of an empty line.
  fields.endOfHeader = lines.GetPosition();
  return fields;
}

/** Axes of voxel components are told by their kind. */
void
RefuseComponents(const std::filesystem::path & fileName, const HeaderFields & fields, size_t dimension)
{
  const std::vector<std::string> kinds = SplitAtBlanks(fields.Find("kinds").value_or(""));
  for (const std::string & kind : kinds)
  {
    const std::string lower = ToLower(kind);
    if (lower != "domain" && lower != "space" && lower != "none" && lower != "???")
    {
      RefuseHeader(fileName,
                   "an axis is of the kind '" + kind + "'; only one value per voxel is read, not vectors or colors");
    }
  }
  if (dimension < 2 || dimension > 3)
  {
    RefuseHeader(fileName,
                 "dimension is " + std::to_string(dimension) + "; only volumes with 2 or 3 dimensions are read");
  }
}

PixelType
ReadPixelType(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::string name = ToLower(RequireField(fileName, fields, "type"));
  const auto        matches = [&name](const auto & entry) { return name == entry.first; };
  const auto        found = std::find_if(TypeNames.begin(), TypeNames.end(), matches);
  if (found != TypeNames.end())
  {
    return found->second;
  }
  const auto foundLong = std::find_if(LongTypeNames.begin(), LongTypeNames.end(), matches);
  if (foundLong != LongTypeNames.end())
  {
    return foundLong->second;
  }
  RefuseHeader(fileName, "type is '" + name + "'; only scalar whole numbers and reals of 1 to 8 bytes are read");
}

std::int64_t
ReadSkip(const std::filesystem::path & fileName,
         const HeaderFields &          fields,
         const std::string &           name,
         std::int64_t                  least)
{
  const std::string                 text = fields.Find(name).value_or("0");
  const std::optional<std::int64_t> value = ParseInteger(text);
  if (!value || *value < least)
  {
    RefuseHeader(fileName,
                 name + " is '" + text + "'; it must be a whole number from " + std::to_string(least) + " on");
  }
  return *value;
}

std::uint64_t
SkipLines(const VolumeHeader & header, std::uint64_t offset, std::int64_t numberOfLines)
{
  std::ifstream file = OpenRegularFile(header.dataFile);
  file.seekg(static_cast<std::streamoff>(offset));
  for (std::int64_t line = 0; line < numberOfLines; ++line)
  {
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!file.good())
    {
      RefuseHeader(header.fileName,
                   "line skip is " + std::to_string(numberOfLines) + ", more lines than its data have");
    }
  }
  return static_cast<std::uint64_t>(file.tellg());
}

void
LocateVoxels(VolumeHeader & header, const HeaderFields & fields)
{
  const std::int64_t byteSkip = ReadSkip(header.fileName, fields, "byteskip", header.compressed ? 0 : -1);
  const std::int64_t lineSkip = ReadSkip(header.fileName, fields, "lineskip", 0);
  header.dataOffset = header.dataFile == header.fileName ? fields.endOfHeader : 0;
  if (byteSkip == -1)
  {
    header.dataOffset = header.dataFileSize < header.GetVoxelBytes() ? 0 : header.dataFileSize - header.GetVoxelBytes();
    return;
  }
  if (lineSkip > 0)
  {
    header.dataOffset = SkipLines(header, header.dataOffset, lineSkip);
  }
  // Bytes are skipped in the unpacked data.
  (header.compressed ? header.skipAfterInflation : header.dataOffset) += static_cast<std::uint64_t>(byteSkip);
}

bool
ReadByteOrder(const std::filesystem::path & fileName, const HeaderFields & fields, PixelType type)
{
  if (GetTraits(type).bytes == 1)
  {
    return itk::ByteSwapper<int>::SystemIsBigEndian();
  }
  const std::string endian = ToLower(RequireField(fileName, fields, "endian"));
  if (endian != "big" && endian != "little")
  {
    RefuseHeader(fileName, "endian is '" + endian + "'; it must be little or big");
  }
  return endian == "big";
}

std::filesystem::path
LocateDataFile(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::optional<std::string> name = fields.Find("datafile");
  if (!name)
  {
    return fileName;
  }
  if (name->empty() || ToLower(*name).rfind("list", 0) == 0 || name->find('%') != std::string::npos)
  {
    RefuseHeader(fileName, "data file is '" + *name + "'; voxels spread over several files are not read");
  }
  return fileName.parent_path() / *name;
}

} // namespace

VolumeHeader
ReadNrrdHeader(const std::filesystem::path & fileName)
{
  const HeaderFields                fields = ReadFields(fileName);
  const std::string                 dimensionText = RequireField(fileName, fields, "dimension");
  const std::optional<std::int64_t> dimension = ParseInteger(dimensionText);
  if (!dimension || *dimension < 1 || *dimension > 16)
  {
    RefuseHeader(fileName, "dimension is '" + dimensionText + "'; only volumes with 2 or 3 dimensions are read");
  }
  const auto axes = static_cast<size_t>(*dimension);
  RefuseComponents(fileName, fields, axes);

  VolumeHeader header;
  header.fileName = fileName;
  header.format = "NRRD";
  header.geometry.size = ParseSizes(fileName, "sizes", RequireField(fileName, fields, "sizes"), axes);
  ReadNrrdGeometry(header, fields);
  header.pixelType = ReadPixelType(fileName, fields);
  header.bigEndian = ReadByteOrder(fileName, fields, header.pixelType);
  const std::string encoding = ToLower(RequireField(fileName, fields, "encoding"));
  if (encoding != "raw" && encoding != "gzip" && encoding != "gz")
  {
    RefuseHeader(fileName, "encoding is '" + encoding + "'; only raw and gzip are read");
  }
  header.compressed = encoding != "raw";
  header.dataFile = LocateDataFile(fileName, fields);
  header.dataFileSize = GetDataFileSize(fileName, header.dataFile);
  LocateVoxels(header, fields);
  return header;
}

} // end namespace medialvoxel
