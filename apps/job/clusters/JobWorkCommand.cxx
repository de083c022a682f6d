// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterRange.h"
#include "Errors.h"
#include "JobClock.h"
#include "JobCommands.h"
#include "JobRun.h"
#include "PipelineErrors.h"
#include "ProcessIdentity.h"
#include "ProcessMemory.h"
#include "SharedJob.h"
#include "SharedOutputs.h"
#include "StopListener.h"

#include "itkMedialVoxelMemoryShortage.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace medialvoxel
{
namespace
{

ExtractOptions
GetOptions(const Manifest & manifest, const WorkOptions & options, const std::string & scratchFolder)
{
  ExtractOptions own = manifest.options;
  own.memoryLimit = options.memoryLimit ? options.memoryLimit : own.memoryLimit;
  own.threads = options.threads ? options.threads : own.threads;
  own.scratchFolder = scratchFolder.empty() ? own.scratchFolder : scratchFolder;
  own.divisions.reset(); // the pieces of a cluster are for the memory of this machine to decide
  return own;
}

bool
AreDone(const SharedJob & job, const std::vector<std::uint64_t> & clusters)
{
  return std::all_of(clusters.begin(), clusters.end(), [&job](std::uint64_t cluster) {
    itk::MedialVoxelCheckAbort();
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

std::uint64_t
CountSlices(const Manifest & manifest, const std::vector<std::uint64_t> & clusters)
{
  std::uint64_t slices = 0;
  for (const std::uint64_t cluster : clusters)
  {
    const SliceRange range = manifest.GetCluster(cluster);
    slices += range.end - range.begin;
  }
  return slices;
}

/** A series may have got slices, while its other files stayed as they were. */
const Job &
CheckSlices(const Manifest & manifest, const Job & job)
{
  const VolumeHeader & input = job.result.input;
  if (input.geometry.size.back() != manifest.numberOfSlices)
  {
    Fail(ExitStatus::Failure,
         "the input ",
         input.fileName.string(),
         " has changed since the job was planned: it has ",
         input.geometry.size.back(),
         " slices, it had ",
         manifest.numberOfSlices);
  }
  return job;
}

/** \class ClusterWorker
 * \brief Does the clusters of a job that no other process does. */
class ClusterWorker
{
public:
  /** \param shared must stay
   * \param job    planned for this process, and opened; must stay
   * \throw JobError Failure when a volume is not as it was planned */
  ClusterWorker(const SharedJob & shared, Job & job, ProgressSink & sink);

  /** Returns when all these clusters are done, by whomever.
   * \throw JobError for a failure, at once; for lack of memory, when all others are done
   * \throw StoppedBySignal when the sink asks to stop */
  WorkResult
  Run(const std::vector<std::uint64_t> & clusters);

private:
  /** Whether a cluster is to be asked for again. */
  enum class Outcome
  {
    Done,
    Skipped,
    Busy ///< another process does it
  };

  Outcome
  TryCluster(std::uint64_t cluster);

  void
  DoCluster(std::uint64_t cluster);

  ClusterMarker
  Compute(const SliceRange & range);

  void
  RecordCluster(std::uint64_t cluster, const ClusterMarker & marker) const;

  void
  WaitAMoment();

  const SharedJob & m_Shared;
  Job &             m_Job;
  ProgressSink &    m_Sink;
  JobLocks          m_Locks;
  SharedOutputs     m_Outputs;
  JobRun            m_Run;
};

ClusterWorker::ClusterWorker(const SharedJob & shared, Job & job, ProgressSink & sink)
  : m_Shared(shared)
  , m_Job(job)
  , m_Sink(sink)
  , m_Locks(shared.folder.GetLocksName())
  , m_Outputs(CheckSlices(shared.manifest, job), shared.manifest.GetSuffix())
  , m_Run(job, m_Outputs, sink)
{}

WorkResult
ClusterWorker::Run(const std::vector<std::uint64_t> & clusters)
{
  WorkResult                   result;
  std::set<std::uint64_t>      free(clusters.begin(), clusters.end());
  std::set<std::uint64_t>      busy;
  std::optional<std::uint64_t> last;
  std::exception_ptr           lackOfMemory;
  // Thick walls, or many places, in one cluster do not keep the others from being done.
  const auto postpone = [&] {
    lackOfMemory = std::current_exception();
    m_Run.Wait();
    m_Run.Release();
  };
  m_Run.GetLoop().SetSlicesToDo(CountSlices(m_Shared.manifest, clusters));
  m_Run.Prepare();
  while (!free.empty() || !busy.empty())
  {
    m_Run.GetLoop().ThrowIfStopRequested();
    if (free.empty())
    {
      // Processes at the other clusters may die, so ask again until all are done.
      this->WaitAMoment();
      std::swap(free, busy);
    }
    const std::uint64_t cluster = ChooseCluster(free, busy, last);
    free.erase(cluster);
    try
    {
      switch (this->TryCluster(cluster))
      {
        case Outcome::Done:
          result.done.push_back(cluster);
          last = cluster;
          break;
        case Outcome::Skipped:
          ++result.skipped;
          break;
        case Outcome::Busy:
          busy.insert(cluster);
          break;
      }
    }
    catch (const itk::MedialVoxelMemoryShortage &)
    {
      postpone();
    }
    catch (const PieceMemoryError &)
    {
      postpone();
    }
  }
  if (lackOfMemory)
  {
    std::rethrow_exception(lackOfMemory);
  }
  return result;
}

ClusterWorker::Outcome
ClusterWorker::TryCluster(std::uint64_t cluster)
{
  if (m_Shared.folder.ReadMarker(m_Shared.manifest, cluster))
  {
    return Outcome::Skipped;
  }
  const auto lock = m_Locks.TryLock(cluster);
  if (!lock)
  {
    return Outcome::Busy;
  }
  // It may have been done between the question and the lock.
  if (m_Shared.folder.ReadMarker(m_Shared.manifest, cluster))
  {
    return Outcome::Skipped;
  }
  this->DoCluster(cluster);
  return Outcome::Done;
}

/** The marker comes when the bytes are on the disk, so that one that is there is true whatever happens. */
void
ClusterWorker::DoCluster(std::uint64_t cluster)
{
  // Not before: its volumes may have got their names, or another job its folder, while this process waited.
  m_Shared.folder.CheckStillOf(m_Shared.manifest);
  const ClusterMarker marker = this->Compute(m_Shared.manifest.GetCluster(cluster));
  for (const auto & [role, volume] : m_Outputs.GetVolumes())
  {
    volume->Sync();
  }
  CheckUnchanged(m_Shared.manifest.input);
  m_Shared.folder.CheckStillOf(m_Shared.manifest);
  m_Shared.folder.WriteMarker(m_Shared.manifest, cluster, marker, SaveSurveys(m_Job.products));
  this->RecordCluster(cluster, marker);
}

void
ClusterWorker::RecordCluster(std::uint64_t cluster, const ClusterMarker & marker) const
{
  m_Sink.Record({ LogLevel::Info,
                  "cluster",
                  { { "job", m_Shared.manifest.jobId },
                    { "cluster", std::to_string(cluster) },
                    { "slices", FormatSlices(m_Shared.manifest.GetCluster(cluster)) },
                    { "seconds", FormatFixed(marker.seconds.total, 3) },
                    { "recomputed_voxels", std::to_string(marker.sums.recomputedVoxels) },
                    { "bytes_read", std::to_string(marker.bytesRead) },
                    { "peak_memory_bytes", std::to_string(marker.peakMemory) } } });
}

ClusterMarker
ClusterWorker::Compute(const SliceRange & range)
{
  const auto   start = JobClock::now();
  const double readBefore = m_Run.GetInput().GetSource().GetReadSeconds();
  const double writtenBefore = m_Run.GetWriteSeconds();
  const auto   bytesBefore = m_Run.GetInput().GetSource().GetNumberOfBytesRead();
  for (const auto & product : m_Job.products)
  {
    if (TileSurvey * const survey = product->GetLinks().survey)
    {
      survey->Clear();
    }
  }
  for (const auto & [role, volume] : m_Outputs.GetVolumes())
  {
    volume->StartCluster();
  }
  ClusterMarker marker;
  marker.sums = m_Run.Run(range);
  m_Run.Wait();
  for (const auto & [role, volume] : m_Outputs.GetVolumes())
  {
    marker.checksums[role] = volume->GetChecksum();
  }
  marker.seconds.distance = marker.sums.distanceSeconds;
  marker.seconds.classification = marker.sums.classificationSeconds;
  marker.seconds.tiles = marker.sums.tileSeconds;
  marker.seconds.inputOutput =
    m_Run.GetInput().GetSource().GetReadSeconds() - readBefore + m_Run.GetWriteSeconds() - writtenBefore;
  marker.seconds.total = SecondsSince(start);
  marker.bytesRead = m_Run.GetInput().GetSource().GetNumberOfBytesRead() - bytesBefore;
  marker.peakMemory = GetPeakMemory();
  marker.plannedMemory = m_Job.result.plan.memory.planned;
  marker.memoryLimit = m_Job.result.plan.memory.limit;
  marker.threads = m_Job.result.plan.threads;
  return marker;
}

/** For others to get on. */
void
ClusterWorker::WaitAMoment()
{
  constexpr auto moment = std::chrono::milliseconds(200);
  std::this_thread::sleep_for(moment);
  m_Run.GetLoop().ThrowIfStopRequested();
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
      planned.Prepare(sink);
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
