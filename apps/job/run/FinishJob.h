// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFinishJob_h
#define medialvoxelFinishJob_h

#include "Job.h"
#include "Progress.h"

#include <functional>

namespace medialvoxel
{

/** What differs from one end of a job to another. */
struct JobEnd
{
  InputVolume *         input{ nullptr }; ///< of the run, if this process had one
  std::function<void()> recordCosts;      ///< fills in what the job took
  std::function<void()> publish;          ///< gives the outputs their names
};

/** The end of every job: volumes, products, costs, texts, names; then the sink hears of new warnings.
 * \throw StoppedBySignal when the sink asks to stop; no output has its name then. */
void
FinishJob(Job & job, OutputSet & outputs, ProgressSink & sink, const JobEnd & end);

} // end namespace medialvoxel

#endif
