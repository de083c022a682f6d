// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputVolume.h"

#include "FileNames.h"
#include "HeaderParsing.h"
#include "Progress.h"
#include "Text.h"

#include <algorithm>
#include <regex>
#include <vector>

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

std::string
OutputVolume::GetPreamble() const
{
  return HasDataFile(m_Format) ? "" : MakeHeaderText(m_Format, m_Geometry, m_Layout, "");
}

std::uint64_t
OutputVolume::Describe(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  m_Geometry = geometry;
  m_Layout = layout;
  m_Offset = this->GetPreamble().size();
  return m_Offset + geometry.GetNumberOfVoxels() * layout.GetBytes();
}

void
OutputVolume::Create(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  const std::uint64_t numberOfBytes = this->Describe(geometry, layout);
  if (HasDataFile(m_Format))
  {
    // The header is written when the name of the voxels is known; its creation now shows that it can be.
    m_Header.Create(0, false);
  }
  this->GetVoxelFile().Create(numberOfBytes, !m_Sparse);
  const std::string text = this->GetPreamble();
  this->GetVoxelFile().WriteAt(0, text.data(), text.size());
}

std::filesystem::path
OutputVolume::GetSharedName(const std::string & suffix) const
{
  return this->GetVoxelFile().GetFileName().string() + suffix;
}

void
OutputVolume::RemoveShared(const std::string & suffix) const
{
  std::error_code error;
  std::filesystem::remove(this->GetSharedName(suffix), error);
}

void
OutputVolume::CreateShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix)
{
  const std::uint64_t numberOfBytes = this->Describe(geometry, layout);
  OutputFile &        file = this->GetVoxelFile();
  file.CreateShared(this->GetSharedName(suffix), numberOfBytes);
  const std::string text = this->GetPreamble();
  file.WriteAt(0, text.data(), text.size());
  file.Finish();
  SyncFolder(FolderOf(file.GetFileName()));
}

void
OutputVolume::OpenShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix)
{
  const std::uint64_t numberOfBytes = this->Describe(geometry, layout);
  this->GetVoxelFile().OpenShared(this->GetSharedName(suffix), numberOfBytes, true);
}

void
OutputVolume::OpenToPublish(const VolumeGeometry & geometry,
                            const VoxelLayout &    layout,
                            const std::string &    suffix,
                            const Publication &    publication)
{
  const std::uint64_t         numberOfBytes = this->Describe(geometry, layout);
  OutputFile &                file = this->GetVoxelFile();
  const std::filesystem::path temporaryName = this->GetSharedName(suffix);
  if (HasDataFile(m_Format))
  {
    m_Header.RemoveLeftovers(suffix);
    m_Header.Create(0, false, suffix);
    m_Data.SetFileName(publication.dataName);
    m_HasDataName = true;
    m_Replaced = publication.replacedName;
  }
  std::error_code error;
  if (publication.hasBegun && !std::filesystem::exists(temporaryName, error))
  {
    file.OpenPublished(numberOfBytes);
  }
  else
  {
    file.OpenShared(temporaryName, numberOfBytes, false);
  }
  std::string found(m_Offset, '\0');
  file.ReadAt(0, found.data(), found.size());
  if (found != this->GetPreamble())
  {
    Fail(ExitStatus::Failure, file.GetFileName().string(), ": its header was changed while it was written");
  }
}

std::filesystem::path
OutputVolume::FindFreeDataName() const
{
  if (!HasDataFile(m_Format))
  {
    return {};
  }
  constexpr unsigned int maximumNames = 10000;
  for (unsigned int number = 0; number < maximumNames; ++number)
  {
    const std::filesystem::path name = DataName(m_Header.GetFileName(), number);
    std::error_code             error;
    if (!std::filesystem::exists(std::filesystem::symlink_status(name, error)))
    {
      return name;
    }
  }
  Fail(ExitStatus::Failure, "no free name for the voxels of ", m_Header.GetFileName().string());
}

void
OutputVolume::Sync()
{
  this->GetVoxelFile().Sync();
}

void
OutputVolume::StartCluster()
{
  m_Checksum = Checksum();
}

std::uint32_t
OutputVolume::GetChecksum() const
{
  return m_Checksum ? m_Checksum->GetValue() : 0;
}

std::uint32_t
OutputVolume::ReadChecksum(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const
{
  constexpr std::uint64_t bufferBytes = std::uint64_t{ 1 } << 20;
  const std::uint64_t     voxelsAtOnce = bufferBytes / m_Layout.GetBytes();
  std::vector<char>       buffer(voxelsAtOnce * m_Layout.GetBytes());
  Checksum                checksum;
  while (numberOfVoxels > 0)
  {
    ThrowIfSignaled();
    const std::uint64_t voxels = std::min(numberOfVoxels, voxelsAtOnce);
    this->Read(firstVoxel, voxels, buffer.data());
    checksum.Add(buffer.data(), voxels * m_Layout.GetBytes());
    firstVoxel += voxels;
    numberOfVoxels -= voxels;
  }
  return checksum.GetValue();
}

void
OutputVolume::BypassPageCacheWhenLarge()
{
  OutputFile & file = this->GetVoxelFile();
  if (!m_Sparse && file.GetSize() >= BytesOfLargeVolume)
  {
    file.BypassPageCache();
  }
}

void
OutputVolume::Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data)
{
  OutputFile &        file = this->GetVoxelFile();
  const std::uint64_t offset = m_Offset + firstVoxel * m_Layout.GetBytes();
  const std::uint64_t numberOfBytes = numberOfVoxels * m_Layout.GetBytes();
  if (m_Checksum)
  {
    m_Checksum->Add(data, numberOfBytes);
  }
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
  this->GetVoxelFile().ReadAt(m_Offset + firstVoxel * m_Layout.GetBytes(), data, numberOfVoxels * m_Layout.GetBytes());
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
  const std::filesystem::path replaced = m_HasDataName ? m_Replaced : FindDataFile(m_Header.GetFileName());
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

/** Takes the first name that no file has, unless one was chosen; another program may take it in the meantime. */
void
OutputVolume::PublishDataFile()
{
  if (!m_HasDataName)
  {
    m_Data.SetFileName(this->FindFreeDataName());
  }
  m_Data.Publish();
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
