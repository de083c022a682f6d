// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FormatRows.h"
#include "HeaderParsing.h"

#include "Text.h"
#include "VolumeText.h"

#include "itkByteSwapper.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{
namespace
{

constexpr size_t MaximumBytesPerLine = 1 << 16;
constexpr size_t MaximumLines = 100000;
constexpr size_t MaximumBytesOfHeader = 1 << 24;

HeaderFields
ReadFields(const std::filesystem::path & fileName)
{
  HeaderLines  lines(fileName, MaximumBytesPerLine);
  HeaderFields fields;
  std::string  line;
  while (lines.GetLineNumber() < MaximumLines && lines.GetPosition() < MaximumBytesOfHeader && lines.Next(line))
  {
    const size_t separator = line.find('=');
    if (separator == std::string::npos)
    {
      RefuseHeader(fileName, "line " + std::to_string(lines.GetLineNumber()) + " of its header is not 'name = value'");
    }
    const std::string name = Trim(line.substr(0, separator));
    fields.values[name] = Trim(line.substr(separator + 1));
    if (name == "ElementDataFile")
    {
      fields.endOfHeader = lines.GetPosition();
      return fields;
    }
  }
  RefuseHeader(fileName, "its header ends without the field ElementDataFile");
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
  RefuseHeader(fileName, name + " is '" + *value + "'; it must be True or False");
}

/** Number of axes of the file. */
size_t
ReadAxes(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  constexpr std::int64_t            mostAxes = 10; // of the format
  const std::string                 text = RequireField(fileName, fields, "NDims");
  const std::optional<std::int64_t> axes = ParseInteger(text);
  if (!axes || *axes < 2 || *axes > mostAxes)
  {
    RefuseHeader(fileName, "NDims is '" + text + "'; only volumes with 2 or 3 dimensions are read");
  }
  return static_cast<size_t>(*axes);
}

/** Without axes of length 1 behind the third axis. */
std::vector<std::uint64_t>
ReadSize(const std::filesystem::path & fileName, const HeaderFields & fields, const size_t axes)
{
  std::vector<std::string> sizes = SplitAtBlanks(RequireField(fileName, fields, "DimSize"));
  size_t                   dimension = axes;
  for (; dimension > 3 && sizes.size() == dimension && sizes.back() == "1"; --dimension)
  {
    sizes.pop_back();
  }
  if (dimension > 3)
  {
    RefuseHeader(fileName, "NDims is '" + std::to_string(axes) + "'; only volumes with 2 or 3 dimensions are read");
  }
  return ParseSizes(fileName, "DimSize", Join(sizes, " ", [](const std::string & size) { return size; }), dimension);
}

PixelType
ReadPixelType(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::string channels = fields.Find("ElementNumberOfChannels").value_or("1");
  if (channels != "1")
  {
    RefuseHeader(fileName, "its voxels have " + channels + " components; only one value per voxel is read");
  }
  std::string name = RequireField(fileName, fields, "ElementType");
  // MetaImage's long has 4 bytes on every machine.
  name = name == "MET_LONG" ? "MET_INT" : name == "MET_ULONG" ? "MET_UINT" : name;
  for (const PixelTypeTraits & traits : PixelTypes)
  {
    if (traits.metaName == name)
    {
      return traits.type;
    }
  }
  RefuseHeader(fileName, "ElementType is '" + name + "'; only scalar whole numbers and reals of 1 to 8 bytes are read");
}

/** Numbers of the field that is there, of several the last one; empty without any. */
std::vector<double>
ReadNumbers(const VolumeHeader &             header,
            const HeaderFields &             fields,
            const std::vector<std::string> & names,
            size_t                           count)
{
  std::vector<double> numbers;
  for (const std::string & name : names)
  {
    if (fields.Find(name))
    {
      numbers = ParseNumbers(header.fileName, name, *fields.Find(name), count);
    }
  }
  return numbers;
}

/** A rule of this format: without ElementSpacing, ElementSize is the spacing. */
std::vector<double>
ReadSpacing(const VolumeHeader & header, const HeaderFields & fields, const size_t axes)
{
  for (const char * const name : { "ElementSpacing", "ElementSize" })
  {
    if (fields.Find(name))
    {
      return ParseSpacings(header.fileName, name, *fields.Find(name), axes);
    }
  }
  return std::vector<double>(axes, 1.0);
}

void
ReadGeometry(VolumeHeader & header, const HeaderFields & fields, const size_t axes)
{
  const size_t dimension = header.geometry.size.size();
  header.geometry.spacing = ReadSpacing(header, fields, axes);
  header.geometry.spacing.resize(dimension);
  header.geometry.origin = ReadNumbers(header, fields, { "Offset", "Position", "Origin" }, axes);
  header.geometry.origin.resize(dimension, 0.0);
  const std::vector<double> matrix =
    ReadNumbers(header, fields, { "Orientation", "Rotation", "TransformMatrix" }, axes * axes);
  header.geometry.SetIdentityDirection();
  for (size_t axis = 0; axis < dimension && !matrix.empty(); ++axis)
  {
    std::copy_n(
      matrix.begin() + static_cast<std::ptrdiff_t>(axis * axes), dimension, header.geometry.direction[axis].begin());
  }
}

std::filesystem::path
LocateData(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::string name = RequireField(fileName, fields, "ElementDataFile");
  const std::string lower = ToLower(name);
  if (lower == "local")
  {
    return fileName;
  }
  const std::vector<std::string> words = SplitAtBlanks(name);
  // A pattern has a place for a number, and three numbers behind it.
  const bool isPattern =
    words.size() >= 4 && words.front().find('%') != std::string::npos &&
    std::all_of(words.end() - 3, words.end(), [](const std::string & word) { return ParseInteger(word); });
  if (isPattern || (!words.empty() && words.front() == "LIST"))
  {
    RefuseHeader(fileName, "ElementDataFile is '" + name + "'; voxels spread over several files are not read");
  }
  return FindDataFile(fileName, name);
}

/** HeaderSize is the offset of the voxels; -1 says that they end with the file. */
std::uint64_t
ReadDataOffset(const VolumeHeader & header, const HeaderFields & fields)
{
  const std::string                 text = fields.Find("HeaderSize").value_or("0");
  const std::optional<std::int64_t> offset = ParseInteger(text);
  if (!offset || *offset < -1 || (*offset == -1 && header.compressed))
  {
    RefuseHeader(header.fileName, "HeaderSize is '" + text + "'; it must be 0 or more, or -1 with uncompressed voxels");
  }
  if (*offset == -1)
  {
    return header.dataFileSize < header.GetDataSize() ? 0 : header.dataFileSize - header.GetDataSize();
  }
  if (*offset == 0)
  {
    return header.dataFile == header.fileName ? fields.endOfHeader : 0;
  }
  return static_cast<std::uint64_t>(*offset);
}

VolumeHeader
ReadMetaImageHeader(const std::filesystem::path & fileName)
{
  const HeaderFields fields = ReadFields(fileName);
  if (fields.Find("ObjectType").value_or("Image") != "Image")
  {
    RefuseHeader(fileName, "ObjectType is '" + *fields.Find("ObjectType") + "', not Image");
  }
  const size_t axes = ReadAxes(fileName, fields);
  if (!ReadFlag(fileName, fields, "BinaryData", true))
  {
    RefuseHeader(fileName, "its voxels are text (BinaryData = False); only binary voxels are read");
  }

  VolumeHeader header;
  header.fileName = fileName;
  header.geometry.size = ReadSize(fileName, fields, axes);
  ReadGeometry(header, fields, axes);
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

} // namespace

VolumeFormat
MakeMetaImageFormat()
{
  VolumeWriter writer;
  writer.makeHeader = MakeMetaImageText;
  writer.packsAsZlib = true;
  return { "MetaImage",
           { { ".mha", false, false, true }, { ".mhd", true, false, false, DetachedRemedy } },
           MakePlainInput(ReadMetaImageHeader),
           writer };
}

} // end namespace medialvoxel
