// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FinishJob.h"

#include "Plan.h"
#include "Warnings.h"

#include <cstddef>

namespace medialvoxel
{

void
FinishJob(Job & job, OutputSet & outputs, ProgressSink & sink, const JobEnd & end)
{
  JobResult &       result = job.result;
  const std::size_t told = result.warnings.size();
  outputs.FinishVolumes();
  const ProductEnd complete{ outputs, end.input, [&sink](double) { ThrowIfStopRequested(sink); } };
  for (const auto & product : job.products)
  {
    product->Complete(result, complete);
  }
  ThrowIfStopRequested(sink);
  end.recordCosts();
  for (const auto & product : job.products)
  {
    product->Describe(result);
  }
  for (const auto & product : job.products)
  {
    product->WriteFile(result);
  }
  end.publish();
  if (result.plan.unpackedBytes > 0)
  {
    sink.Note(result.input.fileName.string() +
              " is compressed and was unpacked once: " + DescribeUnpacking(result.plan));
  }
  TellWarnings(sink, result.warnings, told);
}

} // end namespace medialvoxel
