// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceSections_h
#define medialvoxelPlaceSections_h

#include "PlaceSummary.h"
#include "VolumeHeader.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Places of each kind that a page shows. */
constexpr std::size_t MostPlacesOfPage = 20;

/** For these places, in their order, a section through the values of the volume as SVG: it holds the line between the
 * two sides of the wall, which lies across the middle, and the axis of the volume that is most along the wall.
 * \param header of a volume that is unpacked, if it is compressed
 * \throw JobError, itk::ExceptionObject, as reading does */
std::vector<std::string>
DrawPlaceSections(const std::vector<PlaceSummary> & places, const VolumeHeader & header);

/** Memory while they are drawn, with their texts. */
std::uint64_t
GetSectionMemory();

} // end namespace medialvoxel

#endif
