// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputVolume.h"
#include "PackedVolume.h"
#include "ZarrVolume.h"

namespace medialvoxel
{

std::unique_ptr<SharedVolume>
MakeSharedVolume(const std::filesystem::path & fileName, const JobOptions & options)
{
  if (GetVolumeFormat(fileName) == VolumeFormat::Zarr)
  {
    return std::make_unique<ZarrVolume>(fileName, options.overwrite, options.sparse, options.zarrCompression);
  }
  return std::make_unique<OutputVolume>(fileName, options.overwrite, options.sparse);
}

std::unique_ptr<VoxelOutput>
MakeVoxelOutput(const std::filesystem::path & fileName, const JobOptions & options)
{
  if (IsPackedVolume(fileName, options.compress))
  {
    return std::make_unique<PackedVolume>(fileName, options.overwrite);
  }
  return MakeSharedVolume(fileName, options);
}

} // end namespace medialvoxel
