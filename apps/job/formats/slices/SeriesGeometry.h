// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSeriesGeometry_h
#define medialvoxelSeriesGeometry_h

#include "SliceSeries.h"
#include "VolumeHeader.h"

#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** Sorts slices that all have a place in the direction of the normal, as ITK does.
 * \param input      that messages begin with
 * \param hasSpacing the distances of the slices do not matter, unless one is doubled
 * \param warnings   get one when the places are rounded
 * \throw HeaderError that names the slices when their directions differ, or one is missing, doubled, unequally spaced,
 * or beside the others, as with a tilted gantry */
void
SortAlongNormal(const std::filesystem::path & input,
                std::vector<SliceHeader> &    slices,
                bool                          hasSpacing,
                std::vector<Warning> &        warnings);

/** Where the volume of sorted slices of one size lies; a single slice is an image of two dimensions. The distance of
 * slices without places is 1. \throw HeaderError for spacings that differ from slice to slice */
VolumeGeometry
MakeSeriesGeometry(const std::filesystem::path & input, const std::vector<SliceHeader> & slices);

} // end namespace medialvoxel

#endif
