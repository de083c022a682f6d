// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"
#include "CommandText.h"
#include "Log.h"
#include "PhaseTable.h"
#include "Program.h"
#include "SharedJob.h"

#include <iostream>

namespace
{

using namespace medialvoxel;

std::unique_ptr<ProgressSink>
MakeSink(const CommandLine & line)
{
  return MakeProgressSink(line.quiet ? ProgressStyle::Quiet : line.progress);
}

/** Calls work(sink), and tells a log, if one was asked for, what it does and why it fails. */
template <typename TWork>
auto
RunLogged(const CommandLine & line, const std::string & logFile, TWork && work)
{
  if (logFile.empty())
  {
    return work(*MakeSink(line));
  }
  Log        log(logFile, line.logLevel);
  const auto sink = MakeLogSink(log, MakeSink(line));
  try
  {
    return work(*sink);
  }
  catch (const std::exception & error)
  {
    log.Write({ LogLevel::Error, "failed", { { "message", error.what() } } });
    throw;
  }
}

/** Labels, a mesh, or both. */
void
Extract(const CommandLine & line, const ExtractOptions & options)
{
  const JobResult result =
    RunLogged(line, options.logFile, [&options](ProgressSink & sink) { return RunExtract(options, sink); });
  if (options.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  else if (!line.quiet)
  {
    PrintPhaseTable(std::cout, options, result);
  }
}

/** The command that was typed, to be typed again. */
std::string
JoinCommand(int argc, char * argv[])
{
  std::string command = "medialvoxel";
  for (int i = 1; i < argc; ++i)
  {
    command += " " + Quote(argv[i]);
  }
  return command;
}

void
ExtractWithResume(const CommandLine & line, const std::string & command)
{
  const FinalizeResult result = RunLogged(line, line.extractOptions.logFile, [&](ProgressSink & sink) {
    return RunResumable(line.extractOptions, command, sink);
  });
  if (line.extractOptions.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.job->plan, result.job->input, result.job->outputs));
  }
  else if (!line.quiet)
  {
    PrintFinalization(std::cout, result);
  }
}

void
Plan(const CommandLine & line)
{
  const PlanOptions & options = line.planOptions;
  const PlanResult    result =
    RunLogged(line, options.logFile, [&options](ProgressSink & sink) { return RunPlan(options, sink); });
  if (options.dryRun || !line.quiet)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  if (!options.dryRun && !line.quiet)
  {
    PrintTable(std::cout,
               result.slurm ? DescribeSlurmSteps(*result.slurm)
                            : DescribeNextSteps(options.jobFolder, result.plan.divisions));
  }
}

void
Work(const CommandLine & line)
{
  const WorkResult result =
    RunLogged(line, line.logFile, [&line](ProgressSink & sink) { return RunWork(line.workOptions, sink); });
  if (!line.quiet)
  {
    PrintTable(std::cout,
               { { "clusters done", std::to_string(result.done.size()) },
                 { "clusters skipped", std::to_string(result.skipped) } });
  }
}

void
Finalize(const CommandLine & line)
{
  const FinalizeResult result =
    RunLogged(line, line.logFile, [&line](ProgressSink & sink) { return RunFinalize(line.finalizeOptions, sink); });
  if (!line.quiet)
  {
    PrintFinalization(std::cout, result);
  }
}

void
ShowStatus(const CommandLine & line)
{
  const JobStatus status = GetJobStatus(line.statusFolder);
  if (line.statusAsJson)
  {
    std::cout << MakeStatusJson(status);
  }
  else
  {
    PrintTable(std::cout, DescribeStatus(status));
  }
}

void
ComputeDistance(const CommandLine & line)
{
  const DistanceOptions & options = line.distanceOptions;
  const JobResult         result =
    RunLogged(line, options.logFile, [&options](ProgressSink & sink) { return RunDistance(options, sink); });
  if (options.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  else if (!line.quiet)
  {
    PrintDistanceTable(std::cout, result);
  }
}

void
DescribeInput(const CommandLine & line)
{
  if (line.infoOptions.raw)
  {
    CheckOptions(*line.infoOptions.raw);
  }
  PrintTable(std::cout, DescribeHeader(ReadVolumeHeader(line.infoOptions.input, line.infoOptions.raw)));
}

void
RunCommand(const CommandLine & line, const std::string & command)
{
  if (line.extract->parsed() && line.resumes)
  {
    ExtractWithResume(line, command);
  }
  else if (line.extract->parsed())
  {
    Extract(line, line.extractOptions);
  }
  else if (line.plan->parsed())
  {
    Plan(line);
  }
  else if (line.work->parsed())
  {
    Work(line);
  }
  else if (line.finalize->parsed())
  {
    Finalize(line);
  }
  else if (line.status->parsed())
  {
    ShowStatus(line);
  }
  else if (line.mesh->parsed())
  {
    Extract(line, line.meshOptions);
  }
  else if (line.distance->parsed())
  {
    ComputeDistance(line);
  }
  else
  {
    DescribeInput(line);
  }
}

/** Help and version are results, other ends of the parsing are errors. */
int
ReportParsing(const CLI::App & app, const CLI::ParseError & error)
{
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
  {
    return app.exit(error);
  }
  std::cerr << "medialvoxel: " << error.what() << " (see medialvoxel --help)" << std::endl;
  return static_cast<int>(ExitStatus::Usage);
}

} // namespace

int
main(int argc, char * argv[])
{
  return RunProgram("medialvoxel", [&] {
    CommandLine line;
    const auto  app = DefineCommandLine(line);
    try
    {
      app->parse(argc, argv);
    }
    catch (const CLI::ParseError & error)
    {
      return ReportParsing(*app, error);
    }
    if (line.generate->parsed())
    {
      WriteCommandTexts(line, *app);
      return static_cast<int>(ExitStatus::Done);
    }
    RunCommand(line, JoinCommand(argc, argv));
    return static_cast<int>(ExitStatus::Done);
  });
}
