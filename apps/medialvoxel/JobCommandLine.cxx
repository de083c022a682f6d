// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterOptions.h"
#include "CommandParts.h"

namespace medialvoxel
{
namespace
{

void
AddJobFolder(CLI::App & app, std::string & target, const std::string & help)
{
  app.add_option("JOBDIR", target, help)->type_name("DIR")->required();
}

void
AddSlurm(CLI::App & app, std::optional<SlurmOptions> & target)
{
  const auto getTarget = [&target]() -> SlurmOptions & { return target ? *target : target.emplace(); };
  const auto setFile = [getTarget](const CLI::results_t & results) {
    const std::string flagWithoutValue = "true"; // as the parser has it
    getTarget().fileName = results.front() == flagWithoutValue ? "" : results.front();
    return true;
  };
  const auto setClusters = [getTarget](const CLI::results_t & results) {
    if (!ParseSlurmClusters(results.front(), getTarget()))
    {
      throw CLI::ValidationError("--slurm-clusters",
                                 "'" + results.front() + "' is not a number of clusters such as 4, or 4%8");
    }
    return true;
  };
  // A value stands behind an equals sign only, so that no argument is taken for it.
  auto * const slurm = app.add_option("--slurm", setFile, "Write a Slurm job array: JOBDIR/slurm.sh, or =FILE");
  slurm->expected(0);
  app.add_option("--slurm-clusters", setClusters, "Clusters per task; N%M: M tasks at once")
    ->type_name("N")
    ->type_size(1)
    ->expected(1)
    ->needs(slurm);
}

void
DefinePlan(CommandLine & line)
{
  CLI::App &    app = *line.plan;
  PlanOptions & options = line.planOptions;
  AddInput(app, options);
  AddLabels(app, options);
  AddJobFolder(app, options.jobFolder, "Folder of the job, new or empty");
  AddSlurm(app, options.slurm);
  AddExtractOptions(line, app, options, nullptr);
  for (const char * const refused : { "--labels",
                                      "--segments",
                                      "--objects",
                                      "--mesh",
                                      "--element-size",
                                      "--section-width",
                                      "--scratch",
                                      "--sparse",
                                      "--compress" })
  {
    app.get_option(refused)->group(""); // not shown; RunPlan() says what to do instead
  }
  line.examples[&app] = { "medialvoxel plan part.mha out.mha job --lower 72",
                          "medialvoxel plan part.mha out.mha job --divisions 64 --threads 8 --slurm" };
}

void
DefineWork(CommandLine & line)
{
  CLI::App & app = *line.work;
  AddJobFolder(app, line.workOptions.jobFolder, "Folder made by medialvoxel plan");
  const auto parse = [&line](const CLI::results_t & results) {
    const auto ranges = ParseClusters(results.front());
    if (!ranges)
    {
      throw CLI::ValidationError("--clusters",
                                 "'" + results.front() + "' is not a list of clusters such as 7 or 0-3,9");
    }
    line.workOptions.clusters = *ranges;
    return true;
  };
  app.add_option("--clusters", parse, "Clusters to compute, as 7 or 0-3,9 (default: all)")
    ->type_name("RANGES")
    ->type_size(1)
    ->expected(1);
  AddMemory(app, line.workOptions.memoryBytes);
  AddThreads(app, line.workOptions.threads);
  AddProgress(line, app);
  AddLog(line, app, line.logFile);
  line.examples[&app] = { "medialvoxel work job", "medialvoxel work job --clusters 0-9 --threads 4" };
  app.footer("Finished clusters are skipped; any number of processes may work at once.");
}

void
DefineFinalize(CommandLine & line)
{
  CLI::App & app = *line.finalize;
  AddJobFolder(app, line.finalizeOptions.jobFolder, "Folder made by medialvoxel plan");
  app.add_flag_callback(
    "--no-verify",
    [&] { line.finalizeOptions.verifies = false; },
    "Skip reading the outputs again for their checksums");
  app.add_flag("--overwrite", line.finalizeOptions.overwrite, "Replace existing outputs, whatever the plan says");
  AddProgress(line, app);
  AddLog(line, app, line.logFile);
  line.examples[&app] = { "medialvoxel finalize job", "medialvoxel finalize job --no-verify" };
}

void
DefineStatus(CommandLine & line)
{
  CLI::App & app = *line.status;
  AddJobFolder(app, line.statusFolder, "Folder made by medialvoxel plan");
  app.add_flag("--json", line.statusAsJson, "Print it as JSON");
  line.examples[&app] = { "medialvoxel status job", "medialvoxel status job --json" };
}

} // namespace

void
DefineJobCommands(CommandLine & line)
{
  DefinePlan(line);
  DefineWork(line);
  DefineFinalize(line);
  DefineStatus(line);
}

} // end namespace medialvoxel
