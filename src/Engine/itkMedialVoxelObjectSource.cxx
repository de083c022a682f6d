// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectSource.h"

#include <stdexcept>

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

void
MedialVoxelObjectSource::FillObjectAndGray(const MedialVoxelBox &,
                                           MedialVoxelBits &,
                                           MedialVoxelBits *,
                                           MedialVoxelGray &)
{
  throw std::logic_error("MedialVoxelObjectSource: this source has no values");
}

void
MedialVoxelObjectSource::FillGray(const MedialVoxelBox &, MedialVoxelGray &)
{
  throw std::logic_error("MedialVoxelObjectSource: this source has no values");
}

void
MedialVoxelObjectSource::ThrowIfAborted() const
{}

} // end namespace itk
