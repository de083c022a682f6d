// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputRequest_h
#define medialvoxelOutputRequest_h

#include "VoxelLayout.h"

#include "itkMedialVoxelTileResult.h"

#include <filesystem>
#include <optional>
#include <string>

namespace medialvoxel
{

/** The task that makes a volume. */
enum class VolumeFiller
{
  Extraction,
  Distance,
  LocalThickness,
  Objects, ///< the passes over a label map together
  Product  ///< no task: a product, when all pieces are done
};

/** A file that a job is to write. */
struct OutputRequest
{
  std::string                role;
  std::filesystem::path      fileName;
  std::optional<VoxelLayout> layout;           ///< set for volumes
  bool                       appends{ false }; ///< the file keeps its content

  /** True for a volume that is wanted. */
  bool
  IsVolume() const
  {
    return layout && !fileName.empty();
  }
};

/** Where the voxels of a tile go in a volume that is in memory. */
struct TileTarget
{
  void *                            first;   ///< voxel of the tile
  itk::MedialVoxelStrides           strides; ///< voxels of the volume
  const VolumeGeometry &            geometry;
  itk::MedialVoxelGrid::SpacingType spacing;
};

/** Writes the result of a tile to all its voxels in a volume. */
using TileWriter = void (*)(const itk::MedialVoxelTileResult &, const TileTarget &);

/** A volume that a job writes. */
struct VolumeRequest
{
  std::string    role;
  std::string    fileName;
  VolumeGeometry geometry;
  VoxelLayout    layout;
  TileWriter     write{ nullptr };
  VolumeFiller   filler{ VolumeFiller::Extraction };
  bool           isPublished{ true }; ///< otherwise a scratch file until the end of the run, or of the job
};

} // end namespace medialvoxel

#endif
