// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelHeaderText.h"
#include "itkMedialVoxelNrrdHeaderPrivate.h"
#include "itkMedialVoxelText.h"

#include <cctype>
#include <limits>
#include <optional>

namespace itk
{

using namespace MedialVoxelText;

namespace
{

// A short header must not make a long list of names.
constexpr std::uint64_t MaximumDataFiles = std::uint64_t{ 1 } << 16;
constexpr unsigned int  MaximumDigitsOfWidth = 3;

/** \class FileNamePattern
 * \brief A file name with the place of a number in it, for example "slice%03d.raw". */
class FileNamePattern
{
public:
  /** Nothing when the text has no place for a number. */
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
    return ReadNrrdWholeNumber(fileName, "a number of the data files", parts[part], -limit, limit);
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
  if (files > MaximumDataFiles)
  {
    RefuseHeader(fileName,
                 "data file names " + std::to_string(files) + " files; there may be " +
                   std::to_string(MaximumDataFiles));
  }
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

std::string
DescribeVoxels(const MedialVoxelNrrdHeader & header)
{
  std::string text =
    Join(header.size, " x ", [](std::uint64_t value) { return std::to_string(value); }) + " voxels of ";
  return text + (header.componentKind.empty() ? "" : std::to_string(header.numberOfComponents) + " ") +
         header.componentType;
}

} // namespace

std::int64_t
ReadNrrdWholeNumber(const std::filesystem::path & fileName,
                    const std::string &           name,
                    const std::string &           text,
                    std::int64_t                  least,
                    std::int64_t                  greatest)
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

bool
IsNrrdFileList(const std::string & dataFile)
{
  return dataFile.rfind("LIST", 0) == 0 && (dataFile.size() == 4 || dataFile[4] == ' ' || dataFile[4] == '\t');
}

std::vector<std::filesystem::path>
ListNrrdDataFiles(const MedialVoxelNrrdHeader &      header,
                  const std::vector<std::string> &   listedFiles,
                  const std::vector<std::uint64_t> & sizes)
{
  const std::filesystem::path & fileName = header.fileName;
  const auto                    field = header.fields.find("datafile");
  if (field == header.fields.end())
  {
    return { fileName };
  }
  const std::string & dataFile = field->second;
  if (dataFile.empty() || dataFile == "-")
  {
    RefuseHeader(fileName, "data file is '" + dataFile + "'; it must be the name of a file");
  }
  std::vector<std::filesystem::path> names{ dataFile };
  const std::vector<std::string>     parts = SplitAtBlanks(dataFile);
  const bool                         isList = IsNrrdFileList(dataFile);
  // A pattern is one only with numbers after it.
  const bool isPattern = !isList && parts.size() > 1 && FileNamePattern::Find(parts[0]);
  if (isList || isPattern)
  {
    const size_t partsBeforeDimension = isList ? 1 : 4;
    names = isList ? std::vector<std::filesystem::path>(listedFiles.begin(), listedFiles.end())
                   : ExpandPattern(fileName, dataFile);
    const auto axes = static_cast<std::int64_t>(sizes.size());
    const auto axesPerFile =
      parts.size() > partsBeforeDimension
        ? ReadNrrdWholeNumber(fileName, "the dimension of the data files", parts[partsBeforeDimension], 1, axes)
        : axes - 1;
    CheckNumberOfFiles(fileName, sizes, static_cast<size_t>(axesPerFile), names.size());
  }
  for (std::filesystem::path & name : names)
  {
    name = FindDataFile(fileName, name.string());
  }
  return names;
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
