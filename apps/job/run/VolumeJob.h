// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeJob_h
#define medialvoxelVolumeJob_h

#include "Options.h"
#include "PieceRunner.h"
#include "Plan.h"
#include "Progress.h"
#include "SurfaceSummary.h"
#include "ThicknessSummary.h"
#include "Warnings.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** Seconds of a job. Those of the kernels are summed over threads, the others pass on the wall. */
struct JobSeconds
{
  double distance{ 0.0 };
  double classification{ 0.0 };
  double tiles{ 0.0 }; ///< while threads worked on tiles
  double inputOutput{ 0.0 };
  double total{ 0.0 };
};

/** What a job did, or with dryRun would do. */
struct JobResult
{
  VolumeHeader                         input;
  std::vector<OutputRequest>           outputs;
  JobPlan                              plan;
  RunnerSums                           sums;
  std::optional<itk::MedialVoxelLimit> otsu;      ///< lower threshold, when it was measured
  std::optional<ThicknessSummary>      thickness; ///< of an extraction
  std::optional<SurfaceSummary>        surface;   ///< when a mesh was asked for
  std::vector<Warning>                 warnings;
  JobSeconds                           seconds;
  std::uint64_t                        peakMemoryBytes{ 0 }; ///< of the process
  std::uint64_t                        bytesRead{ 0 };
};

/** Medial voxels of a volume file: opens, plans, runs, writes, reports. All outputs appear complete or not at all, the
 * labels last.
 * \throw JobError with the exit status that the failure calls for
 * \throw StoppedBySignal when the sink asked to stop */
JobResult
RunExtract(const ExtractOptions & options, ProgressSink & sink);

/** Vector distances of a volume file, and signed distances; errors as RunExtract(). The vectors appear last. */
JobResult
RunDistance(const DistanceOptions & options, ProgressSink & sink);

} // end namespace medialvoxel

#endif
