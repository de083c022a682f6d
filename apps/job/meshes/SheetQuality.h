// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetQuality_h
#define medialvoxelSheetQuality_h

#include "MeshQuality.h"
#include "MeshSpool.h"

namespace medialvoxel
{

/** Of a surface as files have it, whose faces have elements of a size: all of them are held in memory, which takes less
 * than giving them the size did. */
MeshQuality
MeasureQuality(const MeshSpool & surface);

} // end namespace medialvoxel

#endif
