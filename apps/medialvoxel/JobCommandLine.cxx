// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterOptions.h"
#include "CommandParts.h"
#include "CommandTable.h"
#include "OptionValues.h"

namespace medialvoxel
{
namespace
{

void
AddJobFolder(CLI::App & app, std::string & target, const std::string & help)
{
  RefuseEmpty(app.add_option("JOBDIR", target, help)->type_name("DIR"), "the name of a folder")->required();
}

void
AddSlurm(CLI::App & app, std::optional<SlurmOptions> & target)
{
  // What is no value of a flag is the name of a file.
  const auto setFile = [&target](const std::string & text) {
    if (text.empty())
    {
      throw CLI::ValidationError("'' is not the name of a file");
    }
    const std::optional<bool> isWanted = ParseFlag(text);
    if (isWanted.value_or(true))
    {
      target.emplace().fileName = isWanted ? "" : text;
    }
  };
  const auto setClusters = [&target](const std::string & text) {
    if (!target)
    {
      throw CLI::ValidationError("'" + text + "' has no effect; it needs --slurm");
    }
    if (!ParseSlurmClusters(text, *target))
    {
      throw CLI::ValidationError("'" + text + "' is not a number of clusters from 1 on such as 4, or two as 4%8");
    }
  };
  auto * const slurm = AddText(app, "--slurm", "Write a Slurm job array: JOBDIR/slurm.sh, or =FILE", "", setFile);
  AddText(app, "--slurm-clusters", "Clusters per task; N%M: M tasks at once", "N", setClusters)->needs(slurm);
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
                                      "--sparse",
                                      "--compress" })
  {
    app.get_option(refused)->group(HiddenGroup); // not shown; RunPlan() says what to do instead
  }
  line.examples[&app] = { "medialvoxel plan part.mha out.mha job --lower 72",
                          "medialvoxel plan part.mha out.mha job --divisions 64 --threads 8 --slurm" };
}

void
DefineWork(CommandLine & line)
{
  CLI::App & app = *line.work;
  AddJobFolder(app, line.workOptions.jobFolder, "Folder made by medialvoxel plan");
  AddText(
    app, "--clusters", "Clusters to compute, as 7 or 0-3,9 (default: all)", "RANGES", [&](const std::string & text) {
      const auto ranges = ParseClusters(text);
      if (!ranges)
      {
        throw CLI::ValidationError("'" + text + "' is not a list of clusters from 0 on such as 7 or 0-3,9");
      }
      line.workOptions.clusters = *ranges;
    });
  AddMemory(app, line.workOptions.memoryBytes);
  AddScratch(app, line.workOptions.scratchFolder);
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
  AddFlag(app, "--no-verify", "Skip reading the outputs again for their checksums", [&line](bool value) {
    line.finalizeOptions.verifies = !value;
  });
  AddFlag(app, "--overwrite", "Replace existing outputs, whatever the plan says", line.finalizeOptions.overwrite);
  AddProgress(line, app);
  AddLog(line, app, line.logFile);
  line.examples[&app] = { "medialvoxel finalize job", "medialvoxel finalize job --no-verify" };
}

void
DefineStatus(CommandLine & line)
{
  CLI::App & app = *line.status;
  AddJobFolder(app, line.statusFolder, "Folder made by medialvoxel plan");
  AddFlag(app, "--json", "Print it as JSON", line.statusAsJson);
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
