// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSegmentFiles_h
#define medialvoxelSegmentFiles_h

#include "Segments.h"
#include "VolumeHeader.h"

#include <filesystem>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Extensions of files that name the segments of a label map. */
std::vector<std::string>
ListSegmentExtensions();

/** Names and colors by label, of a color table or a segmentation of 3D Slicer.
 * \throw JobError Usage for another extension; Failure for a file that cannot be read; CorruptInput, with the line or
 * key and its value, for one that is damaged */
SegmentTable
ReadSegments(const std::filesystem::path & fileName);

/** The segments of the volume itself; none where its format has no names. \throw as ReadSegments() */
SegmentTable
ReadSegmentsOfVolume(const VolumeHeader & header);

/** \throw JobError Usage for a volume to be written that has no place for so many segments; \a fileName may be empty */
void
CheckSegments(const std::filesystem::path & fileName, const SegmentTable & table);

} // end namespace medialvoxel

#endif
