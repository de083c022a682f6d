// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSliceFormats_h
#define medialvoxelSliceFormats_h

#include "SliceSeries.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** The format of an image that can be a slice; null for other files. */
const SliceFormat *
FindSliceFormat(const std::filesystem::path & fileName);

/** "DICOM, TIFF (.tif .tiff), ...": the formats of slices. */
std::string
DescribeSliceFormats();

/** Refuses an image that its file cannot hold.
 * \param ratio bytes of voxels that one byte of the file can become
 * \throw HeaderError */
void
CheckSliceSize(const SliceHeader & header, std::uint64_t fileSize, std::uint64_t ratio);

/** \throw HeaderError when the size or type is no longer the one that was read first */
void
RequireSameSlice(const SliceHeader & first, const SliceHeader & now);

/** The row of a format that TFile reads: TFile(name) reads the header, GetHeader() checks it, ReadVoxels() unpacks. */
template <typename TFile>
SliceFormat
MakeSliceFormat(const char * name, std::vector<const char *> extensions)
{
  const auto readHeaders = [](const std::filesystem::path & fileName) -> std::vector<SliceHeader> {
    return { TFile(fileName).GetHeader() };
  };
  const auto readVoxels = [](const SliceHeader & expected, void * voxels) {
    TFile file(expected.fileName);
    RequireSameSlice(expected, file.GetHeader());
    file.ReadVoxels(expected, voxels);
  };
  return { name, std::move(extensions), false, nullptr, readHeaders, readVoxels, 0 };
}

// The rows of the table, each in a file of its own.
SliceFormat
MakeDicomSliceFormat();
SliceFormat
MakeTiffSliceFormat();
SliceFormat
MakePngSliceFormat();
SliceFormat
MakeJpegSliceFormat();
SliceFormat
MakeBmpSliceFormat();

} // end namespace medialvoxel

#endif
