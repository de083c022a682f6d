// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FinishJob.h"

#include "PeakMemory.h"

namespace medialvoxel
{

void
AddMeasurements(JobResult & result, const InputVolume & input, double writeSeconds, JobClock::time_point start)
{
  result.seconds.distance = result.sums.distanceSeconds;
  result.seconds.classification = result.sums.classificationSeconds;
  result.seconds.tiles = result.sums.tileSeconds;
  result.seconds.inputOutput = input.GetReadSeconds() + writeSeconds;
  result.seconds.total = SecondsSince(start);
  result.bytesRead = input.GetNumberOfBytesRead();
  result.peakMemoryBytes = GetPeakMemoryBytes();
}

} // end namespace medialvoxel
