// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelReport_h
#define medialvoxelReport_h

#include "JobResult.h"
#include "Options.h"

#include <optional>
#include <string>

namespace medialvoxel
{

/** Share of the candidate cells that was decided without, and with, geodesic search; nothing without candidates. */
struct PhasePercent
{
  double pseudo;
  double correct;
};
std::optional<PhasePercent>
GetPhasePercent(const itk::MedialVoxelCounts & counts);

/** The report as JSON. What depends on the run and the machine stands at the end, after the warnings: seconds,
 * peak_memory_bytes, bytes_read, threads, divisions. */
std::string
MakeReport(const ExtractOptions & options, const JobResult & result);
std::string
MakeReport(const DistanceOptions & options, const JobResult & result);
std::string
MakeReport(const PartOptions & options, const JobResult & result);

} // end namespace medialvoxel

#endif
