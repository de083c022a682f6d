// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshJson_h
#define medialvoxelMeshJson_h

#include "Json.h"
#include "SheetSummary.h"

namespace medialvoxel
{

/** A value of the quality of a mesh and its limit, for FillIn(). */
constexpr const char * MeshLimitText = "{short value}, [least?[holds?at least][!holds?less than] {short least}]"
                                       "[most?[holds?at most][!holds?more than] {short most}]";

/** The mesh in a report: counts, deviations of its elements from the fine mesh, and their quality with its limits. */
Json
MakeMeshJson(const SheetSummary & surface);

} // end namespace medialvoxel

#endif
