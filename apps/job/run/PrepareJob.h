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

/** The candidates that have a name. */
std::vector<OutputRequest>
SelectOutputs(const std::vector<OutputRequest> & candidates);

/** What all jobs do before their work begins: header, outputs, plan, threads. Candidates without a name drop out. */
JobResult
PrepareJob(const JobOptions &                 options,
           VolumeHeader                       header,
           const std::vector<OutputRequest> & candidates,
           const PieceFootprint &             footprint);

/** Lets the process keep to the plan: its threads, and memory that is given back. */
void
PrepareProcess(const JobPlan & plan);

} // end namespace medialvoxel

#endif
