// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayRun.h"

#include "CommandLine.h"
#include "OptionEffects.h"
#include "OptionValues.h"
#include "ValueStatistics.h"

#include "itkMedialVoxelGridLimits.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

constexpr const char * LocalThicknessCommand = "local-thickness";

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

/** What a reader of results wants to know of the call. */
void
AddHints(nlohmann::json & numbers, const ArrayCall & call, const JobOptions & options)
{
  numbers["lower"] = options.lowerThreshold ? nlohmann::json(options.lowerThreshold->GetNearestDouble()) : nullptr;
  numbers["warnings"] = nlohmann::json::array();
  const std::string inaccuracy = itk::MedialVoxelGridLimits::FindInaccuracy(GetGrid(options, call.header));
  if (!inaccuracy.empty())
  {
    numbers["warnings"].push_back("the spacing is unequal: " + inaccuracy + "; resample the array to equal spacing");
  }
}

/** Has the command distance be local-thickness, which the program has not: both say the same of object and run. */
void
DefineLocalThickness(CommandLine & line, std::optional<double> & maximum)
{
  line.distance->name(LocalThicknessCommand);
  AddText(*line.distance, "--maximum", "Diameter at which balls are cut", "T", [&maximum](const std::string & text) {
    maximum = ToDouble(text);
  });
}

template <typename TOptions, typename TRun>
nlohmann::json
Run(const ArrayCall & call, TOptions & options, TRun && run)
{
  CheckOptions(options);
  SetObject(call, options);
  nlohmann::json numbers = run();
  AddHints(numbers, call, options);
  return numbers;
}

} // namespace

nlohmann::json
RunArguments(const ArrayCall & call, std::vector<std::string> arguments, ArrayMesh & mesh)
{
  CommandLine           line;
  const auto            app = DefineCommandLine(line);
  const bool            isLocalThickness = arguments.front() == LocalThicknessCommand;
  std::optional<double> maximum;
  if (isLocalThickness)
  {
    DefineLocalThickness(line, maximum);
  }
  std::reverse(arguments.begin(), arguments.end());
  app->parse(std::move(arguments));
  CheckOptionEffects(line);
  if (isLocalThickness)
  {
    LocalThicknessOptions options{ line.distanceOptions, maximum };
    return Run(call, options, [&] { return MeasureLocalThickness(call, options); });
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
