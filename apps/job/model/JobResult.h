// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobResult_h
#define medialvoxelJobResult_h

#include "JobPlan.h"
#include "Json.h"
#include "NamedCounts.h"
#include "Options.h"
#include "OutputRequest.h"
#include "PlaceSummary.h"
#include "Segments.h"
#include "SheetSummary.h"
#include "VolumeHeader.h"
#include "Warning.h"

#include "itkMedialVoxelExactNumber.h"
#include "itkMedialVoxelSheetWalls.h"
#include "itkMedialVoxelSums.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** Seconds of a job. The kernels are summed over threads, the others are elapsed time. */
struct JobSeconds
{
  double distance{ 0.0 };
  double classification{ 0.0 };
  double tiles{ 0.0 }; ///< while threads worked on tiles
  double inputOutput{ 0.0 };
  double remeshing{ 0.0 }; ///< of the medial surface
  double topology{ 0.0 };  ///< to add cells for it
  double walls{ 0.0 };     ///< to number them
  double total{ 0.0 };
};

/** The result of a job; with dryRun its plan. */
struct JobResult
{
  VolumeHeader                                  input;
  std::vector<OutputRequest>                    outputs;
  JobPlan                                       plan;
  itk::MedialVoxelSums                          sums;
  std::optional<itk::MedialVoxelExactNumber>    otsu;           ///< lower threshold, when it was measured
  std::optional<itk::MedialVoxelRoughness>      roughness;      ///< of the object, when it was measured
  std::optional<itk::MedialVoxelSmoothingLevel> smoothingLevel; ///< of the object, when it was smoothed
  std::optional<WallMeasure>                    wallMeasure;    ///< of walls, where these are measured
  Json                                          thickness;      ///< of an extraction, as in the report
  Json                                          uncertainty;    ///< of that thickness; null: it is not known
  std::vector<PlaceSummary>                     places;   ///< with too thin or too thick walls; of the kinds looked for
  Json                                          objects;  ///< of a label map, with the passes it took; null: it is none
  SegmentTable                                  segments; ///< names of its labels; empty: there are none
  std::optional<SheetSummary>                   surface;  ///< when a mesh was asked for
  Json                                          topology; ///< of the object and the labels, when that was asked for
  std::optional<itk::MedialVoxelSheetWalls>     walls;    ///< and seams, when these were asked for
  std::vector<std::uint32_t>                    wallOfPoint; ///< walls of the points of the page; empty: not asked for
  Json                                          part;        ///< its surface, when that was asked for
  std::vector<Warning>                          warnings;
  JobSeconds                                    seconds;
  std::uint64_t                                 peakMemory{ 0 }; ///< of the process
  std::uint64_t                                 bytesRead{ 0 };
  Json                                          report; ///< all of it that is shown, at the end of the job
};

/** The verdict of a run on thin walls. */
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

} // end namespace medialvoxel

#endif
