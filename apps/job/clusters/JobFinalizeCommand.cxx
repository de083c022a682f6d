// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterRange.h"
#include "DataFile.h"
#include "ExtractParts.h"
#include "ExtractRun.h"
#include "ExtractSummary.h"
#include "FinishJob.h"
#include "Outputs.h"
#include "FileNames.h"
#include "JobClock.h"
#include "JobCommands.h"
#include "OutputChecks.h"
#include "PipelineErrors.h"
#include "SharedJob.h"
#include "StopListener.h"
#include "Warnings.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{
namespace
{

[[noreturn]] void
RefuseMissing(const SharedJob & job, const std::vector<std::uint64_t> & missing)
{
  Fail(ExitStatus::Failure,
       missing.size(),
       " of ",
       job.manifest.numberOfClusters,
       " clusters are not done: ",
       FormatClusters(missing),
       "; to do them: ",
       MakeWorkCommand(job.folder, missing, job.manifest.numberOfClusters));
}

std::vector<ClusterMarker>
ReadMarkers(const SharedJob & job)
{
  std::vector<ClusterMarker> markers;
  std::vector<std::uint64_t> missing;
  for (std::uint64_t cluster = 0; cluster < job.manifest.numberOfClusters; ++cluster)
  {
    itk::MedialVoxelPoll();
    std::optional<ClusterMarker> marker = job.folder.ReadMarker(job.manifest, cluster);
    if (marker)
    {
      markers.push_back(*std::move(marker));
    }
    else
    {
      missing.push_back(cluster);
    }
  }
  if (!missing.empty())
  {
    RefuseMissing(job, missing);
  }
  return markers;
}

/** Times and bytes are sums over the clusters; memory and threads those of the largest process. */
void
AddMarker(JobResult & job, const ClusterMarker & marker)
{
  job.sums += marker.sums;
  job.seconds.distance += marker.seconds.distance;
  job.seconds.classification += marker.seconds.classification;
  job.seconds.tiles += marker.seconds.tiles;
  job.seconds.inputOutput += marker.seconds.inputOutput;
  job.seconds.total += marker.seconds.total;
  job.bytesRead += marker.bytesRead;
  job.peakMemoryBytes = std::max(job.peakMemoryBytes, marker.peakMemoryBytes);
  job.plan.memoryBytes = std::max(job.plan.memoryBytes, marker.plannedMemoryBytes);
  job.plan.memoryLimit = std::max(job.plan.memoryLimit, marker.memoryLimit);
  job.plan.threads = std::max(job.plan.threads, marker.threads);
}

/** \class Finalization
 * \brief From the parts of a job that is done to its outputs. */
class Finalization
{
public:
  Finalization(const SharedJob & shared, bool overwrite, ProgressSink & sink)
    : m_Shared(shared)
    , m_Options(WithOverwrite(shared.manifest.options, overwrite))
    , m_Sink(sink)
    , m_Markers(ReadMarkers(shared))
    , m_Job(DescribeExtract(m_Options))
    , m_Surveys(m_Job.input.geometry, GetGrid(m_Options, m_Job.input), GetSurveyRequest(m_Options), 0)
  {
    m_Job.otsu = m_Options.lowerIsOtsu ? m_Options.lowerThreshold : std::nullopt;
    m_Job.roughness = m_Options.roughness;
    m_Job.wallMeasure = m_Options.measure;
    m_Job.plan.numberOfSlices = shared.manifest.numberOfSlices;
    m_Job.plan.divisions = shared.manifest.numberOfClusters;
  }

  JobResult
  Run(bool verifies)
  {
    const auto start = JobClock::now();
    this->OpenOutputs();
    if (verifies)
    {
      this->VerifyVolumes();
    }
    this->MergeParts();
    ExtractSummary summary(m_Options, m_Surveys, *m_Outputs);
    JobEnd         end;
    end.recordCosts = [this, start] { m_Job.seconds.total += SecondsSince(start); };
    end.publish = [this] { this->Publish(); };
    FinishJob(*m_Outputs, summary, m_Job, m_Sink, end);
    return std::move(m_Job);
  }

private:
  static ExtractOptions
  WithOverwrite(ExtractOptions options, bool overwrite)
  {
    options.overwrite = options.overwrite || overwrite;
    return options;
  }

  /** An interrupted publication left names of ours, which are to be replaced then. */
  void
  OpenOutputs()
  {
    m_Requests = ListVolumes(m_Options, m_Job.input);
    const std::optional<DataNames> begun = m_Shared.folder.ReadDataNames(m_Shared.manifest);
    m_Options.overwrite = m_Options.overwrite || begun;
    CheckOutputs(m_Job.outputs, m_Job.input, m_Options.overwrite);
    m_DataNames = begun ? *begun : this->ChooseDataNames();
    m_Outputs = std::make_unique<OutputSet>(m_Options, false, m_Shared.manifest.GetSuffix());
    for (const VolumeRequest & request : m_Requests)
    {
      m_Volumes.push_back(m_Outputs->AddCompletedVolume(
        request, { m_DataNames.chosen[request.role], begun.has_value(), m_DataNames.replaced[request.role] }));
    }
  }

  DataNames
  ChooseDataNames() const
  {
    DataNames names;
    for (const VolumeRequest & request : m_Requests)
    {
      names.chosen[request.role] = MakeSharedVolume(request.fileName, m_Options)->FindFreeDataName().string();
      names.replaced[request.role] = FindDataFile(FollowLinks(request.fileName)).string();
    }
    return names;
  }

  void
  VerifyVolumes()
  {
    const auto                 start = JobClock::now();
    std::vector<std::uint64_t> damaged;
    const std::uint64_t        perSlice = m_Job.input.geometry.GetVoxelsPerSlice();
    for (std::uint64_t cluster = 0; cluster < m_Markers.size(); ++cluster)
    {
      ThrowIfStopRequested(m_Sink);
      const SliceRange range = m_Shared.manifest.GetCluster(cluster);
      for (std::size_t i = 0; i < m_Volumes.size(); ++i)
      {
        const auto checksum = m_Markers[cluster].checksums.find(m_Requests[i].role);
        if (checksum == m_Markers[cluster].checksums.end() ||
            m_Volumes[i]->ReadChecksum(range.begin * perSlice, (range.end - range.begin) * perSlice) !=
              checksum->second)
        {
          damaged.push_back(cluster);
          break;
        }
      }
      m_Sink.Report(static_cast<double>(cluster + 1) / static_cast<double>(m_Markers.size()));
    }
    this->RefuseDamaged(damaged);
    m_Sink.Record({ LogLevel::Info,
                    "verified",
                    { { "clusters", std::to_string(m_Markers.size()) },
                      { "bytes", std::to_string(m_Shared.manifest.bytesPerSlice * m_Shared.manifest.numberOfSlices) },
                      { "seconds", FormatFixed(SecondsSince(start), 3) } } });
  }

  void
  MergeParts()
  {
    std::vector<std::uint64_t> damaged;
    for (std::uint64_t cluster = 0; cluster < m_Markers.size(); ++cluster)
    {
      ThrowIfStopRequested(m_Sink);
      AddMarker(m_Job, m_Markers[cluster]);
      const std::optional<std::string> part = m_Shared.folder.ReadSurvey(cluster, m_Markers[cluster]);
      if (part)
      {
        m_Surveys.Merge(*part);
      }
      else
      {
        damaged.push_back(cluster);
      }
    }
    this->RefuseDamaged(damaged);
    CheckCounts(m_Job.sums.counts);
  }

  /** Lets damaged clusters be done again. */
  void
  RefuseDamaged(const std::vector<std::uint64_t> & damaged) const
  {
    if (damaged.empty())
    {
      return;
    }
    std::for_each(
      damaged.begin(), damaged.end(), [this](std::uint64_t cluster) { m_Shared.folder.RemoveMarker(cluster); });
    Fail(ExitStatus::Failure,
         "the files of ",
         damaged.size(),
         " clusters do not have the checksums that they were written with: ",
         FormatClusters(damaged),
         "; compute them again: ",
         MakeWorkCommand(m_Shared.folder, damaged, m_Shared.manifest.numberOfClusters));
  }

  void
  Publish()
  {
    CheckOutputs(m_Job.outputs, m_Job.input, m_Options.overwrite);
    m_Shared.folder.WriteDataNames(m_Shared.manifest, m_DataNames);
    m_Outputs->Publish();
    // What was replaced goes before the job counts as finished, or nobody would remove it.
    m_Volumes.clear();
    m_Outputs.reset();
    m_Shared.folder.WriteFinished(m_Shared.manifest, GetVerdict(m_Job));
    m_Sink.Record({ LogLevel::Info, "published", { { "job", m_Shared.manifest.jobId } } });
  }

  const SharedJob &           m_Shared;
  ExtractOptions              m_Options;
  ProgressSink &              m_Sink;
  std::vector<ClusterMarker>  m_Markers;
  JobResult                   m_Job;
  Surveys                     m_Surveys;
  std::vector<VolumeRequest>  m_Requests;
  DataNames                   m_DataNames;
  std::unique_ptr<OutputSet>  m_Outputs;
  std::vector<SharedVolume *> m_Volumes;
};

} // namespace

FinalizeResult
RunFinalize(const FinalizeOptions & options, ProgressSink & sink)
{
  const SharedJob job = OpenSharedJob(options.jobFolder);
  FinalizeResult  result{ job.manifest.options, std::nullopt };
  JobLocks        locks(job.folder.GetLocksName());
  const auto      lock = locks.TryLock(JobLocks::Finalizing);
  if (!lock)
  {
    Fail(ExitStatus::Failure, job.folder.GetPath().string(), ": another process is finalizing this job");
  }
  if (job.folder.IsFinished(job.manifest))
  {
    result.verdict = job.folder.GetVerdict(job.manifest);
    return result;
  }
  try
  {
    WithPipelineErrors([&] {
      sink.Start("medialvoxel", "verifying and publishing");
      const StopListener listener(&sink);
      result.job = Finalization(job, options.overwrite, sink).Run(options.verifies);
      result.verdict = GetVerdict(*result.job);
      sink.Finish(result.job->seconds.total);
    });
  }
  catch (const StoppedBySignal & stop)
  {
    throw ResumableStop(stop.GetSignalNumber(), "medialvoxel finalize " + Quote(job.folder.GetPath().string()));
  }
  return result;
}

} // end namespace medialvoxel
