// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterWorker.h"
#include "JobClock.h"
#include "JobCommands.h"
#include "PipelineErrors.h"
#include "ProcessIdentity.h"
#include "SharedJob.h"
#include "StopListener.h"

#include <algorithm>
#include <filesystem>
#include <string>

namespace medialvoxel
{
namespace
{

ExtractOptions
GetOptions(const Manifest & manifest, const WorkOptions & options, const std::string & scratchFolder)
{
  ExtractOptions own = manifest.options;
  own.memoryBytes = options.memoryBytes ? options.memoryBytes : own.memoryBytes;
  own.threads = options.threads ? options.threads : own.threads;
  own.scratchFolder = scratchFolder.empty() ? own.scratchFolder : scratchFolder;
  own.divisions.reset(); // the pieces of a cluster are for the memory of this machine to decide
  return own;
}

bool
AreDone(const SharedJob & job, const std::vector<std::uint64_t> & clusters)
{
  return std::all_of(clusters.begin(), clusters.end(), [&job](std::uint64_t cluster) {
    itk::MedialVoxelPoll();
    return job.folder.ReadMarker(job.manifest, cluster).has_value();
  });
}

/** Which of several processes, on which machine, the following lines of a log are of. */
void
RecordJob(const SharedJob & job, const std::vector<std::uint64_t> & clusters, ProgressSink & sink)
{
  sink.Record({ LogLevel::Info,
                "job",
                { { "job", job.manifest.jobId },
                  { "folder", job.folder.GetPath().string() },
                  { "host", GetHostName() },
                  { "clusters", FormatClusters(clusters) } } });
}

} // namespace

WorkResult
RunWork(const WorkOptions & options, ProgressSink & sink)
{
  // Absolute, as the current folder may change.
  const std::string scratchFolder =
    options.scratchFolder.empty() ? "" : std::filesystem::absolute(options.scratchFolder).string();
  const SharedJob job = OpenSharedJob(options.jobFolder);
  const auto      clusters = ListClusters(options.clusters, job.manifest.numberOfClusters);
  WorkResult      result;
  if (job.folder.IsFinished(job.manifest))
  {
    result.skipped = clusters.size();
    return result;
  }
  const auto start = JobClock::now();
  try
  {
    WithPipelineErrors([&] {
      Job planned(GetOptions(job.manifest, options, scratchFolder));
      planned.PlanProcess();
      sink.Start("medialvoxel", "extracting medial voxels");
      const StopListener listener(&sink);
      RecordJob(job, clusters, sink);
      // Volumes whose clusters are done may have got their names.
      if (AreDone(job, clusters))
      {
        result.skipped = clusters.size();
        return;
      }
      planned.Open(sink);
      result = ClusterWorker(job, planned, sink).Run(clusters);
    });
  }
  catch (const StoppedBySignal & stop)
  {
    throw ResumableStop(stop.GetSignalNumber(), MakeWorkCommand(job.folder, clusters, job.manifest.numberOfClusters));
  }
  sink.Record({ LogLevel::Info,
                "clusters",
                { { "done", std::to_string(result.done.size()) }, { "skipped", std::to_string(result.skipped) } } });
  sink.Finish(SecondsSince(start));
  return result;
}

} // end namespace medialvoxel
