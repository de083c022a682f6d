// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeText_h
#define medialvoxelVolumeText_h

#include "VoxelLayout.h"

#include <cstdint>
#include <optional>
#include <string>

namespace medialvoxel
{

/** The file to name for packed voxels, in place of a header beside them. */
constexpr const char * DetachedRemedy = "its voxels are in a file of their own; .mha and .nrrd can be packed";

/** Header of a file with a volume of voxels in the byte order of this machine. Numbers read back exactly.
 * \param dataFile name of the voxels' file beside the header; empty when they follow the header
 * \param packedSize of voxels that are packed; the length of the header does not depend on the number */
std::string
MakeMetaImageText(const VolumeGeometry &               geometry,
                  const VoxelLayout &                  layout,
                  const std::string &                  dataFile,
                  const std::optional<std::uint64_t> & packedSize = std::nullopt);
std::string
MakeNrrdText(const VolumeGeometry &               geometry,
             const VoxelLayout &                  layout,
             const std::string &                  dataFile,
             const std::optional<std::uint64_t> & packedSize = std::nullopt);

} // end namespace medialvoxel

#endif
