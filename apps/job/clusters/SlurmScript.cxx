// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SlurmScript.h"

#include "Job.h"
#include "OutputChecks.h"
#include "SharedJob.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

/** Well below Slurm's default limit of an array, 1000. */
constexpr std::uint64_t MostTasks = 64;

constexpr std::uint64_t LeastMemory = 1024 * MiB;

constexpr const char * Template = R"(#!/bin/sh
# Job array for Slurm: the @CLUSTERS@ clusters of an extraction that medialvoxel plan prepared, in @TASKS@ tasks.
# Submit it as it is, to begin and to go on after whatever stopped it: clusters that are done are skipped.
#SBATCH --job-name=medialvoxel
#SBATCH --array=0-@LAST_TASK@@AT_ONCE@
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=@THREADS@
#SBATCH --mem=@MEGABYTES@M
#SBATCH --requeue
job=@JOB@
clusters=@CLUSTERS@
per_task=@PER_TASK@
first=$((SLURM_ARRAY_TASK_ID * per_task))
last=$((first + per_task - 1))
[ "$last" -lt "$clusters" ] || last=$((clusters - 1))
# The program keeps below the limit of Slurm, which counts more than the memory of the process.
memory=$((${SLURM_MEM_PER_NODE:-@MEGABYTES@} * 8 / 9))
exec medialvoxel work "$job" --clusters "$first-$last" --threads "$SLURM_CPUS_PER_TASK" --memory "${memory}M" \
  --progress plain
)";

using Values = std::vector<std::pair<std::string, std::string>>;

/** Replaces "@NAME@" in one pass, so that a value may contain another name. */
std::string
Fill(const std::string & text, const Values & values)
{
  std::string filled;
  for (std::size_t place = 0; place < text.size();)
  {
    const auto found = std::find_if(values.begin(), values.end(), [&](const auto & value) {
      return text.compare(place, value.first.size(), value.first) == 0;
    });
    filled += found == values.end() ? text.substr(place, 1) : found->second;
    place += found == values.end() ? 1 : found->first.size();
  }
  return filled;
}

/** Memory of one process, which divides its clusters as it likes. */
std::uint64_t
ChooseMemory(ExtractOptions options)
{
  if (options.memoryLimit)
  {
    return *options.memoryLimit;
  }
  options.divisions.reset();
  Job job(options);
  job.PlanProcess();
  return std::max(LeastMemory, 2 * job.result.plan.memory.planned);
}

} // namespace

std::uint64_t
SlurmArray::GetTasks() const
{
  return (clusters - 1) / clustersPerTask + 1;
}

std::uint64_t
SlurmArray::GetMegabytes() const
{
  const std::uint64_t megabytes = (memoryLimit + MiB - 1) / MiB;
  return megabytes + (megabytes + 7) / 8;
}

SlurmArray
PlanSlurmArray(const SlurmOptions &          slurm,
               const ExtractOptions &        options,
               const JobResult &             job,
               const std::filesystem::path & jobFolder)
{
  SlurmArray array;
  array.jobFolder = jobFolder;
  array.script = slurm.fileName.empty() ? jobFolder / SlurmScriptName : std::filesystem::path(slurm.fileName);
  if (!slurm.fileName.empty())
  {
    std::vector<OutputRequest> outputs = job.outputs;
    outputs.push_back({ "the Slurm script", slurm.fileName, std::nullopt });
    CheckOutputs(outputs, job.input, options.overwrite);
  }
  array.clusters = job.plan.divisions;
  array.clustersPerTask =
    std::min(slurm.clustersPerTask.value_or((array.clusters - 1) / MostTasks + 1), array.clusters);
  array.tasksAtOnce = slurm.tasksAtOnce;
  array.threads = job.plan.threads;
  array.memoryLimit = ChooseMemory(options);
  return array;
}

std::string
MakeSlurmScript(const SlurmArray & array)
{
  return Fill(Template,
              { { "@CLUSTERS@", std::to_string(array.clusters) },
                { "@TASKS@", std::to_string(array.GetTasks()) },
                { "@LAST_TASK@", std::to_string(array.GetTasks() - 1) },
                { "@AT_ONCE@", array.tasksAtOnce ? "%" + std::to_string(*array.tasksAtOnce) : "" },
                { "@THREADS@", std::to_string(array.threads) },
                { "@MEGABYTES@", std::to_string(array.GetMegabytes()) },
                { "@JOB@", Quote(array.jobFolder.string()) },
                { "@PER_TASK@", std::to_string(array.clustersPerTask) } });
}

std::unique_ptr<OutputFile>
WriteSlurmScript(const SlurmArray & array, bool overwrite)
{
  auto file = std::make_unique<OutputFile>(array.script, overwrite);
  file->CreateNamed(0, false);
  WriteText(*file, MakeSlurmScript(array));
  return file;
}

TextTable
DescribeSlurmSteps(const SlurmArray & array)
{
  const std::string script = Quote(std::filesystem::absolute(array.script).string());
  const std::string finalize = "medialvoxel finalize " + Quote(array.jobFolder.string());
  return { { "clusters",
             std::to_string(array.clusters) + ", 0 to " + std::to_string(array.clusters - 1) + ", in " +
               std::to_string(array.GetTasks()) + " tasks of a job array" },
           { "to do them", "sbatch " + script },
           { "at the end", finalize },
           { "or both",
             "sbatch --dependency=afterok:$(sbatch --parsable " + script + ") --kill-on-invalid-dep=yes --mem=" +
               std::to_string(array.GetMegabytes()) + "M --wrap " + Quote(finalize) } };
}

} // end namespace medialvoxel
