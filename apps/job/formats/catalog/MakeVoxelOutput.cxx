// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VoxelOutput.h"

#include "Errors.h"
#include "OutputVolume.h"
#include "PackedVolume.h"
#include "SharedVolume.h"
#include "VolumeFormats.h"

namespace medialvoxel
{

std::unique_ptr<SharedVolume>
MakeSharedVolume(const std::filesystem::path & fileName, const JobOptions & options)
{
  const VolumeWriter & writer = *FindOutputFormat(fileName).format.writer;
  return writer.makeFolder ? writer.makeFolder(fileName, options)
                           : std::make_unique<OutputVolume>(fileName, options.overwrite, options.sparse);
}

std::unique_ptr<VoxelOutput>
MakeVoxelOutput(const std::filesystem::path & fileName, const JobOptions & options)
{
  if (IsPackedVolume(fileName, options.compression))
  {
    return std::make_unique<PackedVolume>(fileName, options.overwrite);
  }
  return MakeSharedVolume(fileName, options);
}

} // end namespace medialvoxel
