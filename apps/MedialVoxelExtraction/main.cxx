// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandWords.h"
#include "Parameters.h"
#include "Program.h"
#include "RunJob.h"

#include <algorithm>
#include <iostream>

namespace
{

using namespace medialvoxel;

void
Extract(const CLI::App & app, ModuleOptions & options)
{
  CompleteJob(app, options);
  // 3D Slicer names the same temporary files in each run.
  options.job.overwrite = true;
  if (options.echo)
  {
    PrintValues(std::cout, app);
  }
  const auto sink = MakeProgressSink(ProgressStyle::Slicer);
  RunJob(options.job, *sink);
}

/** With the mark after which no argument is an option as the parser knows it; Slicer has another name. */
std::vector<std::string>
GetArguments(int argc, char * argv[])
{
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  std::replace(arguments.begin(), arguments.end(), std::string("--ignore_rest"), std::string("--"));
  return arguments;
}

} // namespace

int
main(int argc, char * argv[])
{
  return RunProgram("MedialVoxelExtraction", [&] {
    ModuleOptions options;
    const auto    app = DefineParameters(options);
    try
    {
      ParseWords(*app, GetArguments(argc, argv));
    }
    catch (const CLI::Success & result) // help, version, description
    {
      return app->exit(result);
    }
    catch (const CLI::ParseError & error)
    {
      Fail(ExitStatus::Usage, error.what());
    }
    Extract(*app, options);
    return static_cast<int>(ExitStatus::Done);
  });
}
