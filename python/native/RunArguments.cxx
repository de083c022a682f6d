// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayRun.h"

#include "CommandLine.h"
#include "CommandWords.h"
#include "OptionEffects.h"
#include "OptionValues.h"
#include "ValueStatistics.h"

#include "itkMedialVoxelGridLimits.h"

#include <utility>

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
DefineLocalThickness(CommandLine & line, LocalThicknessOptions & options)
{
  using Method = LocalThicknessMethod;
  line.distance->name(LocalThicknessCommand);
  AddText(*line.distance, "--maximum", "Diameter at which balls are cut", "T", [&options](const std::string & text) {
    options.maximum = ToLength(text);
  });
  AddChoice<Method>(*line.distance,
                    "--method",
                    "Of walls, or of largest balls",
                    "KIND",
                    options.method,
                    { { GetName(Method::Wall), Method::Wall }, { GetName(Method::Sphere), Method::Sphere } });
  AddFlag(*line.distance, "--sub-voxel", "Measure walls on gray values", options.subVoxel);
}

template <typename TOptions, typename TRun>
nlohmann::json
Run(const ArrayCall & call, TOptions & options, TRun && run)
{
  CheckOptions(options);
  SetObject(call, options);
  CheckOptions(options); // with the threshold of Otsu
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
  LocalThicknessOptions localThickness;
  if (isLocalThickness)
  {
    DefineLocalThickness(line, localThickness);
  }
  ParseWords(*app, std::move(arguments));
  CheckOptionEffects(line);
  if (isLocalThickness)
  {
    static_cast<JobOptions &>(localThickness) = line.distanceOptions;
    return Run(call, localThickness, [&] { return MeasureLocalThickness(call, localThickness); });
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
