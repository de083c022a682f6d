// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrMetadata_h
#define medialvoxelZarrMetadata_h

#include "ZarrCompression.h"
#include "ZarrGrid.h"

#include <filesystem>
#include <string>

namespace medialvoxel
{

/** Version 2 of Zarr, https://zarr-specs.readthedocs.io, and version 0.4 of OME-Zarr, https://ngff.openmicroscopy.org.
 * Folder of the one array in the group that an output is. */
constexpr const char * ZarrArrayFolder = "0";

/** Level at which chunks are packed. */
constexpr int ZarrGzipLevel = 1;

/** The file .zgroup. */
std::string
MakeZarrGroupText();

/** The file .zarray of voxels in the byte order of this machine; chunks that are missing are 0. */
std::string
MakeZarrArrayText(const ZarrGrid & grid, ZarrCompression compression);

/** The file .zattrs: axes, spacing as scale and origin as translation. Directions, which the format lacks, are an
 * attribute of this project, left out when they are those of space.
 * \param name of the image */
std::string
MakeZarrAttributesText(const std::string & name, const VolumeGeometry & geometry, unsigned int leadingAxes);

/** What the file .zarray says of an array that is read. */
struct ZarrArray
{
  ZarrGrid        grid;
  ZarrCompression compression{ ZarrCompression::None };
  bool            bigEndian{ false };
  double          fillValue{ 0.0 }; ///< of chunks that have no file; one that the type of the voxels has
};

/** Reads .zarray of an array whose last \a dimension axes are those of space.
 * \param dimension 2 or 3; 0: as many as the array has, 3 at most
 * \throw HeaderError, or JobError when the file is not JSON */
ZarrArray
ReadZarrArray(const std::filesystem::path & arrayFile, unsigned int dimension);

/** True for a folder that is a group or an array of Zarr's version 2. */
bool
IsZarrFolder(const std::filesystem::path & folder);

} // end namespace medialvoxel

#endif
