// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobResult_h
#define medialvoxelJobResult_h

#include "JobPlan.h"
#include "NamedCounts.h"
#include "ObjectSummary.h"
#include "Options.h"
#include "OutputRequest.h"
#include "PartSummary.h"
#include "PlaceSummary.h"
#include "Segments.h"
#include "SurfaceSummary.h"
#include "ThicknessSummary.h"
#include "VolumeHeader.h"
#include "Warning.h"

#include "itkMedialVoxelLimit.h"
#include "itkMedialVoxelSums.h"

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
  double remeshing{ 0.0 }; ///< of the medial surface
  double total{ 0.0 };
};

/** What a job did, or with dryRun would do. */
struct JobResult
{
  VolumeHeader                             input;
  std::vector<OutputRequest>               outputs;
  JobPlan                                  plan;
  itk::MedialVoxelSums                     sums;
  std::optional<itk::MedialVoxelLimit>     otsu;      ///< lower threshold, when it was measured
  std::optional<itk::MedialVoxelRoughness> roughness; ///< of the object, when it was measured
  std::optional<WallMeasure>               measure;   ///< of walls, where these are measured
  std::optional<ThicknessSummary>          thickness; ///< of an extraction
  std::vector<PlaceSummary>                places;    ///< with too thin or too thick walls; of the kinds looked for
  std::optional<LabelMapSummary>           objects;   ///< of a label map
  SegmentTable                             segments;  ///< names of its labels; empty: there are none
  std::optional<SurfaceSummary>            surface;   ///< when a mesh was asked for
  std::optional<PartSummary>               part;      ///< of its surface
  std::vector<Warning>                     warnings;
  JobSeconds                               seconds;
  std::uint64_t                            peakMemoryBytes{ 0 }; ///< of the process
  std::uint64_t                            bytesRead{ 0 };
};

/** What a run says of thin walls. */
enum class WallVerdict
{
  Good,
  TooThin,    ///< there are thin places, whatever else was not measured
  NotMeasured ///< there are none, but too little was measured to know
};

WallVerdict
GetVerdict(const JobResult & result);

/** Whether the object of an extraction was smoothed. */
bool
IsSmoothed(const ExtractOptions & options, const JobResult & result);

/** The same for a reader, with the roughness that decided. */
std::string
DescribeSmoothing(const ExtractOptions & options, const JobResult & result);

} // end namespace medialvoxel

#endif
