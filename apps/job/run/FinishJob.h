// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFinishJob_h
#define medialvoxelFinishJob_h

#include "InputVolume.h"
#include "JobClock.h"
#include "JobResult.h"
#include "OutputSet.h"
#include "Progress.h"

#include <functional>

namespace medialvoxel
{

/** \class JobSummary
 * \brief The outputs of a job that are made at its end. */
class JobSummary
{
public:
  virtual ~JobSummary() = default;

  /** Draws what the finished volumes show. */
  virtual void
  Draw(const OutputSet &, const VolumeGeometry &)
  {}

  /** Adds to the result what the end of the job tells, and writes the texts. */
  virtual void
  Write(JobResult & result) = 0;
};

/** What a job has to do at its end beside what all jobs do. */
struct JobEnd
{
  std::function<void()> recordCosts; ///< fills in what the job took
  std::function<void()> publish;     ///< unset: the outputs get their names, and no more happens

  std::function<void()> complete{}; ///< makes what needs all volumes; unset: nothing does
};

/** The end of every job: volumes, pictures, measurements, texts, names; then the sink hears of new warnings.
 * \throw StoppedBySignal when the sink asks to stop; no output has its name then. */
void
FinishJob(OutputSet & outputs, JobSummary & summary, JobResult & result, ProgressSink & sink, const JobEnd & end);

/** Fills in what the job took up to now. */
void
AddMeasurements(JobResult & result, const InputVolume & input, double writeSeconds, JobClock::time_point start);

} // end namespace medialvoxel

#endif
