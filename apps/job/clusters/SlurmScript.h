// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSlurmScript_h
#define medialvoxelSlurmScript_h

#include "ClusterOptions.h"
#include "JobResult.h"
#include "OutputFile.h"
#include "Text.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace medialvoxel
{

/** The values of a script for a job array. */
struct SlurmArray
{
  std::filesystem::path        jobFolder; ///< absolute
  std::filesystem::path        script;
  std::uint64_t                clusters{ 1 };
  std::uint64_t                clustersPerTask{ 1 };
  std::optional<std::uint64_t> tasksAtOnce;
  unsigned int                 threads{ 1 };     ///< of a task
  std::uint64_t                memoryLimit{ 0 }; ///< that the process of a task may take

  std::uint64_t
  GetTasks() const;

  /** Megabytes to request from Slurm: a ninth is for memory that the process does not count. */
  std::uint64_t
  GetMegabytes() const;
};

/** The array for a planned job. Without an option for the memory a process may take twice the plan for walls of
 * PlannedWallThickness, and at least 1 GiB.
 * \throw JobError Usage or Refused when the script would get a name that CheckOutputs() refuses */
SlurmArray
PlanSlurmArray(const SlurmOptions &          slurm,
               const ExtractOptions &        options,
               const JobResult &             job,
               const std::filesystem::path & jobFolder);

/** The script for sbatch. Submitted again, unchanged, it does the missing clusters. */
std::string
MakeSlurmScript(const SlurmArray & array);

/** Writes the script, which gets its name by OutputFile::Publish(). \throw JobError Refused or Failure */
std::unique_ptr<OutputFile>
WriteSlurmScript(const SlurmArray & array, bool overwrite);

/** The next commands to type after a plan. */
TextTable
DescribeSlurmSteps(const SlurmArray & array);

} // end namespace medialvoxel

#endif
