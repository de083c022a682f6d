// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetQuality_h
#define medialvoxelSheetQuality_h

#include "MeshQuality.h"
#include "MeshSpool.h"

namespace medialvoxel
{

/** Measures a mesh with the rounding of files, whose faces have elements of a size. All of them are held in memory,
 * which takes less than remeshing did. */
MeshQuality
MeasureQuality(const MeshSpool & surface);

} // end namespace medialvoxel

#endif
