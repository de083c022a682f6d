// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"
#include "CommandTable.h"
#include "CommandWords.h"
#include "CommandText.h"
#include "JobCommands.h"
#include "Log.h"
#include "ObjectPlan.h"
#include "OptionChecks.h"
#include "OtherNames.h"
#include "Plan.h"
#include "Program.h"
#include "ReadVolumeHeader.h"
#include "Report.h"
#include "ResultViews.h"
#include "RunJob.h"
#include "SharedJob.h"
#include "Signals.h"
#include "SuggestName.h"
#include "VolumeStatistics.h"

#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <iostream>

namespace
{

using namespace medialvoxel;

std::unique_ptr<ProgressSink>
MakeSink(const CommandLine & line)
{
  return MakeProgressSink(line.program.quiet ? ProgressStyle::Quiet : line.program.progress);
}

/** Calls work(sink), and logs its steps and its failure, if a log was asked for. */
template <typename TWork>
auto
RunLogged(const CommandLine & line, const std::string & logFile, TWork && work)
{
  if (logFile.empty())
  {
    return work(*MakeSink(line));
  }
  Log        log(logFile);
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

/** Names and values in two columns. */
void
PrintTable(std::ostream & out, const TextTable & table)
{
  std::size_t width = 0;
  for (const auto & row : table)
  {
    width = std::max(width, row.first.size());
  }
  for (const auto & [name, value] : table)
  {
    out << name << std::string(width - name.size() + 2, ' ') << value << '\n';
  }
}

/** The report alone where it goes to the standard output, otherwise a table of it. */
void
PrintResult(const CommandLine & line, const JobOptions & options, const JobResult & result, Views table)
{
  if (options.reportFile == StandardOutput)
  {
    std::cout << FormatReport(result.report);
  }
  else if (!line.program.quiet)
  {
    PrintTable(std::cout, MakeTable(table | (line.program.showsPhases ? LongTable : 0U), result.report));
  }
}

/** \throw JobError Usage when progress and report would be mixed up */
void
CheckStandardOutput(const CommandLine & line, const JobOptions & options)
{
  if (options.reportFile == StandardOutput && line.program.progress == ProgressStyle::Slicer)
  {
    Fail(ExitStatus::Usage, "--report - and --progress slicer both write to the standard output; choose one of them");
  }
}

/** Says also with --quiet that there is no verdict, and why. \param result null: of a job that was finished before */
ExitStatus
GetStatus(const ExtractOptions & options, WallVerdict verdict, const JobResult * result)
{
  if (!options.failsIfThin || options.dryRun || verdict == WallVerdict::Good)
  {
    return ExitStatus::Done;
  }
  if (verdict == WallVerdict::TooThin)
  {
    return ExitStatus::TooThin;
  }
  std::string reason;
  for (const Warning & warning : result ? result->warnings : std::vector<Warning>{})
  {
    reason += warning.isOfEvidence ? ": " + warning.message : "";
  }
  std::cerr << "medialvoxel: no verdict on thin walls, too little was measured" << reason << std::endl;
  return ExitStatus::NotMeasured;
}

/** Labels, a mesh, or both. */
ExitStatus
Extract(const CommandLine & line, ExtractOptions options, const std::string & command)
{
  options.command = command;
  CheckStandardOutput(line, options);
  const JobResult result =
    RunLogged(line, options.logFile, [&options](ProgressSink & sink) { return RunJob(options, sink); });
  if (options.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  else
  {
    PrintResult(line, options, result, ExtractTable);
  }
  return GetStatus(options, GetVerdict(result), &result);
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

/** A job that was finished before has no numbers any more, which is not a result. */
void
PrintEnd(const CommandLine & line, const FinalizeResult & result)
{
  if (result.job)
  {
    PrintResult(line, result.options, *result.job, ExtractTable);
  }
  else if (result.options.reportFile == StandardOutput)
  {
    std::cerr << "medialvoxel: the job was finished before, there is no report" << std::endl;
  }
  else if (!line.program.quiet)
  {
    PrintTable(std::cout, { { "job", "was finished before" } });
  }
}

ExitStatus
ExtractWithResume(const CommandLine & line, const std::string & command)
{
  CheckStandardOutput(line, line.extractOptions);
  const FinalizeResult result = RunLogged(line, line.extractOptions.logFile, [&](ProgressSink & sink) {
    return RunResumable(line.extractOptions, command, sink);
  });
  if (line.extractOptions.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.job->plan, result.job->input, result.job->outputs));
  }
  else
  {
    PrintEnd(line, result);
  }
  return GetStatus(result.options, result.verdict, result.job ? &*result.job : nullptr);
}

void
Plan(const CommandLine & line)
{
  const PlanOptions & options = line.planOptions;
  const PlanResult    result =
    RunLogged(line, options.logFile, [&options](ProgressSink & sink) { return RunPlan(options, sink); });
  if (options.dryRun || !line.program.quiet)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  if (!options.dryRun && !line.program.quiet)
  {
    PrintTable(std::cout,
               result.slurm ? DescribeSlurmSteps(*result.slurm)
                            : DescribeNextSteps(options.jobFolder, result.plan.divisions));
  }
}

void
Work(const CommandLine & line)
{
  const WorkResult result = RunLogged(
    line, line.processOptions.logFile, [&line](ProgressSink & sink) { return RunWork(line.workOptions, sink); });
  if (!line.program.quiet)
  {
    PrintTable(std::cout,
               { { "clusters done", std::to_string(result.done.size()) },
                 { "clusters skipped", std::to_string(result.skipped) } });
  }
}

ExitStatus
Finalize(const CommandLine & line)
{
  const FinalizeResult result = RunLogged(line, line.processOptions.logFile, [&line](ProgressSink & sink) {
    return RunFinalize(line.finalizeOptions, sink);
  });
  PrintEnd(line, result);
  return GetStatus(result.options, result.verdict, result.job ? &*result.job : nullptr);
}

void
ShowStatus(const CommandLine & line)
{
  const JobStatus status = GetJobStatus(line.program.jobFolder);
  if (line.program.printsJson)
  {
    std::cout << MakeStatusJson(status);
  }
  else
  {
    PrintTable(std::cout, DescribeStatus(status));
  }
}

void
BuildSurface(const CommandLine & line)
{
  const PartOptions & options = line.partOptions;
  CheckStandardOutput(line, options);
  const JobResult result =
    RunLogged(line, options.logFile, [&options](ProgressSink & sink) { return RunJob(options, sink); });
  if (options.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  else
  {
    PrintResult(line, options, result, SurfaceTable);
  }
}

void
ComputeDistance(const CommandLine & line)
{
  const DistanceOptions & options = line.distanceOptions;
  CheckStandardOutput(line, options);
  const JobResult result =
    RunLogged(line, options.logFile, [&options](ProgressSink & sink) { return RunJob(options, sink); });
  if (options.dryRun)
  {
    PrintTable(std::cout, DescribePlan(result.plan, result.input, result.outputs));
  }
  else
  {
    PrintResult(line, options, result, DistanceTable);
  }
}

void
DescribeInput(const CommandLine & line)
{
  CheckOptions(line.infoOptions);
  const VolumeHeader header = ReadInputHeader(line.infoOptions);
  TextTable          table = DescribeHeader(header);
  const auto         append = [&table](const TextTable & more) { table.insert(table.end(), more.begin(), more.end()); };
  const auto         sink = MakeSink(line);
  for (const Warning & warning : header.warnings)
  {
    sink->Warn(warning.code, warning.message);
  }
  const auto observer = [&sink](double share) {
    sink->Report(share);
    if (sink->IsStopRequested())
    {
      throw StoppedBySignal(GetStopSignal());
    }
  };
  if (line.program.showsValues)
  {
    sink->Start("medialvoxel", "reading values");
    append(DescribeValues(MeasureValues(header, observer)));
  }
  if (line.program.showsLabels)
  {
    sink->Start("medialvoxel", "reading labels");
    append(DescribeObjects(line.infoOptions, header, observer));
  }
  PrintTable(std::cout, table);
}

ExitStatus
RunCommand(const CommandLine & line, const std::string & command)
{
  if (line.extract->parsed() && line.program.resumes)
  {
    return ExtractWithResume(line, command);
  }
  else if (line.extract->parsed())
  {
    return Extract(line, line.extractOptions, command);
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
    return Finalize(line);
  }
  else if (line.status->parsed())
  {
    ShowStatus(line);
  }
  else if (line.mesh->parsed())
  {
    return Extract(line, line.meshOptions, command);
  }
  else if (line.surface->parsed())
  {
    BuildSurface(line);
  }
  else if (line.distance->parsed())
  {
    ComputeDistance(line);
  }
  else
  {
    DescribeInput(line);
  }
  return ExitStatus::Done;
}

/** "help" and "help COMMAND" as the options of this name. */
std::vector<std::string>
ReplaceHelp(std::vector<std::string> words)
{
  if (!words.empty() && words.front() == "help")
  {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  return words;
}

/** The word typed in place of a command, or the option that the command lacks, with the name that was probably meant;
 * empty for other errors. */
std::string
DescribeUnknownName(const CLI::App & app, const std::vector<std::string> & words)
{
  if (words.empty() || words.front().empty() || words.front().front() == '-')
  {
    return "";
  }
  const CLI::App * const   command = FindCommand(app, words);
  std::vector<std::string> names;
  if (command == nullptr && words.front() == "check")
  {
    return "'check' has left the program; python -m medialvoxel check reads meshes, and mesh reports the quality of "
           "its own";
  }
  if (command == nullptr)
  {
    for (const CLI::App * const known : app.get_subcommands({}))
    {
      names.push_back(known->get_name());
    }
    return "'" + words.front() + "' is not a command" + SuggestName(words.front(), names);
  }
  for (const CLI::Option * const option : command->get_options())
  {
    names.push_back(option->get_positional() ? option->get_name(true) : option->get_name());
  }
  for (const std::string & word : words)
  {
    const std::string name = word.substr(0, word.find('='));
    if (name.size() > 2 && name.compare(0, 2, "--") == 0 && !command->get_option_no_throw(name))
    {
      return DescribeUnknownOption(name, words.front(), names);
    }
  }
  return "";
}

/** The end of a message on wrong usage. */
std::string
PointToHelp(const CLI::App * command)
{
  return std::string(" (see medialvoxel ") + (command != nullptr ? command->get_name() + " " : "") + "--help)";
}

/** Help and version are results, but not for an unknown command; other ends of the parsing are errors. */
int
ReportParsing(const CLI::App & app, const std::vector<std::string> & words, const CLI::ParseError & error)
{
  const CLI::App * const command = FindCommand(app, words);
  const bool             isKnown = command != nullptr || words.empty() || words.front().rfind('-', 0) == 0;
  if (isKnown && error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
  {
    return app.exit(error);
  }
  std::string message = DescribeUnknownName(app, words);
  if (message.empty())
  {
    message = error.what();
  }
  std::cerr << "medialvoxel: " << itk::MedialVoxelText::MakePrintable(message) << PointToHelp(command) << std::endl;
  return static_cast<int>(ExitStatus::Usage);
}

/** A message that begins with the name of a file, behind the option that named it. */
std::string
NameOption(const CLI::App & command, const std::string & message)
{
  for (const CLI::Option * const option : GetOptions(command, false))
  {
    const bool isFile = option->count() > 0 && option->get_type_name() == "FILE";
    if (isFile && message.rfind(option->results().front() + ": ", 0) == 0)
    {
      return option->get_name() + " " + message;
    }
  }
  return message;
}

} // namespace

int
main(int argc, char * argv[])
{
  return RunProgram("medialvoxel", [&] {
    CommandLine                    line;
    const auto                     app = DefineCommandLine(line);
    const std::vector<std::string> words = ReplaceHelp({ argv + std::min(argc, 1), argv + argc });
    try
    {
      ParseWords(*app, words, [&line](const CLI::Option & option) {
        const OptionRow * const row = FindRow(line, option);
        return row && row->value.isFlag ? row->value.choices : std::vector<std::string>();
      });
    }
    catch (const CLI::ParseError & error)
    {
      return ReportParsing(*app, words, error);
    }
    if (line.generate->parsed())
    {
      WriteCommandTexts(line, *app);
      return static_cast<int>(ExitStatus::Done);
    }
    try
    {
      CompleteCommandLine(line);
      return static_cast<int>(RunCommand(line, JoinCommand(argc, argv)));
    }
    catch (const JobError & error)
    {
      const CLI::App & command = *app->get_subcommands().front();
      const bool       isUsage = error.GetStatus() == ExitStatus::Usage;
      throw JobError(error.GetStatus(),
                     isUsage ? NameOption(command, error.what()) + PointToHelp(&command) : error.what());
    }
  });
}
