// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelInput.h"

namespace itk
{

MedialVoxelSourceThreads
MedialVoxelInput::GetSourceThreads() const
{
  return m_Source.GetSourceThreads();
}

std::int64_t
MedialVoxelInput::GetRowsReadTogether() const
{
  return m_Source.GetRowsReadTogether();
}

} // end namespace itk
