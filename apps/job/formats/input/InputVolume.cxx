// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "SmoothedInput.h"
#include "StreamedInput.h"

namespace medialvoxel
{

bool
InputVolume::IsReadInParallel(const VolumeHeader & header)
{
  return !header.stored && (header.compressed || header.chunks || header.liesInRows);
}

std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header, const JobOptions & options, std::uint64_t bytesToKeep, Smoothing smoothing)
{
  if (smoothing == Smoothing::Off)
  {
    return std::make_unique<StreamedInput>(header, options, bytesToKeep);
  }
  return std::make_unique<SmoothedInput>(header, options, bytesToKeep, smoothing);
}

} // end namespace medialvoxel
