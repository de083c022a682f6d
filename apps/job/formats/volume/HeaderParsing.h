// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelHeaderParsing_h
#define medialvoxelHeaderParsing_h

#include "VolumeHeader.h"

#include "itkMedialVoxelHeaderText.h"

namespace medialvoxel
{

using itk::MedialVoxelText::FindDataFile;
using itk::MedialVoxelText::GetDataFileSize;
using itk::MedialVoxelText::HeaderError;
using itk::MedialVoxelText::HeaderFields;
using itk::MedialVoxelText::HeaderLines;
using itk::MedialVoxelText::OpenRegularFile;
using itk::MedialVoxelText::ParseNumbers;
using itk::MedialVoxelText::ParseSizes;
using itk::MedialVoxelText::ParseSpacings;
using itk::MedialVoxelText::RefuseHeader;
using itk::MedialVoxelText::RequireField;

/** Lengths along some axes are a guess; a spacing that the user gives ends the warning.
 * \param what the file lacks, such as "the pages do not tell how far they are from each other" */
void
WarnOfUnknownSpacing(VolumeHeader & header, const std::string & what);

/** Lengths of the geometry in millimeters, where all axes have a unit; a warning where only some have, or a rare one.
 * \param units names, x first; empty ones are not told */
void
ApplyUnits(VolumeHeader & header, const std::vector<std::string> & units);

/** \throw HeaderError */
VolumeHeader
ReadMetaImageHeader(const std::filesystem::path & fileName);
VolumeHeader
ReadNrrdHeader(const std::filesystem::path & fileName);
VolumeHeader
ReadNiftiHeader(const std::filesystem::path & fileName);
VolumeHeader
ReadMrcHeader(const std::filesystem::path & fileName);
/** Of a text of keys and values that describes the voxels beside it, or of these voxels. */
VolumeHeader
ReadKeyedHeader(const std::filesystem::path & fileName);
/** Of these texts and these voxels. */
std::vector<const char *>
ListKeyedExtensions();
/** Of a level of an image of OME-Zarr 0.4 or 0.5, 0 the largest, or of an array, which has no other.
 * \throw HeaderError; JobError for files that are not JSON, and Usage for a level that is not there */
VolumeHeader
ReadZarrHeader(const std::filesystem::path & folder, unsigned int level);
/** Of a folder or pattern of images, each of which is a slice. */
VolumeHeader
ReadSeriesHeader(const std::filesystem::path & input, const SliceChoice & choice);
#ifdef MEDIALVOXEL_WITH_TIFF
VolumeHeader
ReadTiffHeader(const std::filesystem::path & fileName);
/** Of an image of a series, whose description may tell of all of them. */
VolumeHeader
ReadTiffSliceHeader(const std::filesystem::path & fileName);
#endif

} // end namespace medialvoxel

#endif
