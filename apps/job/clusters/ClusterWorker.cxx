// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterWorker.h"

#include "Errors.h"
#include "ExtractParts.h"
#include "JobClock.h"
#include "Outputs.h"
#include "ProcessMemory.h"

#include "itkMedialVoxelMemoryShortage.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <set>
#include <thread>

namespace medialvoxel
{
namespace
{

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
void
CheckSlices(const Manifest & manifest, const VolumeHeader & input)
{
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
}

} // namespace

ClusterWorker::ClusterWorker(const SharedJob & job, const JobResult & plan, ProgressSink & sink)
  : m_Job(job)
  , m_Plan(plan)
  , m_Sink(sink)
  , m_Locks(job.folder.GetLocksName())
  , m_Run(job.manifest.options, plan, sink)
{
  CheckSlices(job.manifest, plan.input);
  m_Requests = ListVolumes(job.manifest.options, plan.input);
  for (const VolumeRequest & request : m_Requests)
  {
    m_Volumes.push_back(MakeSharedVolume(request.fileName, job.manifest.options));
    m_Volumes.back()->OpenShared(request.geometry, request.layout, job.manifest.GetSuffix());
    if (plan.plan.writesBehind)
    {
      m_Volumes.back()->BypassPageCacheWhenLarge();
    }
    m_Run.AddVolume(request, *m_Volumes.back());
  }
}

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
  m_Run.SetSlicesToDo(CountSlices(m_Job.manifest, clusters));
  m_Run.Prepare();
  while (!free.empty() || !busy.empty())
  {
    m_Run.ThrowIfStopRequested();
    if (free.empty())
    {
      // Those who are at the others may die, so they are asked for again until they are done.
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
  if (m_Job.folder.ReadMarker(m_Job.manifest, cluster))
  {
    return Outcome::Skipped;
  }
  const auto lock = m_Locks.TryLock(cluster);
  if (!lock)
  {
    return Outcome::Busy;
  }
  // It may have been done between the question and the lock.
  if (m_Job.folder.ReadMarker(m_Job.manifest, cluster))
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
  m_Job.folder.CheckStillOf(m_Job.manifest);
  const ClusterMarker marker = this->Compute(m_Job.manifest.GetCluster(cluster));
  for (const auto & volume : m_Volumes)
  {
    volume->Sync();
  }
  CheckUnchanged(m_Job.manifest.input);
  m_Job.folder.CheckStillOf(m_Job.manifest);
  m_Job.folder.WriteMarker(m_Job.manifest, cluster, marker, m_Run.GetSurveys().Save());
  this->RecordCluster(cluster, marker);
}

void
ClusterWorker::RecordCluster(std::uint64_t cluster, const ClusterMarker & marker) const
{
  m_Sink.Record({ LogLevel::Info,
                  "cluster",
                  { { "job", m_Job.manifest.jobId },
                    { "cluster", std::to_string(cluster) },
                    { "slices", FormatSlices(m_Job.manifest.GetCluster(cluster)) },
                    { "seconds", FormatFixed(marker.seconds.total, 3) },
                    { "recomputed_voxels", std::to_string(marker.sums.recomputedVoxels) },
                    { "bytes_read", std::to_string(marker.bytesRead) },
                    { "peak_memory_bytes", std::to_string(marker.peakMemoryBytes) } } });
}

ClusterMarker
ClusterWorker::Compute(const SliceRange & range)
{
  const auto   start = JobClock::now();
  const double readBefore = m_Run.GetInput().GetSource().GetReadSeconds();
  const double writtenBefore = m_Run.GetWriteSeconds();
  const auto   bytesBefore = m_Run.GetInput().GetSource().GetNumberOfBytesRead();
  m_Run.GetSurveys().Clear();
  for (const auto & volume : m_Volumes)
  {
    volume->StartCluster();
  }
  ClusterMarker marker;
  marker.sums = m_Run.Run(range);
  m_Run.Wait();
  for (std::size_t i = 0; i < m_Volumes.size(); ++i)
  {
    marker.checksums[m_Requests[i].role] = m_Volumes[i]->GetChecksum();
  }
  CheckCounts(marker.sums.counts);
  marker.seconds.distance = marker.sums.distanceSeconds;
  marker.seconds.classification = marker.sums.classificationSeconds;
  marker.seconds.tiles = marker.sums.tileSeconds;
  marker.seconds.inputOutput =
    m_Run.GetInput().GetSource().GetReadSeconds() - readBefore + m_Run.GetWriteSeconds() - writtenBefore;
  marker.seconds.total = SecondsSince(start);
  marker.bytesRead = m_Run.GetInput().GetSource().GetNumberOfBytesRead() - bytesBefore;
  marker.peakMemoryBytes = GetPeakMemoryBytes();
  marker.plannedMemoryBytes = m_Plan.plan.memoryBytes;
  marker.memoryLimit = m_Plan.plan.memoryLimit;
  marker.threads = m_Plan.plan.threads;
  return marker;
}

/** For others to get on. */
void
ClusterWorker::WaitAMoment() const
{
  constexpr auto moment = std::chrono::milliseconds(200);
  std::this_thread::sleep_for(moment);
  m_Run.ThrowIfStopRequested();
}

} // end namespace medialvoxel
