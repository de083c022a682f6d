// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FinishJob.h"

#include "Plan.h"
#include "ProcessMemory.h"
#include "Warnings.h"

#include <cstddef>

namespace medialvoxel
{

void
FinishJob(OutputSet & outputs, JobSummary & summary, JobResult & result, ProgressSink & sink, const JobEnd & end)
{
  const std::size_t told = result.warnings.size();
  outputs.FinishVolumes();
  summary.Draw(outputs, result.input.geometry);
  if (end.complete)
  {
    end.complete();
  }
  ThrowIfStopRequested(sink);
  end.recordCosts();
  summary.Write(result);
  if (end.publish)
  {
    end.publish();
  }
  else
  {
    outputs.Publish();
  }
  if (result.plan.unpackedBytes > 0)
  {
    sink.Note(result.input.fileName.string() +
              " is compressed and was unpacked once: " + DescribeUnpacking(result.plan));
  }
  TellWarnings(sink, result.warnings, told);
}

void
AddMeasurements(JobResult & result, const InputVolume & input, double writeSeconds, JobClock::time_point start)
{
  result.seconds.distance = result.sums.distanceSeconds;
  result.seconds.classification = result.sums.classificationSeconds;
  result.seconds.tiles = result.sums.tileSeconds;
  result.seconds.inputOutput = input.GetSource().GetReadSeconds() + writeSeconds;
  result.seconds.total = SecondsSince(start);
  result.bytesRead = input.GetSource().GetNumberOfBytesRead();
  result.peakMemoryBytes = GetPeakMemoryBytes();
}

} // end namespace medialvoxel
