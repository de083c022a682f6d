// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayRun.h"

#include "CommandLine.h"
#include "CommandWords.h"
#include "JobResult.h"
#include "NamedCounts.h"
#include "OptionChecks.h"
#include "ValueStatistics.h"
#include "Warnings.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

/** Sets the threshold of Otsu where it is asked for, and refuses labels that the values cannot have. */
void
SetObject(const ArrayCall & call, JobOptions & options)
{
  CheckLabel(options, call.header);
  if (options.lowerIsOtsu)
  {
    const auto stop = [&call](double) {
      if (call.control.stop.load() != 0)
      {
        throw StoppedBySignal(0);
      }
    };
    const std::uint64_t number = call.header.geometry.GetNumberOfVoxels();
    SetOtsuThreshold(options, call.header, MeasureValues(call.header.pixelType, call.array.values, number, stop));
  }
}

/** Words for arrays instead of those for files. */
std::string
ForArrays(std::string message)
{
  const std::pair<std::string, std::string> words[] = {
    { "--resample auto brings the input to equal spacing", "resample the array to equal spacing" },
    { "--largest-ball", "largest_ball" },
  };
  for (const auto & [ofFiles, ofArrays] : words)
  {
    if (const std::size_t at = message.find(ofFiles); at != std::string::npos)
    {
      message.replace(at, ofFiles.size(), ofArrays);
    }
  }
  return message;
}

/** The warnings of the program that need no survey of walls.
 * \throw JobError Usage for a label that no value has */
template <typename TOptions>
void
AddWarnings(nlohmann::json & numbers, const ArrayCall & call, const TOptions & options)
{
  std::vector<Warning> warnings = FindWarningsOfRequest(options, call.header);
  if (numbers.contains("counts"))
  {
    const nlohmann::json & counts = numbers["counts"];
    JobResult              result;
    result.input = call.header;
    for (const NamedCount & count : NamedCounts)
    {
      result.sums.counts.*count.member = counts.value(count.name, std::uint64_t{ 0 });
    }
    result.sums.voxelsAtMaximum = counts.value("voxels_at_maximum", std::uint64_t{ 0 });
    const std::vector<Warning> found = FindWarningsOfResult(options, result);
    warnings.insert(warnings.end(), found.begin(), found.end());
  }
  numbers["warnings"] = nlohmann::json::array();
  for (const Warning & warning : warnings)
  {
    numbers["warnings"].push_back({ { "code", warning.code }, { "message", ForArrays(warning.message) } });
  }
}

template <typename TOptions, typename TRun>
nlohmann::json
Run(const ArrayCall & call, TOptions & options, TRun && run)
{
  CheckOptions(options);
  SetObject(call, options);
  CheckOptions(options); // with the threshold of Otsu
  nlohmann::json numbers = run();
  numbers["lower"] = options.lowerThreshold ? nlohmann::json(options.lowerThreshold->GetNearestDouble()) : nullptr;
  AddWarnings(numbers, call, options);
  return numbers;
}

} // namespace

nlohmann::json
RunArguments(const ArrayCall & call, std::vector<std::string> arguments, ArrayMesh & mesh)
{
  CommandLine line;
  const auto  app = DefineCommandLine(line);
  ParseWords(*app, std::move(arguments));
  CompleteCommandLine(line);
  if (line.surface->parsed()) // of its thickness alone
  {
    return Run(call, line.partOptions, [&] { return MeasureLocalThickness(call, line.partOptions); });
  }
  if (line.distance->parsed())
  {
    return Run(call, line.distanceOptions, [&] { return MeasureDistances(call, line.distanceOptions); });
  }
  ExtractOptions & options = line.mesh->parsed() ? line.meshOptions : line.extractOptions;
  GetParameters(options, GetGrid(options, call.header));
  return Run(
    call, options, [&] { return line.mesh->parsed() ? MeshArray(call, options, mesh) : ExtractArray(call, options); });
}

} // end namespace medialvoxel
