// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterRange.h"
#include "DataFile.h"
#include "FileNames.h"
#include "JobClock.h"
#include "JobCommands.h"
#include "Leftovers.h"
#include "OutputChecks.h"
#include "PipelineErrors.h"
#include "JobRun.h"
#include "SharedJob.h"
#include "SharedOutputs.h"
#include "StopListener.h"
#include "UnpackedVolume.h"
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
    itk::MedialVoxelCheckAbort();
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

/** Times and bytes are sums over the clusters; memory and threads come from the largest process. */
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
  job.peakMemory = std::max(job.peakMemory, marker.peakMemory);
  job.plan.memory.planned = std::max(job.plan.memory.planned, marker.plannedMemory);
  job.plan.memory.limit = std::max(job.plan.memory.limit, marker.memoryLimit);
  job.plan.threads = std::max(job.plan.threads, marker.threads);
}

/** \class Finalization
 * \brief From the parts of a job that is done to its outputs. */
class Finalization
{
public:
  Finalization(const SharedJob & shared, bool overwrite, ProgressSink & sink)
    : m_Shared(shared)
    , m_Sink(sink)
    , m_Markers(ReadMarkers(shared))
    , m_Job(shared.manifest.options)
  {
    const ExtractOptions & options = shared.manifest.options;
    JobResult &            result = m_Job.result;
    result.otsu = options.lowerIsOtsu ? options.lowerThreshold : std::nullopt;
    result.roughness = options.roughness;
    result.wallMeasure = options.measure;
    result.plan.numberOfSlices = shared.manifest.numberOfSlices;
    result.plan.divisions = shared.manifest.numberOfClusters;
    m_Job.options.overwrite |= overwrite;
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
    this->MergeClusters();
    this->OpenInput();
    JobEnd end;
    end.recordCosts = [this, start] { m_Job.result.seconds.total += SecondsSince(start); };
    end.publish = [this] { this->Publish(); };
    m_Job.Finish(*m_Outputs, m_Sink, end);
    return std::move(m_Job.result);
  }

private:
  /** An interrupted publication left names of ours, which are to be replaced then. */
  void
  OpenOutputs()
  {
    const std::optional<DataNames> begun = m_Shared.folder.ReadDataNames(m_Shared.manifest);
    m_Job.options.overwrite |= begun.has_value();
    CheckOutputs(m_Job.result.outputs, m_Job.result.input, m_Job.options.overwrite);
    RemoveLeftovers(m_Job.result.outputs); // of a volume that the end fills
    m_DataNames = begun ? *begun : this->ChooseDataNames();
    std::map<std::string, Publication> names;
    for (const auto & [role, name] : m_DataNames.chosen)
    {
      names[role] = { name, begun.has_value(), m_DataNames.replaced[role] };
    }
    m_Outputs = std::make_unique<SharedOutputs>(m_Job, m_Shared.manifest.GetSuffix(), names);
    ProductStart start{ m_Job.result };
    for (const auto & product : m_Job.products)
    {
      product->Start(start);
      product->MakeFile(*m_Outputs);
    }
  }

  DataNames
  ChooseDataNames() const
  {
    DataNames names;
    for (const OutputRequest & output : m_Job.result.outputs)
    {
      if (output.IsVolume())
      {
        names.chosen[output.role] = MakeSharedVolume(output.fileName, m_Job.options)->FindFreeDataName().string();
        names.replaced[output.role] = FindDataFile(FollowLinks(output.fileName)).string();
      }
    }
    return names;
  }

  void
  VerifyVolumes()
  {
    const auto                 start = JobClock::now();
    std::vector<std::uint64_t> damaged;
    const std::uint64_t        perSlice = m_Job.result.input.geometry.GetVoxelsPerSlice();
    for (std::uint64_t cluster = 0; cluster < m_Markers.size(); ++cluster)
    {
      ThrowIfStopRequested(m_Sink);
      const SliceRange    range = m_Shared.manifest.GetCluster(cluster);
      const std::uint64_t first = range.begin * perSlice;
      const std::uint64_t voxels = (range.end - range.begin) * perSlice;
      const auto &        checksums = m_Markers[cluster].checksums;
      const auto &        volumes = m_Outputs->GetVolumes();
      const bool          isWhole = std::all_of(volumes.begin(), volumes.end(), [&](const auto & volume) {
        const auto checksum = checksums.find(volume.first);
        return checksum != checksums.end() && volume.second->ReadChecksum(first, voxels) == checksum->second;
      });
      if (!isWhole)
      {
        damaged.push_back(cluster);
      }
      m_Sink.Report(static_cast<double>(cluster + 1) / static_cast<double>(m_Markers.size()));
    }
    this->RefuseDamaged(damaged);
    m_Sink.Record({ LogLevel::Info,
                    "verified",
                    { { "clusters", std::to_string(m_Markers.size()) },
                      { "bytes", std::to_string(m_Shared.manifest.perSlice * m_Shared.manifest.numberOfSlices) },
                      { "seconds", FormatFixed(SecondsSince(start), 3) } } });
  }

  void
  MergeClusters()
  {
    std::vector<std::uint64_t> damaged;
    for (std::uint64_t cluster = 0; cluster < m_Markers.size(); ++cluster)
    {
      ThrowIfStopRequested(m_Sink);
      AddMarker(m_Job.result, m_Markers[cluster]);
      const std::optional<std::string> part = m_Shared.folder.ReadSurvey(cluster, m_Markers[cluster]);
      if (part)
      {
        MergeSurveys(m_Job.products, *part);
      }
      else
      {
        damaged.push_back(cluster);
      }
    }
    this->RefuseDamaged(damaged);
    CheckCounts(m_Job.result.sums.counts);
  }

  /** Unpacks a compressed volume again for the sections of a page. */
  void
  OpenInput()
  {
    const ExtractOptions & options = m_Shared.manifest.options;
    if (!options.htmlFile.empty() && ListsPlaces(options))
    {
      m_Job.result.input = UnpackVolume(m_Job.result.input, options.scratchFolder, m_Sink);
    }
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
    CheckOutputs(m_Job.result.outputs, m_Job.result.input, m_Job.options.overwrite);
    m_Shared.folder.WriteDataNames(m_Shared.manifest, m_DataNames);
    m_Outputs->Publish();
    // Replaced files go before the job counts as finished, or nobody would remove them.
    m_Outputs.reset();
    m_Shared.folder.WriteFinished(m_Shared.manifest, GetVerdict(m_Job.result));
    RemoveSharedCells(m_Shared.manifest);
    m_Sink.Record({ LogLevel::Info, "published", { { "job", m_Shared.manifest.jobId } } });
  }

  const SharedJob &              m_Shared;
  ProgressSink &                 m_Sink;
  std::vector<ClusterMarker>     m_Markers;
  Job                            m_Job;
  DataNames                      m_DataNames;
  std::unique_ptr<SharedOutputs> m_Outputs;
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
    RemoveSharedCells(job.manifest);
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
