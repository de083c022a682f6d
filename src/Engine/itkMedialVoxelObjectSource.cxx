// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectSource.h"

namespace itk
{

MedialVoxelObjectSource::~MedialVoxelObjectSource() = default;

MedialVoxelSourceThreads
MedialVoxelObjectSource::GetSourceThreads() const
{
  return MedialVoxelSourceThreads::Calling;
}

std::int64_t
MedialVoxelObjectSource::GetRowsReadTogether() const
{
  return 1;
}

} // end namespace itk
