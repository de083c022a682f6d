// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectMap.h"

#include <algorithm>

namespace itk
{

MedialVoxelObjectMap::~MedialVoxelObjectMap() = default;

void
MedialVoxelObjectMap::Learn(const MedialVoxelLabelSurvey::Result & found)
{
  m_Table = MedialVoxelLabelTable(found.values);
  m_Passes = found.passes;
  m_ObjectVoxels = found.voxels;
  m_NumberOfPasses = *std::max_element(m_Passes.begin(), m_Passes.end()) + 1u;
  this->ShowPass(0);
}

void
MedialVoxelObjectMap::ShowPass(const unsigned int pass)
{
  m_ShownPass = pass;
  m_IsShown.assign(m_Passes.size(), 0);
  for (std::size_t object = 1; object < m_Passes.size(); ++object)
  {
    m_IsShown[object] = m_Passes[object] == pass ? 1 : 0;
  }
}

} // end namespace itk
