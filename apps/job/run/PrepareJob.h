// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPrepareJob_h
#define medialvoxelPrepareJob_h

#include "JobResult.h"
#include "Options.h"
#include "OutputRequest.h"
#include "PieceFootprint.h"

#include <vector>

namespace medialvoxel
{

/** What all jobs do before their work begins: header, outputs, plan, threads. */
JobResult
PrepareJob(const JobOptions &         options,
           VolumeHeader               header,
           std::vector<OutputRequest> outputs,
           const PieceFootprint &     footprint);

/** Lets the process keep to the plan: its threads, and memory that is given back. */
void
PrepareProcess(const JobPlan & plan);

} // end namespace medialvoxel

#endif
