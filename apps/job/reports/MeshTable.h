// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshTable_h
#define medialvoxelMeshTable_h

#include "SealedJson.h"
#include "SurfaceSummary.h"
#include "Text.h"

namespace medialvoxel
{

/** For a report: counts, what its elements keep of the surface, and their quality with its limits. */
Json
MakeMeshJson(const SurfaceSummary & surface);

/** The same for the terminal, a row for each number. */
TextTable
DescribeMesh(const SurfaceSummary & surface);

} // end namespace medialvoxel

#endif
