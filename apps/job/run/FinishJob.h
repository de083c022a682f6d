// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFinishJob_h
#define medialvoxelFinishJob_h

#include "InputVolume.h"
#include "JobClock.h"
#include "JobResult.h"

namespace medialvoxel
{

/** Fills in what the job took up to now. */
void
AddMeasurements(JobResult & result, const InputVolume & input, double writeSeconds, JobClock::time_point start);

} // end namespace medialvoxel

#endif
