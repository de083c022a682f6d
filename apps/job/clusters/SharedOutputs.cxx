// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SharedOutputs.h"

namespace medialvoxel
{

VoxelOutput &
SharedOutputs::AddVolume(const VolumeRequest & request)
{
  auto           made = MakeSharedVolume(request.fileName, m_Options);
  SharedVolume & volume = *made;
  this->TakeVolume(request.role, std::move(made), request.isPublished);
  m_Volumes[request.role] = &volume;
  if (m_Names)
  {
    volume.OpenToPublish(request.geometry, request.layout, m_Suffix, (*m_Names)[request.role]);
    return volume;
  }
  volume.OpenShared(request.geometry, request.layout, m_Suffix);
  if (m_WritesBehind)
  {
    volume.BypassPageCacheWhenLarge();
  }
  return volume;
}

} // end namespace medialvoxel
