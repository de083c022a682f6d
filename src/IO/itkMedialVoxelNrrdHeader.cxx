// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNrrdHeader.h"

#include "itkMedialVoxelHeaderText.h"
#include "itkMedialVoxelNrrdHeaderPrivate.h"
#include "itkMedialVoxelText.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace itk
{

using namespace MedialVoxelText;

namespace
{

constexpr size_t        MaximumLineLength = size_t{ 1 } << 20;
constexpr std::uint64_t MaximumBytesOfHeader = std::uint64_t{ 1 } << 24;
constexpr std::uint64_t MaximumLines = std::uint64_t{ 1 } << 17;
constexpr std::int64_t  MaximumAxes = 16;

/** Kinds of axes of components; the masked one, whose mask is no component, is not among them. */
constexpr std::array<const char *, 25> ComponentKinds{ { "list",
                                                         "point",
                                                         "vector",
                                                         "covariant-vector",
                                                         "normal",
                                                         "stub",
                                                         "scalar",
                                                         "complex",
                                                         "2-vector",
                                                         "3-color",
                                                         "RGB-color",
                                                         "HSV-color",
                                                         "XYZ-color",
                                                         "4-color",
                                                         "RGBA-color",
                                                         "3-vector",
                                                         "3-gradient",
                                                         "3-normal",
                                                         "4-vector",
                                                         "quaternion",
                                                         "2D-matrix",
                                                         "2D-masked-matrix",
                                                         "3D-matrix",
                                                         "2D-symmetric-matrix",
                                                         "3D-symmetric-matrix" } };
constexpr std::array<const char *, 3>  UnreadKinds{
   { "2D-masked-symmetric-matrix", "3D-masked-symmetric-matrix", "3D-masked-matrix" }
};
constexpr std::array<const char *, 5> DomainKinds{ { "domain", "space", "time", "none", "???" } };

struct ComponentTypeName
{
  const char * name;
  const char * type;
  unsigned int bytes;
};

// The names of the format's definition.
constexpr std::array<ComponentTypeName, 40> TypeNames{ {
  { "signed char", "int8", 1 },
  { "int8", "int8", 1 },
  { "int8_t", "int8", 1 },
  { "uchar", "uint8", 1 },
  { "unsigned char", "uint8", 1 },
  { "uint8", "uint8", 1 },
  { "uint8_t", "uint8", 1 },
  { "short", "int16", 2 },
  { "short int", "int16", 2 },
  { "signed short", "int16", 2 },
  { "signed short int", "int16", 2 },
  { "int16", "int16", 2 },
  { "int16_t", "int16", 2 },
  { "ushort", "uint16", 2 },
  { "unsigned short", "uint16", 2 },
  { "unsigned short int", "uint16", 2 },
  { "uint16", "uint16", 2 },
  { "uint16_t", "uint16", 2 },
  { "int", "int32", 4 },
  { "signed int", "int32", 4 },
  { "int32", "int32", 4 },
  { "int32_t", "int32", 4 },
  { "uint", "uint32", 4 },
  { "unsigned int", "uint32", 4 },
  { "uint32", "uint32", 4 },
  { "uint32_t", "uint32", 4 },
  { "longlong", "int64", 8 },
  { "long long", "int64", 8 },
  { "long long int", "int64", 8 },
  { "signed long long", "int64", 8 },
  { "signed long long int", "int64", 8 },
  { "int64", "int64", 8 },
  { "int64_t", "int64", 8 },
  { "ulonglong", "uint64", 8 },
  { "unsigned long long", "uint64", 8 },
  { "unsigned long long int", "uint64", 8 },
  { "uint64", "uint64", 8 },
  { "uint64_t", "uint64", 8 },
  { "float", "float32", 4 },
  { "double", "float64", 8 },
} };

/** The name as the format writes it, whatever the case; nothing when it is not among them. */
template <size_t VCount>
std::optional<std::string>
FindName(const std::array<const char *, VCount> & names, const std::string & name)
{
  const auto found =
    std::find_if(names.begin(), names.end(), [&name](const char * entry) { return ToLower(entry) == ToLower(name); });
  return found == names.end() ? std::nullopt : std::optional<std::string>(*found);
}

/** The text of a header, not yet understood. */
struct HeaderText
{
  HeaderFields                       fields;
  std::map<std::string, std::string> keyValues;
  std::vector<std::string>           listedFiles;
};

/** Field names are compared without case and blanks: "data file" is "datafile". */
std::string
CanonicalName(const std::string & name)
{
  std::string canonical = ToLower(name);
  canonical.erase(std::remove(canonical.begin(), canonical.end(), ' '), canonical.end());
  return canonical;
}

/** Keys and values write line ends and backslashes as "\n" and "\\". */
std::string
Unescape(const std::string & text)
{
  std::string plain;
  for (size_t position = 0; position < text.size(); ++position)
  {
    const bool isEscape = text[position] == '\\' && position + 1 < text.size();
    if (isEscape && (text[position + 1] == 'n' || text[position + 1] == '\\'))
    {
      ++position;
      plain.push_back(text[position] == 'n' ? '\n' : '\\');
    }
    else
    {
      plain.push_back(text[position]);
    }
  }
  return plain;
}

void
ReadLine(const HeaderLines & lines, const std::filesystem::path & fileName, const std::string & line, HeaderText & text)
{
  const size_t separator = line.find(':');
  if (line.front() == '#')
  {
    return;
  }
  if (separator == std::string::npos)
  {
    RefuseHeader(fileName, "line " + std::to_string(lines.GetLineNumber()) + " of its header is not 'field: value'");
  }
  if (line.compare(separator, 2, ":=") == 0)
  {
    text.keyValues[Unescape(line.substr(0, separator))] = Unescape(line.substr(separator + 2));
    return;
  }
  const std::string name = CanonicalName(line.substr(0, separator));
  if (!text.fields.values.emplace(name, Trim(line.substr(separator + 1))).second)
  {
    RefuseHeader(fileName, "its header has the field " + line.substr(0, separator) + " twice");
  }
}

HeaderText
ReadText(const std::filesystem::path & fileName)
{
  HeaderLines lines(fileName, MaximumLineLength);
  HeaderText  text;
  std::string line;
  if (!lines.Next(line) || line.size() != 8 || line.compare(0, 7, "NRRD000") != 0)
  {
    RefuseHeader(fileName, "it does not begin with 'NRRD000', as a NRRD file does");
  }
  bool inList = false;
  while (lines.GetPosition() < MaximumBytesOfHeader && lines.GetLineNumber() < MaximumLines && lines.Next(line))
  {
    if (line.empty())
    {
      text.fields.endOfHeader = lines.GetPosition();
      return text;
    }
    if (inList)
    {
      text.listedFiles.push_back(line);
      continue;
    }
    ReadLine(lines, fileName, line, text);
    inList = IsNrrdFileList(text.fields.Find("datafile").value_or(""));
  }
  if (lines.GetPosition() >= MaximumBytesOfHeader)
  {
    RefuseHeader(fileName, "its header is longer than " + std::to_string(MaximumBytesOfHeader) + " bytes");
  }
  if (lines.GetLineNumber() >= MaximumLines)
  {
    RefuseHeader(fileName, "its header has more than " + std::to_string(MaximumLines) + " lines");
  }
  // A detached header may end with the file instead of an empty line.
  text.fields.endOfHeader = lines.GetPosition();
  return text;
}

[[noreturn]] void
RefuseDimension(const std::filesystem::path & fileName, const std::string & text, HeaderError::Kind kind)
{
  RefuseHeader(fileName,
               "dimension is '" + text +
                 "'; only volumes with 2 or 3 dimensions are read, beside which one axis may be one of components",
               kind);
}

/** Number of axes of the file. */
size_t
ReadDimension(const std::filesystem::path & fileName, const HeaderFields & fields)
{
  const std::string                 text = RequireField(fileName, fields, "dimension");
  const std::optional<std::int64_t> dimension = ParseInteger(text);
  if (!dimension || *dimension < 1 || *dimension > MaximumAxes)
  {
    RefuseDimension(fileName, text, HeaderError::Kind::Corrupt);
  }
  return static_cast<size_t>(*dimension);
}

/** Leaves out axes of length 1 behind the third axis of space, with the values that fields have for them.
 * \return the number of axes that are left */
size_t
DropAxesBeyondSpace(HeaderFields & fields, size_t axes)
{
  constexpr std::array<const char *, 9> perAxis{
    { "sizes", "kinds", "spacings", "thicknesses", "axismins", "axismaxs", "centers", "centerings", "spacedirections" }
  };
  const std::vector<std::string> kinds = SplitAtBlanks(fields.Find("kinds").value_or(""));
  const size_t                   most = 3 + (!kinds.empty() && FindName(ComponentKinds, kinds.front()) ? 1 : 0);
  const auto                     isOne = [&fields] {
    const std::vector<std::string> sizes = SplitAtBlanks(fields.Find("sizes").value_or(""));
    return !sizes.empty() && sizes.back() == "1";
  };
  for (; axes > most && isOne(); --axes)
  {
    for (const char * const name : perAxis)
    {
      const auto field = fields.values.find(name);
      if (field != fields.values.end())
      {
        std::string & text = field->second;
        const size_t  begin = text.find_last_of(!text.empty() && text.back() == ')' ? "(" : " \t");
        text = begin == std::string::npos ? "" : Trim(text.substr(0, begin));
      }
    }
  }
  return axes;
}

/** The kind of the first axis if it is one of components; there may be no other. */
std::string
ReadComponentKind(const std::filesystem::path & fileName, const HeaderFields & fields, size_t axes)
{
  const std::vector<std::string> kinds = SplitAtBlanks(fields.Find("kinds").value_or(""));
  if (fields.Find("kinds") && kinds.size() != axes)
  {
    RefuseHeader(fileName, "kinds has " + std::to_string(kinds.size()) + " values, not " + std::to_string(axes));
  }
  std::string componentKind;
  for (size_t axis = 0; axis < kinds.size(); ++axis)
  {
    const std::optional<std::string> components = FindName(ComponentKinds, kinds[axis]);
    if (FindName(UnreadKinds, kinds[axis]) || (components && axis > 0))
    {
      RefuseHeader(fileName,
                   "axis " + std::to_string(axis) + " is of the kind '" + kinds[axis] +
                     "'; components are read when they are the first axis and without a mask",
                   HeaderError::Kind::Unsupported);
    }
    if (!components && !FindName(DomainKinds, kinds[axis]))
    {
      RefuseHeader(fileName, "an axis is of the kind '" + kinds[axis] + "', which the format does not define");
    }
    componentKind = components.value_or(componentKind);
  }
  const size_t axesOfSpace = axes - (componentKind.empty() ? 0 : 1);
  if (axesOfSpace < 2 || axesOfSpace > 3)
  {
    RefuseDimension(fileName, std::to_string(axes), HeaderError::Kind::Unsupported);
  }
  return componentKind;
}

void
ReadComponentType(MedialVoxelNrrdHeader & header, const HeaderFields & fields)
{
  const std::string name = ToLower(RequireField(header.fileName, fields, "type"));
  const auto        found = std::find_if(
    TypeNames.begin(), TypeNames.end(), [&name](const ComponentTypeName & entry) { return name == entry.name; });
  if (found == TypeNames.end())
  {
    RefuseHeader(header.fileName,
                 "type is '" + name + "'; only scalar whole numbers and reals of 1 to 8 bytes are read",
                 name == "block" ? HeaderError::Kind::Unsupported : HeaderError::Kind::Corrupt);
  }
  header.componentType = found->type;
  header.bytesPerComponent = found->bytes;
}

bool
ReadByteOrder(const MedialVoxelNrrdHeader & header, const HeaderFields & fields)
{
  if (header.bytesPerComponent == 1)
  {
    return MachineIsBigEndian();
  }
  const std::string endian = ToLower(RequireField(header.fileName, fields, "endian"));
  if (endian != "big" && endian != "little")
  {
    RefuseHeader(header.fileName, "endian is '" + endian + "'; it must be little or big");
  }
  return endian == "big";
}

} // namespace

std::uint64_t
MedialVoxelNrrdHeader::GetNumberOfBytes() const
{
  std::uint64_t bytes = bytesPerComponent * numberOfComponents;
  for (const std::uint64_t extent : size)
  {
    bytes *= extent;
  }
  return bytes;
}

MedialVoxelNrrdHeader
ReadMedialVoxelNrrdHeader(const std::filesystem::path & fileName)
{
  HeaderText           text = ReadText(fileName);
  const HeaderFields & fields = text.fields;
  const size_t         axes = DropAxesBeyondSpace(text.fields, ReadDimension(fileName, fields));

  MedialVoxelNrrdHeader header;
  header.fileName = fileName;
  header.fields = fields.values;
  header.keyValues = text.keyValues;
  header.endOfHeader = fields.endOfHeader;
  header.componentKind = ReadComponentKind(fileName, fields, axes);
  header.size = ParseSizes(fileName, "sizes", RequireField(fileName, fields, "sizes"), axes);
  const std::vector<std::uint64_t> sizes = header.size;
  if (!header.componentKind.empty())
  {
    constexpr std::uint64_t maximumComponents = std::numeric_limits<std::uint32_t>::max();
    if (sizes.front() > maximumComponents)
    {
      RefuseHeader(fileName, "sizes has " + std::to_string(sizes.front()) + " components, more than there may be");
    }
    header.numberOfComponents = sizes.front();
    header.size.erase(header.size.begin());
  }
  ReadMedialVoxelNrrdGeometry(header);
  ReadComponentType(header, fields);
  header.bigEndian = ReadByteOrder(header, fields);
  header.encoding = ToLower(RequireField(fileName, fields, "encoding"));
  header.dataFiles = ListNrrdDataFiles(header, text.listedFiles, sizes);
  header.lineSkip =
    static_cast<std::uint64_t>(ReadNrrdWholeNumber(fileName, "line skip", fields.Find("lineskip").value_or("0"), 0));
  header.byteSkip = ReadNrrdWholeNumber(fileName, "byte skip", fields.Find("byteskip").value_or("0"), -1);
  return header;
}

std::string
FindMedialVoxelNrrdEncoding(const std::filesystem::path & fileName)
{
  constexpr std::string_view field = "encoding:";
  HeaderLines                lines(fileName, MaximumLineLength);
  std::string                line;
  try
  {
    while (lines.GetPosition() < MaximumBytesOfHeader && lines.Next(line) && !line.empty())
    {
      if (ToLower(line).rfind(field, 0) == 0)
      {
        return ToLower(Trim(line.substr(field.size())));
      }
    }
  }
  catch (const HeaderError & error)
  {
    if (error.GetKind() == HeaderError::Kind::Unreadable)
    {
      throw;
    }
  }
  return {};
}

} // end namespace itk
