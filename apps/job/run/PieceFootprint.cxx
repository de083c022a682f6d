// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceFootprint.h"

#include "OutputChecks.h"
#include "PackedVolume.h"
#include "ZarrVolume.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{

void
AddEngine(PieceFootprint & footprint, const VolumeHeader & header, itk::MedialVoxelClusterEngine::Settings settings)
{
  const bool isReal = header.pixelType == PixelType::Float32 || header.pixelType == PixelType::Float64;
  settings.keepsNotANumber = isReal && header.CanStream();
  footprint.engines.push_back(std::move(settings));
}

/** All volumes of a job have as many slices, and so have their layers. */
std::uint64_t
GetSlicesOfLayer(const VolumeHeader & header, const std::vector<OutputRequest> & candidates)
{
  const auto output = std::find_if(candidates.begin(), candidates.end(), IsZarrOutput);
  return output == candidates.end() ? 1 : ZarrGrid::ForVolume(header.geometry, *output->layout).chunk[2];
}

void
AddOutputs(PieceFootprint &                   footprint,
           const JobOptions &                 options,
           const VolumeHeader &               header,
           const std::vector<OutputRequest> & candidates)
{
  for (const OutputRequest & output : candidates)
  {
    if (IsZarrOutput(output))
    {
      footprint.bytesBeside += ZarrVolume::GetMemoryBytes(header.geometry, *output.layout, options.zarrCompression);
    }
  }
  footprint.bytesBeside +=
    PackedVolume::GetMemoryBytes() *
    static_cast<std::uint64_t>(
      std::count_if(candidates.begin(), candidates.end(), [&options](const OutputRequest & output) {
        return output.layout && !output.fileName.empty() && IsPackedVolume(output.fileName, options.compress);
      }));
  footprint.preferredSlices = GetSlicesOfLayer(header, candidates);
}

} // end namespace medialvoxel
