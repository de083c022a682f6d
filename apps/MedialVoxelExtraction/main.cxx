// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "EmbeddedXml.h"
#include "ModuleCommandLine.h"
#include "Program.h"
#include "Version.h"
#include "VolumeJob.h"

#include <iostream>

namespace
{

using namespace medialvoxel;

void
Extract(const ParameterTable & table, ModuleOptions & options)
{
  ApplyObjectSelection(table, options);
  ApplyThickness(table, options);
  // 3D Slicer names the same temporary files in each run.
  options.job.overwrite = true;
  if (options.echo)
  {
    PrintValues(std::cout, table);
  }
  const auto sink = MakeProgressSink(ProgressStyle::Slicer);
  RunExtract(options.job, *sink);
}

void
RunModule(const std::vector<std::string> & arguments)
{
  ModuleOptions  options;
  ParameterTable table = DefineParameters(options);
  switch (ParseArguments(arguments, table))
  {
    case ModuleAction::Run:
      Extract(table, options);
      break;
    case ModuleAction::PrintHelp:
      PrintHelp(std::cout, table);
      break;
    case ModuleAction::PrintVersion:
      std::cout << "MedialVoxelExtraction " << GetVersion() << '\n';
      break;
    case ModuleAction::PrintXml:
      std::cout << GetEmbeddedXml();
      break;
  }
}

} // namespace

int
main(int argc, char * argv[])
{
  return RunProgram("MedialVoxelExtraction", [&] {
    RunModule({ argv + 1, argv + argc });
    return static_cast<int>(ExitStatus::Done);
  });
}
