// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelProgress.h"

namespace itk
{

MedialVoxelProgress::~MedialVoxelProgress() = default;

bool
MedialVoxelNoProgress::IsAborted() const
{
  return false;
}

void
MedialVoxelNoProgress::Advance(std::uint64_t)
{}

} // end namespace itk
