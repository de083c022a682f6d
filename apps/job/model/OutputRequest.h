// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputRequest_h
#define medialvoxelOutputRequest_h

#include "VoxelLayout.h"

#include <filesystem>
#include <optional>
#include <string>

namespace medialvoxel
{

/** A file that a job is to write. */
struct OutputRequest
{
  std::string                role;
  std::filesystem::path      fileName;
  std::optional<VoxelLayout> layout;           ///< set for volumes
  bool                       appends{ false }; ///< what the file has stays
};

/** A volume that a job writes. */
struct VolumeRequest
{
  std::string    role;
  std::string    fileName;
  VolumeGeometry geometry;
  VoxelLayout    layout;
};

} // end namespace medialvoxel

#endif
