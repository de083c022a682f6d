// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelClusterOptions_h
#define medialvoxelClusterOptions_h

#include "ClusterRange.h"
#include "Options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Name of the script in the folder of its job. */
constexpr const char * SlurmScriptName = "slurm.sh";

/** A Slurm job array that does the clusters of a job. */
struct SlurmOptions
{
  std::string                  fileName;        ///< of the script; empty: SlurmScriptName in the folder of the job
  std::optional<std::uint64_t> clustersPerTask; ///< 1 or more; unset: as few as give at most 64 tasks
  std::optional<std::uint64_t> tasksAtOnce;     ///< 1 or more; unset: as Slurm decides
};

/** Sets clusters and tasks from "4" or "4%8"; false for other texts. */
bool
ParseSlurmClusters(const std::string & text, SlurmOptions & options);

/** An extraction that several processes do, and the folder by which they know of each other. */
struct PlanOptions : ExtractOptions
{
  std::string                 jobFolder;
  std::optional<SlurmOptions> slurm; ///< set: write a script for Slurm
};

/** The share of one process in a job. */
struct WorkOptions
{
  std::string                  jobFolder;
  std::vector<ClusterRange>    clusters;    ///< empty: all
  std::optional<std::uint64_t> memoryLimit; ///< as JobOptions; unset: as planned
  std::optional<unsigned int>  threads;
  std::string                  scratchFolder; ///< empty: as planned
};

struct FinalizeOptions
{
  std::string jobFolder;
  bool        verifies{ true };   ///< read the outputs again and compare their checksums
  bool        overwrite{ false }; ///< replace existing outputs, also when the plan was not told to
};

} // end namespace medialvoxel

#endif
