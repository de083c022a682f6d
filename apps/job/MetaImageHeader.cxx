// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"

#include "Text.h"

#include "itkByteSwapper.h"

#include <limits>

namespace medialvoxel
{
namespace
{

// ITK's reader of these headers copies names and texts into arrays of 255 bytes.
constexpr size_t MaximumBytesPerText = 254;
constexpr size_t MaximumBytesPerLine = 4096;
constexpr size_t MaximumLines = 100000;

[[noreturn]] void
Refuse(const std::filesystem::path & fileName, const std::string & what)
{
  Fail(ExitStatus::CorruptInput, fileName.string(), ": ", what);
}

HeaderFields
ReadFields(const std::filesystem::path & fileName)
{
  HeaderLines  lines(fileName, MaximumBytesPerLine);
  HeaderFields fields;
  std::string  line;
  while (lines.GetLineNumber() < MaximumLines && lines.Next(line))
  {
    const size_t separator = line.find('=');
    if (separator == std::string::npos)
    {
      Refuse(fileName, "line " + std::to_string(lines.GetLineNumber()) + " of its header is not 'name = value'");
    }
    const std::string name = Trim(line.substr(0, separator));
    const std::string value = Trim(line.substr(separator + 1));
    const bool        isText = SplitAtBlanks(value).size() != 0 && !ParseDouble(SplitAtBlanks(value).front());
    if (name.size() > MaximumBytesPerText || (isText && value.size() > MaximumBytesPerText))
    {
      Refuse(fileName,
             "line " + std::to_string(lines.GetLineNumber()) + " of its header is longer than " +
               std::to_string(MaximumBytesPerText) + " bytes");
    }
    fields.values[name] = value;
    if (name == "ElementDataFile")
    {
      fields.endOfHeader = lines.GetPosition();
      return fields;
    }
  }
  Refuse(fileName, "its header ends without the field ElementDataFile");
}

std::string
Require(const std::filesystem::path & fileName, const HeaderFields & fields, const std::string & name)
{
  const std::optional<std::string> value = fields.Find(name);
  if (!value || value->empty())
  {
    Refuse(fileName, "its header lacks the field " + name);
  }
  return *value;
}

bool
ReadFlag(const std::filesystem::path & fileName, const HeaderFields & fields, const std::string & name, bool preset)
{
  const std::optional<std::string> value = fields.Find(name);
  if (!value)
  {
    return preset;
  }
  const std::string lower = ToLower(*value);
  if (lower == "true" || lower == "1")
  {
    return true;
  }
  if (lower == "false" || lower == "0")
  {
    return false;
  }
  Refuse(fileName, name + " is '" + *value + "'; it must be True or False");
}

unsigned int
ReadDimension(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::string                 text = Require(fileName, fields, "NDims");
  const std::optional<std::int64_t> dimension = ParseInteger(text);
  if (!dimension || *dimension < 2 || *dimension > 3)
  {
    Refuse(fileName, "NDims is '" + text + "'; only volumes with 2 or 3 dimensions are read");
  }
  return static_cast<unsigned int>(*dimension);
}

PixelType
ReadPixelType(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::string channels = fields.Find("ElementNumberOfChannels").value_or("1");
  if (channels != "1")
  {
    Refuse(fileName, "its voxels have " + channels + " components; only one value per voxel is read");
  }
  std::string name = Require(fileName, fields, "ElementType");
  // MetaImage's long has 4 bytes on every machine.
  name = name == "MET_LONG" ? "MET_INT" : name == "MET_ULONG" ? "MET_UINT" : name;
  for (const PixelTypeTraits & traits : PixelTypes)
  {
    if (traits.metaName == name)
    {
      return traits.type;
    }
  }
  Refuse(fileName, "ElementType is '" + name + "'; only scalar whole numbers and reals of 1 to 8 bytes are read");
}

/** Numbers that ITK will read into arrays of the length that the dimension gives. */
void
CheckCounts(const std::filesystem::path & fileName, const HeaderFields & fields, unsigned int dimension)
{
  const auto check = [&](const std::string & name, size_t count) {
    const std::optional<std::string> text = fields.Find(name);
    if (!text)
    {
      return;
    }
    const std::vector<std::string> parts = SplitAtBlanks(*text);
    for (const std::string & part : parts)
    {
      const std::optional<double> value = ParseDouble(part);
      if (!value || !(std::abs(*value) <= std::numeric_limits<double>::max()))
      {
        Refuse(fileName, name + " has the value '" + part + "'; each must be a finite number");
      }
    }
    if (parts.size() != count)
    {
      Refuse(fileName, name + " has " + std::to_string(parts.size()) + " values, not " + std::to_string(count));
    }
  };
  for (const char * const name : { "Offset", "Position", "Origin", "CenterOfRotation" })
  {
    check(name, dimension);
  }
  for (const char * const name : { "TransformMatrix", "Rotation", "Orientation" })
  {
    check(name, size_t{ dimension } * dimension);
  }
  for (const char * const name : { "ElementSpacing", "ElementSize" })
  {
    if (fields.Find(name))
    {
      ParseSpacings(fileName, name, *fields.Find(name), dimension);
    }
  }
}

std::filesystem::path
LocateData(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::string name = Require(fileName, fields, "ElementDataFile");
  const std::string lower = ToLower(name);
  if (lower == "local")
  {
    return fileName;
  }
  if (lower.rfind("list", 0) == 0 || name.find('%') != std::string::npos)
  {
    Refuse(fileName, "ElementDataFile is '" + name + "'; voxels spread over several files are not read");
  }
  return fileName.parent_path() / name;
}

/** HeaderSize is the offset of the voxels; -1 says that they end with the file. */
std::uint64_t
ReadDataOffset(const VolumeHeader & header, const HeaderFields & fields)
{
  const std::string                 text = fields.Find("HeaderSize").value_or("0");
  const std::optional<std::int64_t> offset = ParseInteger(text);
  if (!offset || *offset < -1 || (*offset == -1 && header.compressed))
  {
    Refuse(header.fileName, "HeaderSize is '" + text + "'; it must be 0 or more, or -1 with uncompressed voxels");
  }
  if (*offset == -1)
  {
    return header.dataFileSize < header.GetVoxelBytes() ? 0 : header.dataFileSize - header.GetVoxelBytes();
  }
  if (*offset == 0)
  {
    return header.dataFile == header.fileName ? fields.endOfHeader : 0;
  }
  return static_cast<std::uint64_t>(*offset);
}

} // namespace

VolumeHeader
ReadMetaImageHeader(const std::filesystem::path & fileName)
{
  const HeaderFields fields = ReadFields(fileName);
  if (fields.Find("ObjectType").value_or("Image") != "Image")
  {
    Refuse(fileName, "ObjectType is '" + *fields.Find("ObjectType") + "', not Image");
  }
  const unsigned int dimension = ReadDimension(fileName, fields);
  CheckCounts(fileName, fields, dimension);
  if (!ReadFlag(fileName, fields, "BinaryData", true))
  {
    Refuse(fileName, "its voxels are text (BinaryData = False); only binary voxels are read");
  }

  VolumeHeader header;
  header.fileName = fileName;
  header.format = "MetaImage";
  header.geometry.size = ParseSizes(fileName, "DimSize", Require(fileName, fields, "DimSize"), dimension);
  header.pixelType = ReadPixelType(fileName, fields);
  const bool machineIsBigEndian = itk::ByteSwapper<int>::SystemIsBigEndian();
  header.bigEndian = ReadFlag(fileName, fields, "BinaryDataByteOrderMSB", machineIsBigEndian);
  header.bigEndian = ReadFlag(fileName, fields, "ElementByteOrderMSB", header.bigEndian);
  header.compressed = ReadFlag(fileName, fields, "CompressedData", false);
  header.dataFile = LocateData(fileName, fields);
  header.dataFileSize = GetDataFileSize(fileName, header.dataFile);
  header.dataOffset = ReadDataOffset(header, fields);
  return header;
}

} // end namespace medialvoxel
