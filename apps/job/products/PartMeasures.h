// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPartMeasures_h
#define medialvoxelPartMeasures_h

#include "PartSummary.h"
#include "SurfaceArray.h"
#include "SurfaceSpool.h"
#include "VolumeHeader.h"

#include <functional>

namespace medialvoxel
{

/** Area, volume and thickness of the surface of a part, in the order of its faces. A third of a triangle counts for
 * each of its corners. The numbers of unknown vertices stay 0.
 * \param rays null: they were not measured \param progress as in SurfaceWriteOptions */
PartSummary
MeasurePart(const SurfaceSpool &                surface,
            const SurfaceArray *                rays,
            const VolumeGeometry &              geometry,
            const std::function<void(double)> & progress);

} // end namespace medialvoxel

#endif
