// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeText_h
#define medialvoxelVolumeText_h

#include "VoxelLayout.h"

#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Kinds of volume files that are written. */
enum class VolumeFormat
{
  MetaImage,         ///< .mha: header and voxels in one file
  MetaImageDetached, ///< .mhd: voxels in a file of their own
  Nrrd,              ///< .nrrd
  NrrdDetached,      ///< .nhdr
  Nifti,             ///< .nii, .nii.gz
  Zarr               ///< .zarr: a folder
};

/** Format of a file name by its extension. \throw JobError Usage for an extension that is not written. */
VolumeFormat
GetVolumeFormat(const std::filesystem::path & fileName);

/** Extensions of the volumes that are written: those of formats that have so many components. */
std::vector<std::string>
ListVolumeExtensions(unsigned int components = 1);

bool
HasDataFile(VolumeFormat format);

/** True for a volume whose file is packed as a whole: by its extension, or when \a compress asks for it and the format
 * has it. The chunks of Zarr folders are another matter. */
bool
IsPackedVolume(const std::filesystem::path & fileName, bool compress);

/** Refuses what a format does not have. \throw JobError Usage */
void
CheckVolumeFormat(const std::filesystem::path & fileName,
                  const VolumeGeometry &        geometry,
                  const VoxelLayout &           layout,
                  bool                          compress);

/** Header of a file with a volume of voxels in the byte order of this machine; but for NIfTI, numbers read back
 * exactly.
 * \param dataFile name of the voxels' file beside the header; empty for formats of one file
 * \param packedBytes of voxels that are packed; the length of the header does not depend on the number */
std::string
MakeHeaderText(VolumeFormat                         format,
               const VolumeGeometry &               geometry,
               const VoxelLayout &                  layout,
               const std::string &                  dataFile,
               const std::optional<std::uint64_t> & packedBytes = std::nullopt);

} // end namespace medialvoxel

#endif
