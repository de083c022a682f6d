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
  m_ShownPass = 0;
}

} // end namespace itk
