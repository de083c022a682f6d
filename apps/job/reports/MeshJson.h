// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshJson_h
#define medialvoxelMeshJson_h

#include "Json.h"
#include "SurfaceSummary.h"

namespace medialvoxel
{

/** For a report: counts, what its elements keep of the surface, and their quality with its limits. */
Json
MakeMeshJson(const SurfaceSummary & surface);

} // end namespace medialvoxel

#endif
