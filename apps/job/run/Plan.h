// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlan_h
#define medialvoxelPlan_h

#include "JobPlan.h"
#include "Options.h"
#include "OutputRequest.h"
#include "Footprint.h"
#include "Text.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** The part of a plan that memory decides: threads, slabs, pieces, scratch folder and limits.
 * \throw JobError Refused when nothing fits. */
JobPlan
FitToMemory(const JobOptions & options, const VolumeHeader & header, const Footprint & footprint);

/** Divides the work so that it fits the memory.
 * \throw JobError Refused when it cannot, or when a disk has no space for the outputs and scratch files. */
JobPlan
MakePlan(const JobOptions &                 options,
         const VolumeHeader &               header,
         const std::vector<OutputRequest> & outputs,
         const Footprint &                  footprint);

/** How much is unpacked of a compressed volume, and where to. */
std::string
DescribeUnpacking(const JobPlan & plan);

/** The plan as names and values to print. */
TextTable
DescribePlan(const JobPlan & plan, const VolumeHeader & header, const std::vector<OutputRequest> & outputs);

} // end namespace medialvoxel

#endif
