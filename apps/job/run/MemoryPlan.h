// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMemoryPlan_h
#define medialvoxelMemoryPlan_h

#include "Plan.h"

namespace medialvoxel
{

/** The part of the plan that memory decides: threads, slabs, pieces, scratch folder and limits.
 * \throw JobError Refused when nothing fits. */
JobPlan
FitToMemory(const JobOptions & options, const VolumeHeader & header, const PieceFootprint & footprint);

} // end namespace medialvoxel

#endif
