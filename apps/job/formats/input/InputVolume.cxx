// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "MaskInput.h"
#include "SmoothedInput.h"
#include "StreamedInput.h"
#include "VolumeFormats.h"

namespace medialvoxel
{

bool
InputVolume::IsReadInParallel(const VolumeHeader & header)
{
  return header.CanStream() && !header.stored && (header.chunks || header.liesInRows);
}

std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader &          header,
                const JobOptions &            options,
                const std::filesystem::path & scratchFolder,
                std::uint64_t                 bytesToKeep,
                Smoothing                     smoothing)
{
  if (!header.CanStream())
  {
    return OpenMaskInput(header, options, GetInterpolation(options), scratchFolder, smoothing);
  }
  if (smoothing == Smoothing::Off)
  {
    return std::make_unique<StreamedInput>(header, options, bytesToKeep);
  }
  return std::make_unique<SmoothedInput>(header, options, bytesToKeep, smoothing);
}

} // end namespace medialvoxel
