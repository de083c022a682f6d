// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNrrdHeader.h"

#include "itkMedialVoxelHeaderText.h"
#include "itkMedialVoxelNrrdHeaderPrivate.h"
#include "itkMedialVoxelText.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <optional>
#include <utility>

namespace itk
{

using namespace MedialVoxelText;

namespace
{

constexpr size_t        MaximumBytesPerLine = size_t{ 1 } << 20;
constexpr std::uint64_t MaximumBytesOfHeader = std::uint64_t{ 1 } << 24;
constexpr std::int64_t  MaximumAxes = 16;
constexpr std::uint64_t MaximumDataFiles = std::uint64_t{ 1 } << 20;
constexpr unsigned int  MaximumDigitsOfWidth = 3;

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

/** Field names are told apart without regard to case and blanks: "data file" is "datafile". */
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

bool
IsList(const std::string & dataFile)
{
  return dataFile.rfind("LIST", 0) == 0 && (dataFile.size() == 4 || dataFile[4] == ' ' || dataFile[4] == '\t');
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
  HeaderLines lines(fileName, MaximumBytesPerLine);
  HeaderText  text;
  std::string line;
  if (!lines.Next(line) || line.size() != 8 || line.compare(0, 7, "NRRD000") != 0)
  {
    RefuseHeader(fileName, "it does not begin with 'NRRD000', as a NRRD file does");
  }
  bool inList = false;
  while (lines.GetPosition() < MaximumBytesOfHeader && lines.Next(line))
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
    inList = IsList(text.fields.Find("datafile").value_or(""));
  }
  if (lines.GetPosition() >= MaximumBytesOfHeader)
  {
    RefuseHeader(fileName, "its header is longer than " + std::to_string(MaximumBytesOfHeader) + " bytes");
  }
  // A detached header may end with the file instead of an empty line.
  text.fields.endOfHeader = lines.GetPosition();
  return text;
}

std::int64_t
ReadWholeNumber(const std::filesystem::path & fileName,
                const std::string &           name,
                const std::string &           text,
                std::int64_t                  least,
                std::int64_t                  greatest = std::numeric_limits<std::int64_t>::max())
{
  const std::optional<std::int64_t> value = ParseInteger(text);
  if (!value || *value < least || *value > greatest)
  {
    const bool isOpen = greatest == std::numeric_limits<std::int64_t>::max();
    RefuseHeader(fileName,
                 name + " is '" + text + "'; it must be a whole number from " + std::to_string(least) +
                   (isOpen ? " on" : " to " + std::to_string(greatest)));
  }
  return *value;
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

/** \class FileNamePattern
 * \brief A file name with the place of a number in it, such as "slice%03d.raw". */
class FileNamePattern
{
public:
  /** Nothing when the text has no such place. */
  static std::optional<FileNamePattern>
  Find(const std::string & text)
  {
    for (size_t begin = text.find('%'); begin != std::string::npos; begin = text.find('%', begin + 1))
    {
      size_t end = begin + 1;
      while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])))
      {
        ++end;
      }
      if (end < text.size() && text[end] == 'd' && end - begin <= MaximumDigitsOfWidth)
      {
        return FileNamePattern(text, begin, end);
      }
    }
    return std::nullopt;
  }

  std::string
  GetName(std::int64_t number) const
  {
    std::string digits = std::to_string(number < 0 ? -number : number);
    std::string sign = number < 0 ? "-" : "";
    const auto  used = digits.size() + sign.size();
    const auto  fill = m_Width > used ? m_Width - used : 0;
    return m_Before + (m_HasZeros ? sign + std::string(fill, '0') : std::string(fill, ' ') + sign) + digits + m_After;
  }

private:
  FileNamePattern(const std::string & text, size_t begin, size_t end)
    : m_Before(text.substr(0, begin))
    , m_After(text.substr(end + 1))
    , m_HasZeros(text[begin + 1] == '0')
    , m_Width(begin + 1 == end ? 0 : std::stoul(text.substr(begin + 1, end - begin - 1)))
  {}

  std::string m_Before;
  std::string m_After;
  bool        m_HasZeros;
  size_t      m_Width;
};

/** "pattern first last step [dimension]". */
std::vector<std::filesystem::path>
ExpandPattern(const std::filesystem::path & fileName, const std::string & text)
{
  constexpr std::int64_t         limit = std::numeric_limits<std::int32_t>::max();
  const std::vector<std::string> parts = SplitAtBlanks(text);
  if (parts.size() < 4 || parts.size() > 5)
  {
    RefuseHeader(fileName,
                 "data file is '" + text + "'; a pattern must be followed by first number, last number and step");
  }
  const auto number = [&](size_t part) {
    return ReadWholeNumber(fileName, "a number of the data files", parts[part], -limit, limit);
  };
  const std::int64_t first = number(1);
  const std::int64_t last = number(2);
  const std::int64_t step = number(3);
  if (step == 0 || (last - first) * (step > 0 ? 1 : -1) < 0)
  {
    RefuseHeader(fileName, "data file is '" + text + "'; its step must lead from the first number to the last");
  }
  const auto count = static_cast<std::uint64_t>((last - first) / step) + 1;
  if (count > MaximumDataFiles)
  {
    RefuseHeader(fileName,
                 "data file is '" + text + "', which are " + std::to_string(count) + " files; there may be " +
                   std::to_string(MaximumDataFiles));
  }
  const std::optional<FileNamePattern> pattern = FileNamePattern::Find(parts[0]);
  if (!pattern)
  {
    RefuseHeader(fileName, "data file is '" + text + "'; the pattern must have no blanks");
  }
  std::vector<std::filesystem::path> names;
  for (std::uint64_t file = 0; file < count; ++file)
  {
    names.emplace_back(pattern->GetName(first + static_cast<std::int64_t>(file) * step));
  }
  return names;
}

/** Every file holds as many of the fastest axes as are given; all axes: an equal share of the slowest axis. */
void
CheckNumberOfFiles(const std::filesystem::path &      fileName,
                   const std::vector<std::uint64_t> & sizes,
                   size_t                             axesPerFile,
                   std::uint64_t                      files)
{
  std::uint64_t pieces = 1;
  for (size_t axis = axesPerFile; axis < sizes.size(); ++axis)
  {
    pieces *= sizes[axis];
  }
  const bool isShare = axesPerFile == sizes.size();
  if (files == 0 || (isShare ? sizes.back() % files != 0 : files != pieces))
  {
    RefuseHeader(fileName,
                 "data file names " + std::to_string(files) + " files; there must be " +
                   (isShare ? "a divisor of the " + std::to_string(sizes.back()) + " slices" : std::to_string(pieces)));
  }
}

std::vector<std::filesystem::path>
ListDataFiles(const std::filesystem::path & fileName, const HeaderText & text, const std::vector<std::uint64_t> & sizes)
{
  const std::optional<std::string> dataFile = text.fields.Find("datafile");
  if (!dataFile)
  {
    return { fileName };
  }
  if (dataFile->empty() || *dataFile == "-")
  {
    RefuseHeader(fileName, "data file is '" + *dataFile + "'; it must be the name of a file");
  }
  std::vector<std::filesystem::path> names{ *dataFile };
  const std::vector<std::string>     parts = SplitAtBlanks(*dataFile);
  const bool                         isList = IsList(*dataFile);
  // A pattern is one only with numbers after it.
  const bool isPattern = !isList && parts.size() > 1 && FileNamePattern::Find(parts[0]);
  if (isList || isPattern)
  {
    const size_t partsBeforeDimension = isList ? 1 : 4;
    names = isList ? std::vector<std::filesystem::path>(text.listedFiles.begin(), text.listedFiles.end())
                   : ExpandPattern(fileName, *dataFile);
    const auto axes = static_cast<std::int64_t>(sizes.size());
    const auto axesPerFile =
      parts.size() > partsBeforeDimension
        ? ReadWholeNumber(fileName, "the dimension of the data files", parts[partsBeforeDimension], 1, axes)
        : axes - 1;
    CheckNumberOfFiles(fileName, sizes, static_cast<size_t>(axesPerFile), names.size());
  }
  for (std::filesystem::path & name : names)
  {
    name = fileName.parent_path() / name;
  }
  return names;
}

std::string
DescribeVoxels(const MedialVoxelNrrdHeader & header)
{
  std::string text =
    Join(header.size, " x ", [](std::uint64_t value) { return std::to_string(value); }) + " voxels of ";
  return text + (header.componentKind.empty() ? "" : std::to_string(header.numberOfComponents) + " ") +
         header.componentType;
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
  const HeaderText     text = ReadText(fileName);
  const HeaderFields & fields = text.fields;
  const size_t         axes = ReadDimension(fileName, fields);

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
  header.dataFiles = ListDataFiles(fileName, text, sizes);
  header.lineSkip =
    static_cast<std::uint64_t>(ReadWholeNumber(fileName, "line skip", fields.Find("lineskip").value_or("0"), 0));
  header.byteSkip = ReadWholeNumber(fileName, "byte skip", fields.Find("byteskip").value_or("0"), -1);
  return header;
}

std::string
FindMedialVoxelNrrdEncoding(const std::filesystem::path & fileName)
{
  constexpr std::string_view field = "encoding:";
  HeaderLines                lines(fileName, MaximumBytesPerLine);
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

std::uint64_t
SkipMedialVoxelNrrdLines(const MedialVoxelNrrdHeader & header, const std::filesystem::path & dataFile)
{
  const std::uint64_t begin = header.IsAttached() ? header.endOfHeader : 0;
  if (header.lineSkip == 0)
  {
    return begin;
  }
  std::ifstream file = OpenRegularFile(dataFile);
  file.seekg(static_cast<std::streamoff>(begin));
  for (std::uint64_t line = 0; line < header.lineSkip; ++line)
  {
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!file.good())
    {
      RefuseHeader(header.fileName,
                   "line skip is " + std::to_string(header.lineSkip) + ", more lines than its data have");
    }
  }
  return static_cast<std::uint64_t>(file.tellg());
}

std::vector<MedialVoxelFileSegment>
LocateMedialVoxelNrrdVoxels(const MedialVoxelNrrdHeader & header)
{
  const std::uint64_t                 bytes = header.GetNumberOfBytes() / header.dataFiles.size();
  std::vector<MedialVoxelFileSegment> segments;
  for (const std::filesystem::path & dataFile : header.dataFiles)
  {
    const std::uint64_t fileSize = GetDataFileSize(header.fileName, dataFile);
    std::uint64_t       offset = 0;
    if (header.byteSkip >= 0)
    {
      offset = SkipMedialVoxelNrrdLines(header, dataFile) + static_cast<std::uint64_t>(header.byteSkip);
    }
    else if (fileSize >= bytes)
    {
      offset = fileSize - bytes;
    }
    if (fileSize < offset || fileSize - offset < bytes)
    {
      const bool isShare = header.dataFiles.size() > 1;
      RefuseHeader(dataFile,
                   "it has " + std::to_string(fileSize) + " bytes; " + (isShare ? "its share of " : "") +
                     DescribeVoxels(header) + " needs " + std::to_string(bytes) + " after " + std::to_string(offset) +
                     " bytes of header");
    }
    segments.push_back({ dataFile, offset, bytes });
  }
  return segments;
}

} // end namespace itk
