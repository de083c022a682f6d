// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffFile.h"

#include <array>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MaximumEntries = std::uint64_t{ 1 } << 16;

/** Bytes of one value of a type, by its number in the format; 0 for types that are not read. */
unsigned int
GetBytesOfType(unsigned int type)
{
  constexpr std::array<unsigned int, 17> bytes{ 0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 0, 0, 0, 8 };
  return type < bytes.size() ? bytes[type] : 0;
}

} // namespace

TiffFile::TiffFile(const std::filesystem::path & fileName)
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

void
TiffFile::Refuse(const std::string & what) const
{
  RefuseHeader(m_FileName, what);
}

bool
TiffFile::ReadNextDirectory(TiffDirectory & directory)
{
  const bool isFirst = m_DirectoryOffsets.empty();
  if (isFirst)
  {
    m_NextDirectory = this->ReadOffset(m_IsBig ? 8 : 4);
  }
  if (m_NextDirectory == 0 && !isFirst)
  {
    return false;
  }
  if (!m_DirectoryOffsets.insert(m_NextDirectory).second || m_DirectoryOffsets.size() > MaximumTiffSlices)
  {
    this->Refuse("its directories form a circle, or are more than " + std::to_string(MaximumTiffSlices));
  }
  if (m_NextDirectory == 0)
  {
    this->Refuse("it has no directory");
  }
  directory = this->ReadDirectory(m_NextDirectory);
  return true;
}

std::vector<std::uint64_t>
TiffFile::GetNumbers(const TiffDirectory & directory, TiffTag tag, const std::vector<std::uint64_t> & preset)
{
  const auto found = directory.find(tag);
  if (found == directory.end())
  {
    return preset;
  }
  const TiffEntry &          entry = found->second;
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

std::uint64_t
TiffFile::GetNumber(const TiffDirectory & directory, TiffTag tag, std::optional<std::uint64_t> preset)
{
  const auto numbers =
    this->GetNumbers(directory, tag, preset ? std::vector<std::uint64_t>{ *preset } : std::vector<std::uint64_t>{});
  if (numbers.size() != 1)
  {
    this->Refuse("its tag " + std::to_string(tag) + " has " + std::to_string(numbers.size()) + " values, not 1");
  }
  return numbers.front();
}

double
TiffFile::GetRatio(const TiffDirectory & directory, TiffTag tag)
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
TiffFile::GetText(const TiffDirectory & directory, TiffTag tag)
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

BinaryHeader
TiffFile::ReadBytes(std::uint64_t offset, std::uint64_t count)
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
TiffFile::ReadOffset(std::uint64_t offset)
{
  return m_IsBig ? this->ReadBytes(offset, 8).Get<std::uint64_t>(0) : this->ReadBytes(offset, 4).Get<std::uint32_t>(0);
}

TiffDirectory
TiffFile::ReadDirectory(std::uint64_t & offset)
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
  TiffDirectory       directory;
  for (std::uint64_t at = 0; at < count * bytesOfEntry; at += bytesOfEntry)
  {
    TiffEntry entry;
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
TiffFile::ReadValues(const TiffEntry & entry, unsigned int bytesPerValue)
{
  if (bytesPerValue == 0 || entry.count > m_Size / bytesPerValue)
  {
    this->Refuse("a tag has " + std::to_string(entry.count) + " values of the type " + std::to_string(entry.type));
  }
  return this->ReadBytes(entry.offset, entry.count * bytesPerValue);
}

} // end namespace medialvoxel
