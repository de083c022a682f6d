// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeJob_h
#define medialvoxelVolumeJob_h

#include "JobResult.h"
#include "Options.h"
#include "Progress.h"

namespace medialvoxel
{

/** Medial voxels of a volume file: opens, plans, runs, writes, reports. All outputs appear complete or not at all, the
 * labels last.
 * \throw JobError with the exit status that the failure calls for
 * \throw StoppedBySignal when the sink asked to stop */
JobResult
RunExtract(const ExtractOptions & options, ProgressSink & sink);

/** Vector distances of a volume file, and signed distances; errors as RunExtract(). The vectors appear last. */
JobResult
RunDistance(const DistanceOptions & options, ProgressSink & sink);

/** The surface of the part in a volume file, with its thickness at each vertex; errors as RunExtract(). */
JobResult
RunSurface(const SurfaceOptions & options, ProgressSink & sink);

} // end namespace medialvoxel

#endif
