// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputSet.h"

#include "MeshPlacement.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{

VoxelOutput &
OutputSet::AddVolume(const VolumeRequest & request)
{
  JobOptions            options = m_Options;
  std::filesystem::path fileName = request.fileName;
  if (!request.isPublished)
  {
    options.compression = Compression::Default; // it is read in any order
    fileName = GetScratchFolder(options, request.fileName) / fileName.filename();
  }
  VoxelOutput & volume = this->TakeVolume(request.role, MakeVoxelOutput(fileName, options), request.isPublished);
  volume.Create(request.geometry, request.layout);
  if (m_WritesBehind)
  {
    volume.BypassPageCacheWhenLarge();
  }
  return volume;
}

VoxelOutput *
OutputSet::AddVolumeOfEnd(const VolumeRequest & request)
{
  return &OutputSet::AddVolume(request);
}

VoxelOutput &
OutputSet::TakeVolume(const std::string & role, std::unique_ptr<VoxelOutput> volume, bool isPublished)
{
  m_Volumes.push_back({ role, std::move(volume), isPublished });
  return *m_Volumes.back().output;
}

const VoxelOutput *
OutputSet::FindVolume(const std::string & role) const
{
  const auto found =
    std::find_if(m_Volumes.begin(), m_Volumes.end(), [&role](const Volume & volume) { return volume.role == role; });
  return found == m_Volumes.end() ? nullptr : found->output.get();
}

OutputFile *
OutputSet::AddFile(const std::string & fileName)
{
  if (fileName.empty())
  {
    return nullptr;
  }
  m_Files.push_back(std::make_unique<OutputFile>(fileName, m_Options.overwrite));
  OutputFile & file = *m_Files.back();
  if (m_Suffix.empty())
  {
    file.Create(0, false);
  }
  else
  {
    file.RemoveLeftovers(m_Suffix);
    file.CreateNamed(0, false, m_Suffix);
  }
  return &file;
}

void
OutputSet::FinishVolumes()
{
  for (const Volume & volume : m_Volumes)
  {
    volume.output->Finish();
  }
}

void
OutputSet::Publish()
{
  for (auto file = m_Files.rbegin(); file != m_Files.rend(); ++file)
  {
    (*file)->Publish();
  }
  for (auto volume = m_Volumes.rbegin(); volume != m_Volumes.rend(); ++volume)
  {
    volume->isPublished ? volume->output->Publish() : void();
  }
}

} // end namespace medialvoxel
