// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobCommands_h
#define medialvoxelJobCommands_h

#include "ClusterOptions.h"
#include "Errors.h"
#include "Progress.h"
#include "SlurmScript.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** \class ResumableStop
 * \brief The job was asked to stop and keeps its finished clusters. */
class ResumableStop : public StoppedBySignal
{
public:
  /** \param command that continues the job */
  ResumableStop(int signalNumber, const std::string & command)
    : StoppedBySignal(signalNumber)
    , m_Message("stopped; what is done stays, to continue: " + command)
  {}

  const char *
  what() const noexcept override
  {
    return m_Message.c_str();
  }

private:
  std::string m_Message;
};

/** How an extraction will be done; the divisions of its plan are the clusters. */
struct PlanResult : JobResult
{
  std::optional<SlurmArray> slurm; ///< when a script was asked for
};

struct WorkResult
{
  std::vector<std::uint64_t> done;         ///< by this process
  std::uint64_t              skipped{ 0 }; ///< as they were done already, or by another process meanwhile
};

struct FinalizeResult
{
  ExtractOptions           options;
  std::optional<JobResult> job;                          ///< nothing when the job was finished before
  WallVerdict              verdict{ WallVerdict::Good }; ///< as GetVerdict(), also then
};

/** How far a job is. */
struct JobStatus
{
  std::uint64_t              numberOfClusters{ 0 };
  std::vector<std::uint64_t> done;
  std::vector<std::uint64_t> running;
  std::vector<std::uint64_t> missing;    ///< neither done nor running
  std::uint64_t              bytes{ 0 }; ///< of the voxels of all volumes
  std::uint64_t              bytesDone{ 0 };
  bool                       isFinished{ false };
  std::string                nextCommand; ///< empty when there is nothing to do
};

/** Checks everything as RunJob() does, creates the volumes under temporary names and fills the job folder, which
 * must not be there or be empty. With dryRun nothing is written.
 * \throw JobError */
PlanResult
RunPlan(const PlanOptions & options, ProgressSink & sink);

/** Does the clusters that are not done; any number of processes may do this at the same time, and each cluster is done
 * by one of them. Returns when the wanted clusters are done, by whomever.
 * \throw JobError also when the input, the version or the folder is not that of the plan
 * \throw ResumableStop when the sink asked to stop */
WorkResult
RunWork(const WorkOptions & options, ProgressSink & sink);

/** Verifies that all clusters are done, writes the last outputs of RunJob() and gives all outputs their names.
 * Repeating it is harmless.
 * \throw JobError Failure when clusters are missing, or damaged; damaged ones become missing */
FinalizeResult
RunFinalize(const FinalizeOptions & options, ProgressSink & sink);

/** \throw JobError Failure when the folder has no job */
JobStatus
GetJobStatus(const std::string & jobFolder);

/** The status as names and values to print. */
TextTable
DescribeStatus(const JobStatus & status);

/** The same as JSON, with the clusters of each kind as text for --clusters. */
std::string
MakeStatusJson(const JobStatus & status);

/** The next commands to type after a plan. */
TextTable
DescribeNextSteps(const std::string & jobFolder, std::uint64_t numberOfClusters);

/** RunJob() as a job in the folder GetResumeFolder(), which is removed at the end. Continues an existing job with the
 * same options, input and version; refuses one with others.
 * \param command that continues it, for the message when it is stopped
 * \throw JobError
 * \throw ResumableStop when the sink asked to stop */
FinalizeResult
RunResumable(const ExtractOptions & options, const std::string & command, ProgressSink & sink);

std::string
GetResumeFolder(const ExtractOptions & options);

} // end namespace medialvoxel

#endif
