// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPrepareJob_h
#define medialvoxelPrepareJob_h

#include "JobResult.h"
#include "Options.h"
#include "OutputRequest.h"
#include "PieceFootprint.h"
#include "Progress.h"

#include <vector>

namespace medialvoxel
{

/** What all jobs do before their work begins: header, outputs, plan, threads. */
JobResult
PrepareJob(const JobOptions &         options,
           VolumeHeader               header,
           std::vector<OutputRequest> outputs,
           const PieceFootprint &     footprint);

/** Begins to unpack a compressed volume as planned; others stay as they are. The sink must outlive the reading.
 * \throw as UnpackVolume() */
VolumeHeader
UnpackInput(const VolumeHeader & header, const JobPlan & plan, const ProgressSink & sink);

/** Lets the process keep to the plan: its threads, and memory that is given back. */
void
PrepareProcess(const JobPlan & plan);

} // end namespace medialvoxel

#endif
