// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelNrrdSegments_h
#define medialvoxelNrrdSegments_h

#include "Segments.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Pairs of keys and values of a NRRD file. */
using NrrdKeys = std::map<std::string, std::string>;

/** Most segments of a NRRD file: so many that its header is read back. */
constexpr std::size_t MostNrrdSegments = 8192;

/** The segments of a segmentation of 3D Slicer with one layer; none of other volumes. As in Slicer they are numbered
 * from 0 without a gap, and one without a label has the label 1.
 * \throw HeaderError, Corrupt with the name of the file, the key and its value */
SegmentTable
ReadNrrdSegments(const std::filesystem::path & fileName);

/** Slicer's fields for a volume of these segments; nothing for none. \param size of the volume */
NrrdKeys
MakeNrrdSegments(const SegmentTable & table, const std::vector<std::uint64_t> & size);

/** True for the keys of a segmentation. */
bool
HasNrrdSegments(const NrrdKeys & keys);

/** A text of another program as a name, a tag or an ID. \param what for the message
 * \throw HeaderError Corrupt when it is longer than any name */
std::string
MakeSegmentText(const std::filesystem::path & fileName, const std::string & what, const std::string & text);

/** \throw HeaderError Corrupt when it is no label of a segment */
std::int64_t
ParseSegmentLabel(const std::filesystem::path & fileName, const std::string & what, const std::string & text);

} // end namespace medialvoxel

#endif
