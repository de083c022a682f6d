// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeText_h
#define medialvoxelVolumeText_h

#include "VolumeHeader.h"

#include <string>

namespace medialvoxel
{

/** Kinds of volume files that are written. */
enum class VolumeFormat
{
  MetaImage,         ///< .mha: header and voxels in one file
  MetaImageDetached, ///< .mhd: voxels in a file of their own
  Nrrd,              ///< .nrrd
  NrrdDetached,      ///< .nhdr
  Zarr               ///< .zarr: a folder
};

/** What the voxels of an output are: \a components values of one type each. */
struct VoxelLayout
{
  PixelType    pixelType{ PixelType::UInt8 };
  unsigned int components{ 1 };

  std::uint64_t
  GetBytes() const
  {
    return std::uint64_t{ GetTraits(pixelType).bytes } * components;
  }
};

/** Format of a file name by its extension. \throw JobError Usage for an extension that is not written. */
VolumeFormat
GetVolumeFormat(const std::filesystem::path & fileName);

bool
HasDataFile(VolumeFormat format);

/** Header of a file with a volume of uncompressed voxels in the byte order of this machine; numbers read back exactly.
 * \param dataFile name of the voxels' file beside the header; empty for formats of one file */
std::string
MakeHeaderText(VolumeFormat           format,
               const VolumeGeometry & geometry,
               const VoxelLayout &    layout,
               const std::string &    dataFile);

} // end namespace medialvoxel

#endif
