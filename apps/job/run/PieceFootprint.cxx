// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceFootprint.h"

#include "VolumeFormats.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{

void
AddEngine(PieceFootprint & footprint, const VolumeHeader & header, const itk::MedialVoxelEngineTask & task)
{
  const bool isReal = header.pixelType == PixelType::Float32 || header.pixelType == PixelType::Float64;
  itk::MedialVoxelEngineSettings settings;
  settings.task = task;
  settings.countsNotANumber = isReal && header.CanStream();
  footprint.engines.push_back(std::move(settings));
}

/** All volumes of a job have as many slices, and so have their layers. */
std::uint64_t
GetSlicesOfLayer(const VolumeHeader & header, const std::vector<OutputRequest> & outputs)
{
  std::uint64_t slices = 1;
  for (const OutputRequest & output : outputs)
  {
    if (output.IsVolume())
    {
      slices = std::max(slices, GetSlicesOfLayer(output.fileName, header.geometry, *output.layout));
    }
  }
  return slices;
}

void
AddOutputs(PieceFootprint &                   footprint,
           const JobOptions &                 options,
           const VolumeHeader &               header,
           const std::vector<OutputRequest> & outputs)
{
  for (const OutputRequest & output : outputs)
  {
    if (output.IsVolume())
    {
      footprint.bytesBeside += GetOutputMemory(output.fileName, header.geometry, *output.layout, options);
    }
  }
  footprint.preferredSlices = GetSlicesOfLayer(header, outputs);
}

} // end namespace medialvoxel
