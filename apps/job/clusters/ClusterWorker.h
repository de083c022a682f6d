// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelClusterWorker_h
#define medialvoxelClusterWorker_h

#include "JobCommands.h"
#include "JobRun.h"
#include "SharedJob.h"
#include "SharedOutputs.h"

#include <vector>

namespace medialvoxel
{

/** \class ClusterWorker
 * \brief Does clusters of a job in this process, those that no other process does. */
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

} // end namespace medialvoxel

#endif
