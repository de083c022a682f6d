// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputRequest_h
#define medialvoxelOutputRequest_h

#include "VoxelLayout.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace medialvoxel
{

/** What a volume holds. */
enum class VolumeContent
{
  Labels,
  Vectors,
  Distances,
  Thicknesses
};

constexpr std::size_t NumberOfVolumeContents = 4;

/** The filter that makes a volume. */
enum class VolumeFiller
{
  Extraction,
  Distance
};

/** A file that a job is to write. */
struct OutputRequest
{
  std::string                role;
  std::filesystem::path      fileName;
  std::optional<VoxelLayout> layout;           ///< set for volumes
  bool                       appends{ false }; ///< what the file has stays

  /** True for a volume that is wanted. */
  bool
  IsVolume() const
  {
    return layout && !fileName.empty();
  }
};

/** A volume that a job writes. */
struct VolumeRequest
{
  std::string    role;
  std::string    fileName;
  VolumeGeometry geometry;
  VoxelLayout    layout;
  VolumeContent  content{ VolumeContent::Labels };
  VolumeFiller   filler{ VolumeFiller::Extraction };
};

} // end namespace medialvoxel

#endif
