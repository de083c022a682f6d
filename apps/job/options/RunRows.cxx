// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionTable.h"

#include "Outputs.h"
#include "SlicerElements.h"
#include "Text.h"

#include <algorithm>
#include <filesystem>

namespace medialvoxel
{
namespace
{

using namespace Commands;

constexpr const char * Group = "Run";

/** Whether an option of volumes has an effect. */
bool
WritesVolumes(const OptionTarget & target)
{
  const auto * const extract = std::get<ExtractOptions *>(target);
  return !(extract ? ListVolumeNames(*extract) : ListVolumeNames(*std::get<DistanceOptions *>(target))).empty();
}

/** A flag, or the name of a kind. */
OptionValue
Packing()
{
  using Kind = Compression;
  OptionValue value = Choice<JobOptions, Kind>(
    &JobOptions::compression,
    { { "on", Kind::On }, { "gzip", Kind::Gzip }, { "blosc-zstd", Kind::BloscZstd }, { "none", Kind::None } });
  value.set = [set = value.set](const OptionTarget & target, const std::string & text) {
    const std::optional<bool> isOn = ParseFlag(text);
    isOn ? void(std::get<JobOptions *>(target)->compression = *isOn ? Kind::On : Kind::Default) : set(target, text);
  };
  value.isFlag = true;
  return value;
}

bool
HasLabels(const ExtractOptions & options)
{
  return !options.output.empty();
}

/** The threads of the module: 0 stands for the default. */
OptionValue
ModuleThreads(std::int64_t most)
{
  return Value<ExtractOptions>(
    [most](ExtractOptions & options, const std::string & text) {
      const std::int64_t number = ToInteger(text, 0, most);
      options.threads = number == 0 ? std::nullopt : std::optional<unsigned int>(number);
    },
    [](const ExtractOptions & options) {
      return std::optional<std::string>(std::to_string(options.threads.value_or(0)));
    });
}

void
SetSlurm(PlanOptions & options, const std::string & text)
{
  if (text.empty())
  {
    throw WrongValue("'' is not the name of a file");
  }
  // A text that is no value of a flag is the name of a file.
  const std::optional<bool> isWanted = ParseFlag(text);
  if (isWanted.value_or(true))
  {
    options.slurm.emplace().fileName = isWanted ? "" : text;
  }
}

void
SetSlurmClusters(PlanOptions & options, const std::string & text)
{
  if (!options.slurm)
  {
    throw WrongValue("'" + text + "' has no effect; it needs --slurm");
  }
  if (!ParseSlurmClusters(text, *options.slurm))
  {
    throw WrongValue("'" + text + "' is not a number of clusters from 1 on such as 4, or two as 4%8");
  }
}

void
SetClusters(WorkOptions & options, const std::string & text)
{
  const auto ranges = ParseClusters(text);
  if (!ranges)
  {
    throw WrongValue("'" + text + "' is not a list of clusters from 0 on such as 7 or 0-3,9");
  }
  options.clusters = *ranges;
}

/** For files that are never written again. */
template <typename TOptions>
OptionValue
ReadOnly(void (*set)(TOptions &, const std::string &), bool isFlag = false)
{
  OptionValue value = Value<TOptions>(set, [](const TOptions &) { return std::optional<std::string>(); });
  value.isFlag = isFlag;
  return value;
}

void
AddJobs(std::vector<OptionRow> & rows)
{
  const auto folder = [] { return Text(&ProgramOptions::jobFolder, "the name of a folder"); };
  AddRow(rows, "JOBDIR", "DIR", folder()).Of(Plan).Help("Folder of the job, new or empty");
  AddRow(rows, "JOBDIR", "DIR", folder()).Of(Work | Finalize | Status).Help("Folder made by medialvoxel plan");
  AddRow(rows, "--slurm", "", ReadOnly(SetSlurm, true))
    .Of(Plan, "Job")
    .Help("Write a Slurm job array: JOBDIR/slurm.sh, or =FILE",
          "Prints the commands that submit it, too. on and off are no file names, but ./on is one.");
  AddRow(rows, "--slurm-clusters", "N", ReadOnly(SetSlurmClusters))
    .Of(Plan, "Job")
    .Hidden()
    .Help("Clusters per task; N%M: M tasks at once", "Default: so many that there are up to 64 tasks.")
    .Requires("--slurm");
  AddRow(rows, "--clusters", "RANGES", ReadOnly(SetClusters))
    .Of(Work, "Job")
    .Help("Clusters to compute, as 7 or 0-3,9 (default: all)", "Counted from 0.");
  const auto setVerify = [](FinalizeOptions & options, const std::string & text) { options.verifies = !ToFlag(text); };
  AddRow(rows, "--no-verify", "", ReadOnly<FinalizeOptions>(setVerify, true))
    .Of(Finalize, "Job")
    .Hidden()
    .Help("Skip reading the outputs again for their checksums", "For file systems that have checksums of their own.");
  AddRow(rows, "--json", "", Flag(&ProgramOptions::printsJson)).Of(Status, "Job").Help("Print it as JSON");
}

void
AddResources(std::vector<OptionRow> & rows)
{
  AddRow(rows,
         "--memory",
         "SIZE",
         Value(&JobOptions::memoryLimit, ToByteSize, [](std::uint64_t bytes) { return std::to_string(bytes); }))
    .Of(Runs | Work, Group)
    .Help(
      "Limit, such as 2G (default: half of the free memory)",
      "A hard limit on the peak of the process. It changes the speed, never the results. K, M, G and T are powers of "
      "1024.")
    .KeepForRun()
    .Python(Extract | Mesh | Distance | Surface)
    .Slicer({ Group, "memory", "Memory", "" });
  AddRow(rows, "--scratch", "DIR", File(&JobOptions::scratchFolder))
    .Of(Runs | Work, Group)
    .Hidden()
    .Help(
      "Folder for input and mesh beyond the memory",
      "Values of compressed input that do not fit the memory, and vertices and faces of meshes, wait there in files "
      "without a name.")
    .KeepForRun()
    .Slicer({ Group, "scratchFolder", "Scratch folder", "", "directory", "input" });
  constexpr std::int64_t mostThreads = 128; // that ITK starts
  AddRow(rows, "--threads", "N", Count(&JobOptions::threads, 1, mostThreads))
    .Of(Runs | Work, Group)
    .Help("Threads (default: one per processor)", "Results do not depend on it.")
    .KeepForRun()
    .Python(Extract | Mesh | Distance | Surface)
    .Slicer({ Group,
              "numberOfThreads",
              "Threads",
              "Number of threads; 0 is one per processor",
              "integer",
              "",
              ModuleThreads(mostThreads),
              SlicerLimits("0", std::to_string(mostThreads)) });
  AddRow(rows, "--divisions", "N", Count(&JobOptions::divisions, 1))
    .Of(Runs & ~Plan, Group)
    .Hidden()
    .Help("Number of pieces (default: chosen)", "Results do not depend on it.");
  AddRow(rows, "--divisions", "N", Count(&JobOptions::divisions, 1))
    .Of(Plan, Group)
    .Help("Number of pieces (default: chosen)", "Number of clusters. Results do not depend on it.");
}

void
AddFiles(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--dry-run", "", Flag(&JobOptions::dryRun))
    .Of(Runs, Group)
    .Help("Check everything, print the plan and stop", "Writes nothing.");
  AddRow(rows, "--sparse", "", Flag(&JobOptions::sparse))
    .Of(Runs, Group)
    .Hidden()
    .RefusedIn(Plan)
    .Help("Leave zeros as holes in the files, reserve no space", "Not in jobs of several processes.");
  const std::string overwriting =
    "Without it the run is refused with status 3. Old files stay until the new ones are complete.";
  AddRow(rows, "--overwrite", "", Flag(&JobOptions::overwrite))
    .Of(Runs, Group)
    .Help("Replace existing outputs", overwriting)
    .KeepForRun();
  AddRow(rows, "--overwrite", "", Flag(&FinalizeOptions::overwrite))
    .Of(Finalize, Group)
    .Help("Replace existing outputs, whatever the plan says", overwriting);
}

void
AddMessages(std::vector<OptionRow> & rows)
{
  using Style = ProgressStyle;
  AddRow(rows,
         "--progress",
         "STYLE",
         Choice<ProgramOptions, Style>(&ProgramOptions::progress,
                                       { { "auto", Style::Auto },
                                         { "bar", Style::Bar },
                                         { "plain", Style::Plain },
                                         { "slicer", Style::Slicer },
                                         { "json", Style::JsonLines },
                                         { "none", Style::None } }))
    .Of(Processes, Group)
    .HiddenIn(Runs)
    .Help("Progress");
  AddRow(rows, "--quiet", "", Flag(&ProgramOptions::quiet))
    .Of(Processes, Group)
    .Help("Print errors only", "Warnings are left out too.");
  AddRow(rows, "--phases", "", Flag(&ProgramOptions::showsPhases))
    .Of((Runs & ~Plan) | Finalize, Group)
    .Hidden()
    .Help("Print a longer table: phases of the method",
          "Cells by the phase that decided them, as in Table 1 of the paper; shapes of elements; seconds of each part. "
          "The report has all of it.");
  AddRow(rows, "--log-file", "FILE", File(&JobOptions::logFile))
    .Of(Processes, Group)
    .HiddenIn(Runs)
    .Help("Append one line per step to this file", "Several processes may share it. Lines that are there stay.");
}

void
AddPacking(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--compress", "KIND", Packing())
    .OfJobs(Extractions | Distance, Group)
    .Hidden()
    .Help("Pack volumes",
          "on, the value of --compress alone: as the format does it. .mha: on or none (default). .nrrd: gzip or none "
          "(default). .nii.gz: gzip. .zarr: gzip (default), none, or blosc-zstd, which makes smaller files, and makes "
          "them sooner. Packed files do not stream, and only .zarr is packed in jobs of several processes.")
    .Needs("an output that is a volume", WritesVolumes);
  AddRow(rows, "--resume", "", Flag(&ProgramOptions::resumes))
    .Of(Extract, Group)
    .Help("Continue a stopped run, or start one that can",
          "The job folder is OUTPUT.job until the run is complete. The same command continues.")
    .Needs("OUTPUT", HasLabels);
}

} // namespace

void
AddJobRows(std::vector<OptionRow> & rows)
{
  AddJobs(rows);
}

void
AddRunRows(std::vector<OptionRow> & rows)
{
  AddResources(rows);
  AddFiles(rows);
  AddMessages(rows);
  AddPacking(rows);
}

} // end namespace medialvoxel
