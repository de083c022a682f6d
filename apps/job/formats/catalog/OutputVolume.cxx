// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputVolume.h"

#include "DataFile.h"
#include "FileNames.h"
#include "Text.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <vector>

namespace medialvoxel
{
namespace
{

/** A larger volume would fill the page cache, and push out data that is needed soon. */
constexpr std::uint64_t LargeVolumeSize = std::uint64_t{ 1 } << 29;

} // namespace

OutputVolume::OutputVolume(const std::filesystem::path & fileName, bool overwrite, bool sparse)
  : m_Format(FindOutputFormat(fileName))
  , m_Sparse(sparse)
  , m_Header(fileName, overwrite)
  , m_Data(MakeDataName(m_Header.GetFileName(), 0), false)
{
  m_Data.SetBelongsTo(m_Header.GetFileName());
}

std::string
OutputVolume::GetPreamble() const
{
  return m_Format.extension.isDetached ? ""
                                       : m_Format.format.writer->makeHeader(m_Geometry, m_Layout, "", std::nullopt);
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
  if (m_Format.extension.isDetached)
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
  if (m_Format.extension.isDetached)
  {
    m_Header.RemoveLeftovers(suffix);
    m_Header.CreateNamed(0, false, suffix);
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
  if (!m_Format.extension.isDetached)
  {
    return {};
  }
  constexpr unsigned int maximumNames = 10000;
  for (unsigned int number = 0; number < maximumNames; ++number)
  {
    const std::filesystem::path name = MakeDataName(m_Header.GetFileName(), number);
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
  constexpr std::uint64_t bufferSize = std::uint64_t{ 1 } << 20;
  const std::uint64_t     voxelsAtOnce = bufferSize / m_Layout.GetBytes();
  std::vector<char>       buffer(voxelsAtOnce * m_Layout.GetBytes());
  Checksum                checksum;
  while (numberOfVoxels > 0)
  {
    itk::MedialVoxelCheckAbort();
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
  if (!m_Sparse && file.GetSize() >= LargeVolumeSize)
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

void
OutputVolume::Finish()
{
  m_Header.Finish();
  if (m_Format.extension.isDetached)
  {
    m_Data.Finish();
  }
}

void
OutputVolume::Publish()
{
  if (!m_Format.extension.isDetached)
  {
    m_Header.Publish();
  }
  else if (m_HasDataName)
  {
    m_Data.Publish();
    this->WriteHeader();
    m_Header.Publish();
    this->RemoveReplacedVoxels(m_Replaced);
  }
  else
  {
    this->PublishBoth();
  }
}

/** Whatever ends this early, the voxels have no name for good before a header names them. */
void
OutputVolume::PublishBoth()
{
  const std::filesystem::path header = m_Header.GetFileName();
  std::filesystem::path       replaced = FindDataFile(header);
  do
  {
    itk::MedialVoxelCheckAbort(); // as another process took the name, when this comes again
    m_Data.SetFileName(this->FindFreeDataName());
    this->WriteHeader();
  } while (!m_Data.PublishForNow());
  if (m_Header.PublishByExchange())
  {
    // Another process may have replaced the header that was there before.
    replaced = FindDataFile(header, m_Header.GetTemporaryName());
  }
  this->RemoveReplacedVoxels(replaced);
  m_Header.KeepName();
  m_Data.KeepName();
  SyncFolder(FolderOf(header));
}

void
OutputVolume::WriteHeader()
{
  WriteText(
    m_Header,
    m_Format.format.writer->makeHeader(m_Geometry, m_Layout, m_Data.GetFileName().filename().string(), std::nullopt));
}

void
OutputVolume::RemoveReplacedVoxels(const std::filesystem::path & replaced) const
{
  if (!replaced.empty() && replaced != m_Data.GetFileName() && IsDataName(replaced, m_Header.GetFileName()))
  {
    std::error_code error;
    std::filesystem::remove(replaced, error);
  }
}

} // end namespace medialvoxel
