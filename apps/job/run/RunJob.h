// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelRunJob_h
#define medialvoxelRunJob_h

#include "JobResult.h"
#include "Options.h"
#include "Progress.h"

namespace medialvoxel
{

/** Medial voxels of a volume file for ExtractOptions, distances for DistanceOptions, the surface of the part for
 * PartOptions: opens, plans, runs, writes, reports. All outputs appear complete or not at all, that which stands for
 * the job last.
 * \throw JobError with the exit status that the failure calls for
 * \throw StoppedBySignal when the sink asked to stop */
template <typename TOptions>
JobResult
RunJob(const TOptions & options, ProgressSink & sink);

} // end namespace medialvoxel

#endif
