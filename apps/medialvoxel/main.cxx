// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"
#include "CommandText.h"
#include "Log.h"
#include "PhaseTable.h"
#include "Program.h"

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
JobResult
RunLogged(const CommandLine & line, const JobOptions & options, TWork && work)
{
  if (options.logFile.empty())
  {
    return work(*MakeSink(line));
  }
  Log        log(options.logFile, line.logLevel);
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
    RunLogged(line, options, [&options](ProgressSink & sink) { return RunExtract(options, sink); });
  if (options.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  else if (!line.quiet)
  {
    PrintPhaseTable(std::cout, options, result);
  }
}

void
ComputeDistance(const CommandLine & line)
{
  const DistanceOptions & options = line.distanceOptions;
  const JobResult         result =
    RunLogged(line, options, [&options](ProgressSink & sink) { return RunDistance(options, sink); });
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
RunCommand(const CommandLine & line)
{
  if (line.extract->parsed())
  {
    Extract(line, line.extractOptions);
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
    RunCommand(line);
    return static_cast<int>(ExitStatus::Done);
  });
}
