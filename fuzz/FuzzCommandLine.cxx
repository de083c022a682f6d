// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The command line, one argument per line, up to the checks that come before a file is opened.

#include "FuzzArguments.h"
#include "FuzzSupport.h"
#include "OptionChecks.h"

#include "ClusterRange.h"
#include "Errors.h"

#include <cmath>

namespace
{

using namespace MedialVoxelFuzz;
using namespace medialvoxel;

void
CheckExtract(const ExtractOptions & options)
{
  CheckOptions(options);
  const itk::MedialVoxelGrid       grid({ { 4, 3, 2 } }, { { 0.5, 1.0, 2.0 } });
  const itk::MedialVoxelParameters parameters = GetParameters(options, grid);
  Require(parameters.GetLargestEpsilon() > 0 && std::isfinite(parameters.epsilon), "a threshold that cannot be used");
}

void
CheckParsed(const CommandLine & line)
try
{
  if (line.extract->parsed())
  {
    CheckExtract(line.extractOptions);
  }
  else if (line.mesh->parsed())
  {
    CheckExtract(line.meshOptions);
  }
  else if (line.plan->parsed())
  {
    CheckExtract(line.planOptions);
  }
  else if (line.work->parsed())
  {
    constexpr std::uint64_t numberOfClusters = 1000;
    const auto              clusters = ListClusters(line.workOptions.clusters, numberOfClusters);
    Require(!clusters.empty() && ParseClusters(FormatClusters(clusters)), "clusters without a text that can be read");
  }
  else if (line.distance->parsed())
  {
    CheckOptions(line.distanceOptions);
  }
  else if (line.infoOptions.raw)
  {
    CheckOptions(*line.infoOptions.raw);
  }
}
catch (const JobError & error)
{
  Require(error.GetStatus() == ExitStatus::Usage, "options are refused with another status");
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  if (const CommandLine * const line = ParseArguments(SplitIntoLines(data, size)))
  {
    CheckParsed(*line);
  }
  return 0;
}
