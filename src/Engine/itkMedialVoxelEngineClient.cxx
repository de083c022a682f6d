// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEngineClient.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSlabPlan.h"

#include <algorithm>

namespace itk
{

void
MedialVoxelEngineClient::UpdateProgress(float)
{}

bool
MedialVoxelEngineClient::IsAbortRequested() const
{
  return false;
}

std::exception_ptr
MedialVoxelEngineClient::GetAbortException() const
{
  return std::make_exception_ptr(MedialVoxelAborted());
}

std::vector<MedialVoxelBox>
MedialVoxelEngineClient::CutForPull(const MedialVoxelBox & box, const std::size_t bytesPerVoxel)
{
  constexpr std::int64_t bytesPerPull = 1 << 20;
  const std::int64_t     bytesPerRow = box.Extent(0) * static_cast<std::int64_t>(bytesPerVoxel);
  MedialVoxelIndex       size{ { box.upper[0], box.upper[1], box.upper[2] } };
  if (box.Extent(2) > 1)
  {
    size[2] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow * box.Extent(1)));
  }
  else if (box.Extent(1) > 1)
  {
    size[1] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow));
  }
  return MedialVoxelCutIntoTiles(box, size);
}

} // end namespace itk
