// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "RunJob.h"

#include "JobClock.h"
#include "JobRun.h"
#include "PipelineErrors.h"
#include "ProcessMemory.h"
#include "StopListener.h"
#include "Warnings.h"

#include <utility>

namespace medialvoxel
{
namespace
{

void
RecordCosts(JobResult & result, const InputVolume & input, double writeSeconds, JobClock::time_point start)
{
  result.seconds.distance = result.sums.distanceSeconds;
  result.seconds.classification = result.sums.classificationSeconds;
  result.seconds.tiles = result.sums.tileSeconds;
  result.seconds.inputOutput = input.GetSource().GetReadSeconds() + writeSeconds - result.seconds.remeshing -
                               result.seconds.topology - result.seconds.walls;
  result.seconds.total = SecondsSince(start);
  result.bytesRead = input.GetSource().GetNumberOfBytesRead();
  result.peakMemory = GetPeakMemory();
}

void
RunPlanned(Job & job, ProgressSink & sink, JobClock::time_point start)
{
  JobResult &     result = job.result;
  const JobPlan & plan = result.plan;
  OutputSet       outputs(job.options, plan.writesBehind);
  JobRun          run(job, outputs, sink);
  run.Prepare();
  for (std::uint64_t piece = 0; piece < plan.divisions; ++piece)
  {
    result.sums += run.Run(plan.GetPiece(piece), plan.GetNextPiece(piece));
  }
  run.Finish();
  const auto finishStart = JobClock::now();
  JobEnd     end;
  end.input = &run.GetInput();
  end.recordCosts = [&] {
    RecordCosts(result, run.GetInput(), run.GetWriteSeconds() + SecondsSince(finishStart), start);
  };
  end.publish = [&outputs] { outputs.Publish(); };
  job.Finish(outputs, sink, end);
}

} // namespace

template <typename TOptions>
JobResult
RunJob(const TOptions & options, ProgressSink & sink)
{
  const auto start = JobClock::now();
  Job        job(options);
  job.Plan();
  TellWarnings(sink, job.result.warnings);
  if (!options.dryRun)
  {
    job.Open(sink);
    job.CheckValues(sink);
    WithPipelineErrors([&] {
      sink.Start("medialvoxel", job.GetTitle());
      const StopListener listener(&sink);
      job.Prepare(sink);
      RunPlanned(job, sink, start);
    });
    sink.Finish(job.result.seconds.total);
  }
  return std::move(job.result);
}

template JobResult
RunJob(const ExtractOptions &, ProgressSink &);
template JobResult
RunJob(const DistanceOptions &, ProgressSink &);
template JobResult
RunJob(const PartOptions &, ProgressSink &);

} // end namespace medialvoxel
