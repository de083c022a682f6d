// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PrepareJob.h"

#include "Leftovers.h"
#include "OutputChecks.h"
#include "Plan.h"
#include "ProcessMemory.h"
#include "UnpackedVolume.h"
#include "VolumeFormats.h"

#include "itkMultiThreaderBase.h"

#include <utility>

namespace medialvoxel
{
namespace
{

void
CheckScratchFolder(const JobOptions & options)
{
  std::error_code error;
  if (!options.scratchFolder.empty() && !std::filesystem::is_directory(options.scratchFolder, error))
  {
    Fail(ExitStatus::Refused, options.scratchFolder, ": the scratch folder does not exist");
  }
}

void
CheckFormats(const JobOptions & options, const JobResult & job)
{
  for (const OutputRequest & output : job.outputs)
  {
    if (output.layout)
    {
      CheckOutputFormat(output.fileName, job.input.geometry, *output.layout, options.compress);
    }
  }
}

void
SetNumberOfThreads(unsigned int threads)
{
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(threads);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
}

} // namespace

JobResult
PrepareJob(const JobOptions &         options,
           VolumeHeader               header,
           std::vector<OutputRequest> outputs,
           const PieceFootprint &     footprint)
{
  JobResult result;
  result.input = std::move(header);
  result.outputs = std::move(outputs);
  if (!options.logFile.empty())
  {
    result.outputs.push_back({ "log", options.logFile, std::nullopt, true });
  }
  CheckOutputs(result.outputs, result.input, options.overwrite);
  CheckFormats(options, result);
  CheckScratchFolder(options);
  result.plan = MakePlan(options, result.input, result.outputs, footprint);
  if (!options.dryRun)
  {
    RemoveLeftovers(result.outputs); // before space is taken for the new ones
  }
  PrepareProcess(result.plan);
  return result;
}

VolumeHeader
UnpackInput(const VolumeHeader & header, const JobPlan & plan, const ProgressSink & sink)
{
  return UnpackVolume(header, plan.scratchFolder, sink);
}

void
PrepareProcess(const JobPlan & plan)
{
  SetNumberOfThreads(plan.threads);
  GiveLargeBlocksBack();
}

} // end namespace medialvoxel
