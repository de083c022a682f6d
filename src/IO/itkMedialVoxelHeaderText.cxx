// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelHeaderText.h"

#include "itkMedialVoxelText.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>

namespace itk
{
namespace MedialVoxelText
{
namespace
{

template <typename... TParts>
[[noreturn]] void
Fail(HeaderError::Kind kind, const TParts &... parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw HeaderError(kind, message.str());
}

/** Keeps a message readable when a header has long values. */
std::string
Shorten(const std::string & text)
{
  constexpr size_t longest = 400;
  constexpr size_t beginning = 200;
  constexpr size_t end = 150;
  return text.size() <= longest ? text : text.substr(0, beginning) + " ... " + text.substr(text.size() - end);
}

/** Whether the byte at \a position begins one of the control characters from U+0080 to U+009F. */
bool
IsLongControl(const std::string & text, size_t position)
{
  const auto byte = [&text](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  return byte(position) == 0xc2 && byte(position + 1) >= 0x80 && byte(position + 1) <= 0x9f;
}

const char *
NameKind(const std::filesystem::file_type type)
{
  switch (type)
  {
    case std::filesystem::file_type::directory:
      return "a folder";
    case std::filesystem::file_type::fifo:
      return "a pipe";
    case std::filesystem::file_type::socket:
      return "a socket";
    default:
      return "a device";
  }
}

} // namespace

std::string
MakePrintable(std::string text)
{
  for (size_t i = 0; i < text.size(); ++i)
  {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (IsLongControl(text, i))
    {
      text.replace(i, 2, "?");
    }
    else if (byte < 0x20 || byte == 0x7f)
    {
      text[i] = '?';
    }
  }
  return text;
}

HeaderError::HeaderError(Kind kind, const std::string & message)
  : std::runtime_error(MakePrintable(message))
  , m_Kind(kind)
{}

std::optional<std::string>
HeaderFields::Find(const std::string & name) const
{
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : std::optional<std::string>(found->second);
}

std::ifstream
OpenRegularFile(const std::filesystem::path & fileName)
{
  std::error_code error;
  const auto      status = std::filesystem::status(fileName, error);
  if (!std::filesystem::exists(status))
  {
    const bool        isMissing = status.type() == std::filesystem::file_type::not_found;
    const std::string reason = isMissing ? "no such file" : error.message();
    Fail(HeaderError::Kind::Unreadable, "cannot open ", fileName.string(), ": ", reason);
  }
  if (!std::filesystem::is_regular_file(status))
  {
    Fail(HeaderError::Kind::Unreadable,
         "cannot read ",
         fileName.string(),
         ": it is ",
         NameKind(status.type()),
         ", not a regular file");
  }
  std::ifstream file(fileName, std::ios::binary);
  if (!file.is_open())
  {
    Fail(HeaderError::Kind::Unreadable, "cannot open ", fileName.string(), ": ", std::strerror(errno));
  }
  return file;
}

HeaderLines::HeaderLines(const std::filesystem::path & fileName, std::uint64_t maximumLineLength)
  : m_FileName(fileName)
  , m_File(OpenRegularFile(fileName))
  , m_MaximumLineLength(maximumLineLength)
{}

bool
HeaderLines::Next(std::string & line)
{
  line.clear();
  char character = 0;
  while (m_File.get(character))
  {
    ++m_Position;
    if (character == '\n')
    {
      break;
    }
    if (character == '\0' || line.size() == m_MaximumLineLength)
    {
      Fail(HeaderError::Kind::Corrupt,
           m_FileName.string(),
           ": line ",
           m_LineNumber + 1,
           " is not a line of a header: it has ",
           character == '\0' ? "bytes that are not text"
                             : "more than " + std::to_string(m_MaximumLineLength) + " bytes");
    }
    line.push_back(character);
  }
  if (line.empty() && character != '\n')
  {
    return false;
  }
  ++m_LineNumber;
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  return true;
}

std::filesystem::path
FindDataFile(const std::filesystem::path & headerName, const std::string & name)
{
  const std::filesystem::path folder = headerName.parent_path();
  std::error_code             error;
  if (std::filesystem::exists(folder / name, error))
  {
    return folder / name;
  }
  // Windows writes umlauts as one byte, where the name of the file has two.
  std::string encoded;
  for (const char character : name)
  {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x80)
    {
      encoded.push_back(character);
      continue;
    }
    encoded.push_back(static_cast<char>(0xC0 | (byte >> 6)));
    encoded.push_back(static_cast<char>(0x80 | (byte & 0x3F)));
  }
  return folder / (std::filesystem::exists(folder / encoded, error) ? encoded : name);
}

std::uint64_t
GetDataFileSize(const std::filesystem::path & headerName, const std::filesystem::path & dataFile)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(dataFile, error))
  {
    RefuseHeader(headerName, "its data file " + dataFile.string() + " is missing");
  }
  const std::uintmax_t size = std::filesystem::file_size(dataFile, error);
  if (error)
  {
    Fail(HeaderError::Kind::Unreadable, "cannot read the size of ", dataFile.string(), ": ", error.message());
  }
  return size;
}

void
RefuseHeader(const std::filesystem::path & fileName, const std::string & what, HeaderError::Kind kind)
{
  Fail(kind, fileName.string(), ": ", Shorten(what));
}

std::string
RequireField(const std::filesystem::path & fileName, const HeaderFields & fields, const std::string & name)
{
  const std::optional<std::string> value = fields.Find(name);
  if (!value || value->empty())
  {
    RefuseHeader(fileName, "its header lacks the field " + name);
  }
  return *value;
}

std::vector<double>
ParseNumbers(const std::filesystem::path & fileName, const std::string & field, const std::string & text, size_t count)
{
  std::vector<double> numbers;
  for (const std::string & part : SplitAtBlanks(text))
  {
    const std::optional<double> value = ParseDouble(part);
    if (!value || !std::isfinite(*value))
    {
      RefuseHeader(fileName, field + " has the value '" + part + "'; each must be a finite number");
    }
    numbers.push_back(*value);
  }
  if (numbers.size() != count)
  {
    RefuseHeader(fileName, field + " has " + std::to_string(numbers.size()) + " values, not " + std::to_string(count));
  }
  return numbers;
}

std::vector<double>
ParseSpacings(const std::filesystem::path & fileName, const std::string & field, const std::string & text, size_t count)
{
  for (const std::string & part : SplitAtBlanks(text))
  {
    const std::optional<double> value = ParseDouble(part);
    if (!value || !std::isfinite(*value) || *value <= 0)
    {
      RefuseHeader(fileName, field + " has the value '" + part + "'; each must be a finite number greater than 0");
    }
  }
  return ParseNumbers(fileName, field, text, count);
}

std::vector<std::uint64_t>
ParseSizes(const std::filesystem::path & fileName, const std::string & field, const std::string & text, size_t count)
{
  constexpr std::uint64_t    maximumVoxels = std::uint64_t{ 1 } << 59; // times 8 bytes: still a valid file offset
  std::vector<std::uint64_t> sizes;
  std::uint64_t              product = 1;
  for (const std::string & part : SplitAtBlanks(text))
  {
    const std::optional<std::int64_t> value = ParseInteger(part);
    if (!value || *value < 1)
    {
      Fail(HeaderError::Kind::Corrupt,
           fileName.string(),
           ": ",
           field,
           " has the value '",
           part,
           "'; each must be a whole number from 1 on");
    }
    sizes.push_back(static_cast<std::uint64_t>(*value));
    if (sizes.back() > maximumVoxels / product)
    {
      Fail(
        HeaderError::Kind::Corrupt, fileName.string(), ": ", field, " '", text, "' is more voxels than any file holds");
    }
    product *= sizes.back();
  }
  if (sizes.size() != count)
  {
    Fail(HeaderError::Kind::Corrupt, fileName.string(), ": ", field, " has ", sizes.size(), " values, not ", count);
  }
  return sizes;
}

} // end namespace MedialVoxelText
} // end namespace itk
