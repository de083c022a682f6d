// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputSet.h"

namespace medialvoxel
{

VoxelOutput *
OutputSet::AddVolume(const std::string & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  if (fileName.empty())
  {
    return nullptr;
  }
  m_Volumes.push_back(MakeVoxelOutput(fileName, m_Options));
  m_Volumes.back()->Create(geometry, layout);
  if (m_WritesBehind)
  {
    m_Volumes.back()->BypassPageCacheWhenLarge();
  }
  return m_Volumes.back().get();
}

SharedVolume *
OutputSet::AddCompletedVolume(const VolumeRequest & request, const Publication & publication)
{
  auto                 volume = MakeSharedVolume(request.fileName, m_Options);
  SharedVolume * const completed = volume.get();
  completed->OpenToPublish(request.geometry, request.layout, m_Suffix, publication);
  m_Volumes.push_back(std::move(volume));
  return completed;
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
  for (const auto & volume : m_Volumes)
  {
    volume->Finish();
  }
}

void
OutputSet::Publish()
{
  for (const auto & file : m_Files)
  {
    file->Publish();
  }
  for (auto volume = m_Volumes.rbegin(); volume != m_Volumes.rend(); ++volume)
  {
    (*volume)->Publish();
  }
}

} // end namespace medialvoxel
