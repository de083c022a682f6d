// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayRun.h"

#include "ArraySource.h"
#include "JobResult.h"
#include "NamedCounts.h"
#include "ObjectRule.h"
#include "OptionChecks.h"
#include "OptionTable.h"
#include "ValueStatistics.h"
#include "Warnings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

/** Sets the threshold of Otsu on request, and refuses labels that the values cannot have. */
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
    ArraySource source(call);
    SetOtsuThreshold(options, call.header, MeasureValues(source, call.header.geometry.GetVoxelBox(), {}, stop));
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

/** The row of the option or, for other words, of the argument that comes next. */
const OptionRow &
FindRow(unsigned int command, const std::string & name, std::size_t & arguments)
{
  const bool  isArgument = name.compare(0, 2, "--") != 0;
  std::size_t passed = 0;
  for (const OptionRow & row : ListOptions())
  {
    const bool isOfCommand = (row.commands & command) != 0;
    if (isOfCommand && (isArgument ? row.IsArgument() && passed++ == arguments : row.name == name))
    {
      arguments += isArgument ? 1 : 0;
      return row;
    }
  }
  Fail(ExitStatus::Usage, "the command has no option ", name);
}

/** Sets options from words, one for each argument or option; its value stands behind an equals sign.
 * \param voxel its length, of lengths in voxels
 * \throw JobError Usage for wrong values, and for options without an effect */
void
SetOptions(unsigned int command, const std::vector<std::string> & words, const OptionTarget & target, double voxel)
{
  std::size_t                    arguments = 0;
  std::vector<const OptionRow *> given;
  for (const std::string & word : words)
  {
    const std::size_t sign = word.compare(0, 2, "--") == 0 ? word.find('=') : std::string::npos;
    const std::string name = word.substr(0, sign);
    const OptionRow & row = FindRow(command, name, arguments);
    const std::string text = row.IsArgument() ? word : (sign == std::string::npos ? "true" : word.substr(sign + 1));
    try
    {
      row.value.set(target, row.value.isLength ? ReplaceUnits(text, voxel) : text);
    }
    catch (const WrongValue & error)
    {
      Fail(ExitStatus::Usage, row.name, ": ", error.what());
    }
    given.push_back(&row);
  }
  for (const OptionRow * const row : given)
  {
    if (row->hasEffect && !row->hasEffect(target))
    {
      Fail(ExitStatus::Usage, row->name, " has no effect here; it needs ", row->need);
    }
  }
}

/** Sets options of a command, and runs it. */
template <typename TOptions, typename TRun>
nlohmann::json
Run(const ArrayCall & call, unsigned int command, const std::vector<std::string> & words, TRun && run)
{
  TOptions                    options;
  ProgramOptions              program;
  const std::vector<double> & spacing = call.header.geometry.spacing;
  SetOptions(command, words, MakeTarget(options, program), *std::min_element(spacing.begin(), spacing.end()));
  CheckOptions(options);
  if constexpr (std::is_same_v<TOptions, ExtractOptions>)
  {
    GetParameters(options, GetGrid(call.header));
  }
  SetObject(call, options);
  CheckOptions(options); // with the threshold of Otsu
  nlohmann::json numbers = run(call, options);
  numbers["lower"] = options.lowerThreshold ? nlohmann::json(options.lowerThreshold->GetNearestDouble()) : nullptr;
  AddWarnings(numbers, call, options);
  return numbers;
}

} // namespace

nlohmann::json
RunArguments(const ArrayCall & call, std::vector<std::string> arguments, ArrayMesh & mesh)
{
  const std::string command = arguments.at(0);
  arguments.erase(arguments.begin());
  if (command == "surface") // of its thickness alone
  {
    return Run<PartOptions>(call, Commands::Surface, arguments, MeasureLocalThickness);
  }
  if (command == "distance")
  {
    return Run<DistanceOptions>(call, Commands::Distance, arguments, MeasureDistances);
  }
  if (command == "mesh")
  {
    return Run<ExtractOptions>(call, Commands::Mesh, arguments, [&mesh](const auto & of, const auto & options) {
      return MeshArray(of, options, mesh);
    });
  }
  return Run<ExtractOptions>(call, Commands::Extract, arguments, [](const auto & of, const auto & options) {
    return options.wallsFile.empty() ? ExtractArray(of, options) : NumberArrayWalls(of, options);
  });
}

} // end namespace medialvoxel
