// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputVolume.h"

#include "HeaderParsing.h"
#include "Text.h"

#include <regex>

namespace medialvoxel
{
namespace
{

/** Of such a volume, the page cache would keep what is not needed soon, in place of what is. */
constexpr std::uint64_t BytesOfLargeVolume = std::uint64_t{ 1 } << 29;

std::filesystem::path
DataName(const std::filesystem::path & headerName, unsigned int number)
{
  std::filesystem::path name = headerName;
  name.replace_extension();
  if (number > 0)
  {
    name += "-" + std::to_string(number);
  }
  name += ".raw";
  return name;
}

/** Only names that this class gives: other headers may share any other file. */
bool
IsNameOfOurs(const std::filesystem::path & dataName, const std::filesystem::path & headerName)
{
  const std::string stem = headerName.stem().string();
  const std::string name = dataName.filename().string();
  if (dataName.parent_path() != headerName.parent_path() || name.compare(0, stem.size(), stem) != 0)
  {
    return false;
  }
  return std::regex_match(name.substr(stem.size()), std::regex("(-[0-9]+)?\\.raw"));
}

} // namespace

OutputVolume::OutputVolume(const std::filesystem::path & fileName, bool overwrite, bool sparse)
  : m_Format(GetVolumeFormat(fileName))
  , m_Sparse(sparse)
  , m_Header(fileName, overwrite)
  , m_Data(DataName(m_Header.GetFileName(), 0), false)
{}

void
OutputVolume::Create(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  m_Geometry = geometry;
  m_Layout = layout;
  const std::uint64_t numberOfBytes = geometry.GetNumberOfVoxels() * layout.GetBytes();
  if (HasDataFile(m_Format))
  {
    // The header is written when the name of the voxels is known; its creation now shows that it can be.
    m_Header.Create(0, false);
    m_Data.Create(numberOfBytes, !m_Sparse);
    return;
  }
  const std::string text = MakeHeaderText(m_Format, geometry, layout, "");
  m_Offset = text.size();
  m_Header.Create(m_Offset + numberOfBytes, !m_Sparse);
  m_Header.WriteAt(0, text.data(), text.size());
}

void
OutputVolume::BypassPageCacheWhenLarge()
{
  OutputFile & file = HasDataFile(m_Format) ? m_Data : m_Header;
  if (!m_Sparse && file.GetSize() >= BytesOfLargeVolume)
  {
    file.BypassPageCache();
  }
}

void
OutputVolume::Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data)
{
  OutputFile &        file = HasDataFile(m_Format) ? m_Data : m_Header;
  const std::uint64_t offset = m_Offset + firstVoxel * m_Layout.GetBytes();
  const std::uint64_t numberOfBytes = numberOfVoxels * m_Layout.GetBytes();
  if (m_Sparse)
  {
    file.WriteSparseAt(offset, data, numberOfBytes);
  }
  else
  {
    file.WriteAt(offset, data, numberOfBytes);
  }
}

void
OutputVolume::Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const
{
  const OutputFile & file = HasDataFile(m_Format) ? m_Data : m_Header;
  file.ReadAt(m_Offset + firstVoxel * m_Layout.GetBytes(), data, numberOfVoxels * m_Layout.GetBytes());
}

bool
OutputVolume::ReadPlane(unsigned int, std::uint64_t, void *) const
{
  return false;
}

void
OutputVolume::Finish()
{
  m_Header.Finish();
  if (HasDataFile(m_Format))
  {
    m_Data.Finish();
  }
}

void
OutputVolume::Publish()
{
  if (!HasDataFile(m_Format))
  {
    m_Header.Publish();
    return;
  }
  const std::filesystem::path replaced = FindDataFile(m_Header.GetFileName());
  this->PublishDataFile();
  const std::string text = MakeHeaderText(m_Format, m_Geometry, m_Layout, m_Data.GetFileName().filename().string());
  WriteText(m_Header, text);
  m_Header.Publish();
  if (!replaced.empty() && replaced != m_Data.GetFileName() && IsNameOfOurs(replaced, m_Header.GetFileName()))
  {
    std::error_code error;
    std::filesystem::remove(replaced, error);
  }
}

/** Takes the first name that no file has; another program may take it in the meantime. */
void
OutputVolume::PublishDataFile()
{
  constexpr unsigned int maximumNames = 10000;
  for (unsigned int number = 0; number < maximumNames; ++number)
  {
    m_Data.SetFileName(DataName(m_Header.GetFileName(), number));
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(m_Data.GetFileName(), error)))
    {
      continue;
    }
    m_Data.Publish();
    return;
  }
  Fail(ExitStatus::Failure, "no free name for the voxels of ", m_Header.GetFileName().string());
}

std::filesystem::path
FindDataFile(const std::filesystem::path & headerName)
{
  const std::string extension = ToLower(headerName.extension().string());
  std::error_code   error;
  if ((extension != ".mhd" && extension != ".nhdr") || !std::filesystem::is_regular_file(headerName, error))
  {
    return {};
  }
  constexpr unsigned int maximumLines = 10000;
  constexpr size_t       maximumBytesPerLine = 1 << 16;
  const char             separator = extension == ".mhd" ? '=' : ':';
  try
  {
    HeaderLines lines(headerName, maximumBytesPerLine);
    std::string line;
    while (lines.GetLineNumber() < maximumLines && lines.Next(line))
    {
      const size_t      position = line.find(separator);
      const std::string name = ToLower(Trim(line.substr(0, position)));
      if (position != std::string::npos && (name == "elementdatafile" || name == "data file" || name == "datafile"))
      {
        return headerName.parent_path() / Trim(line.substr(position + 1));
      }
    }
  }
  catch (const HeaderError &)
  {
    // Not a header: nothing of it is to be removed.
  }
  return {};
}

} // end namespace medialvoxel
