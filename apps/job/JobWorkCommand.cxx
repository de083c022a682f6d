// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterWorker.h"
#include "ExtractParts.h"
#include "JobCommands.h"
#include "SharedJob.h"

namespace medialvoxel
{
namespace
{

ExtractOptions
GetOptions(const Manifest & manifest, const WorkOptions & options)
{
  ExtractOptions own = manifest.options;
  own.memoryBytes = options.memoryBytes ? options.memoryBytes : own.memoryBytes;
  own.threads = options.threads ? options.threads : own.threads;
  own.divisions.reset(); // the pieces of a cluster are for the memory of this machine to decide
  return own;
}

} // namespace

WorkResult
RunWork(const WorkOptions & options, ProgressSink & sink)
{
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
      const JobResult plan = PrepareSharedExtract(GetOptions(job.manifest, options));
      sink.Start("medialvoxel", "extracting medial voxels");
      ClusterWorker worker(job, plan, sink);
      result = worker.Run(clusters);
    });
  }
  catch (const StoppedBySignal & stop)
  {
    throw ResumableStop(stop.GetSignalNumber(), MakeWorkCommand(job.folder, clusters, job.manifest.numberOfClusters));
  }
  sink.Finish(SecondsSince(start));
  return result;
}

} // end namespace medialvoxel
