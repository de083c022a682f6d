// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeFormats_h
#define medialvoxelVolumeFormats_h

#include "FormatNames.h"
#include "VolumeFormat.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace medialvoxel
{

/** The format of headerless files. */
const VolumeFormat &
GetRawFormat();

/** The format of an existing file or folder, or of a pattern of slices. \throw JobError Usage for an unknown one, or
 * one that the program was built without */
const VolumeFormat &
FindInputFormat(const std::filesystem::path & fileName);

/** How a volume of a name is written. */
struct OutputFormat
{
  const VolumeFormat &    format;
  const VolumeExtension & extension;
};

/** \throw JobError Usage for an extension that is not written. */
OutputFormat
FindOutputFormat(const std::filesystem::path & fileName);

/** Extensions of the volumes that are read. */
std::vector<std::string>
ListInputExtensions();

/** True for a volume whose file is packed as a whole: by its extension, or when \a compression asks for it and the
 * format has it. The chunks of Zarr folders are another matter. */
bool
IsPackedVolume(const std::filesystem::path & fileName, Compression compression);

/** The same, or in chunks: how many bytes it will have is not known. */
bool
IsPackedInAnyWay(const std::filesystem::path & fileName, const JobOptions & options);

/** Refuses options that a format does not have. \throw JobError Usage */
void
CheckOutputFormat(const std::filesystem::path & fileName,
                  const VolumeGeometry &        geometry,
                  const VoxelLayout &           layout,
                  Compression                   compression);

/** Memory that writing a volume takes beside the results of a piece. */
std::uint64_t
GetOutputMemory(const std::filesystem::path & fileName,
                const VolumeGeometry &        geometry,
                const VoxelLayout &           layout,
                const JobOptions &            options);

/** Bytes of a volume that is written, when it is not packed. */
std::uint64_t
GetOutputSize(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout);

/** Slices of a volume that are written together. */
std::uint64_t
GetSlicesOfLayer(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout);

/** Rows of these slices that VoxelOutput::WriteRows() takes together; 0 when slices are written as a whole. */
std::uint64_t
GetRowsOfLayer(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout);

} // end namespace medialvoxel

#endif
