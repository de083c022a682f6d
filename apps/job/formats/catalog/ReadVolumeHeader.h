// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelReadVolumeHeader_h
#define medialvoxelReadVolumeHeader_h

#include "Options.h"
#include "Text.h"
#include "VolumeHeader.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** Reads and checks the header of a volume: in a format of VolumeFormats.cxx (TIFF when built with libtiff), a folder
 * or pattern of images that are slices or, with a description, a headerless file.
 *
 * When it returns, the volume is 2-D or 3-D and scalar, its voxels are in the data file (of compressed ones: may
 * be), and its place in space is within itk::MedialVoxelGridLimits.
 * \param spacing along each axis, in place of the spacing of the file; empty: from the file
 * \param level of an image of several sizes, 0 the largest
 * \param slices to choose from a folder or pattern
 * \throw JobError: Usage for an unknown extension, another number of spacings than of axes or a missing level,
 * Failure for a file that cannot be read, CorruptInput for all else. */
VolumeHeader
ReadVolumeHeader(const std::filesystem::path &         fileName,
                 const std::optional<RawDescription> & raw,
                 const std::vector<double> &           spacing = {},
                 unsigned int                          level = 0,
                 const SliceChoice &                   slices = {});

/** The input as the options want it seen, at another spacing or resampled. \throw as ReadVolumeHeader() */
VolumeHeader
ReadInputHeader(const JobOptions & options);

/** The same for sheets and their thickness: unless the options say otherwise, spacings that differ too much for these
 * are brought to the smallest one. */
VolumeHeader
ReadSheetInputHeader(const JobOptions & options);

/** Unexplained bytes behind the voxels of an uncompressed volume, in formats that allow them; nobody reads them. */
std::uint64_t
GetTrailingSize(const VolumeHeader & header);

/** The volume as names and values to print. */
TextTable
DescribeHeader(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
