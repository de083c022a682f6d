// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceFootprint.h"

#include "PieceEngine.h"
#include "VolumeFormats.h"

#include <algorithm>

namespace medialvoxel
{

std::uint64_t
GetBytesPerVoxel(const std::vector<VolumeRequest> & volumes, VolumeFiller filler)
{
  std::uint64_t bytes = 0;
  for (const VolumeRequest & volume : volumes)
  {
    bytes += volume.filler == filler ? volume.layout.GetBytes() : 0;
  }
  return std::max<std::uint64_t>(1, bytes);
}

void
AddEngine(PieceFootprint & footprint, const VolumeHeader & header, const itk::MedialVoxelEngineTask & task)
{
  footprint.engines.push_back(MakeEngineSettings(header, task));
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

/** All volumes of a job have as many rows. */
std::uint64_t
GetRowsOfLayer(const VolumeHeader & header, const std::vector<OutputRequest> & outputs)
{
  std::uint64_t rows = 0;
  for (const OutputRequest & output : outputs)
  {
    if (output.IsVolume())
    {
      rows = GetRowsOfLayer(output.fileName, header.geometry, *output.layout);
      if (rows == 0)
      {
        return 0;
      }
    }
  }
  return rows;
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
