// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobCommands.h"
#include "Progress.h"
#include "SharedJob.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{
namespace
{

void
RefuseOtherJob(ExtractOptions options, const JobFolder & folder)
{
  const Manifest manifest = folder.ReadManifest();
  if (options.divisions)
  {
    options.divisions = std::min(*options.divisions, manifest.GetMostClusters());
  }
  if (options.lowerIsOtsu && manifest.options.lowerIsOtsu)
  {
    options.lowerThreshold = manifest.options.lowerThreshold; // was measured on the same input
  }
  options.roughness = manifest.options.roughness; // was measured, too
  options.smoothingLevel = manifest.options.smoothingLevel;
  options.measure = manifest.options.measure;
  options.neededMaximum = manifest.options.neededMaximum;
  const std::string difference = FindDifference(WithAbsoluteNames(options, std::filesystem::current_path()),
                                                WithAbsoluteNames(manifest.options, manifest.folder));
  if (!difference.empty())
  {
    Fail(ExitStatus::Refused,
         folder.GetPath().string(),
         " is of a job with other options: ",
         difference,
         "; remove the folder, and the files that end with ",
         manifest.GetSuffix(),
         ", to begin anew");
  }
  CheckUnchanged(manifest.input);
}

} // namespace

std::string
GetResumeFolder(const ExtractOptions & options)
{
  return options.output + ".job";
}

FinalizeResult
RunResumable(const ExtractOptions & options, const std::string & command, ProgressSink & sink)
{
  const JobFolder   folder(GetResumeFolder(options));
  const std::string name = folder.GetPath().string(); // absolute, as the current folder may change
  const bool        continues = folder.IsPlanned();
  if (continues)
  {
    RefuseOtherJob(options, folder);
  }
  else
  {
    PlanOptions plan;
    static_cast<ExtractOptions &>(plan) = options;
    plan.jobFolder = name;
    JobResult job = RunPlan(plan, sink);
    if (options.dryRun)
    {
      return { options, std::move(job) };
    }
  }
  try
  {
    RunWork({ name, {}, options.memoryLimit, options.threads, options.scratchFolder }, sink);
    // The files of this process need no second look.
    FinalizeResult result = RunFinalize({ name, continues, options.overwrite }, sink);
    folder.RemoveFinished();
    return result;
  }
  catch (const StoppedBySignal & stop)
  {
    throw ResumableStop(stop.GetSignalNumber(), command);
  }
}

} // end namespace medialvoxel
