// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeasureOptions.h"

#include "CommandLine.h"
#include "CommandParts.h"
#include "OptionValues.h"

namespace medialvoxel
{
namespace
{

CLI::Option *
AddLevels(CLI::App & app, ExtractOptions & options)
{
  return AddText(app, "--levels", "Values of background and material for that", "B,M", [&](const std::string & text) {
    options.levels = ToLevels(text);
  });
}

void
AddPlaceOptions(CLI::App & app, ExtractOptions & options)
{
  const std::string group = "Thin and thick places";
  AddText(app, "--thin-below", "List places thinner than T, grown to G", "T,G", [&](const std::string & text) {
    options.thinBelow = ToPlaceLimits(text, PlaceKind::Thin);
  })->group(group);
  AddText(app, "--thick-above", "List places thicker than T, grown to G", "T,G", [&](const std::string & text) {
    options.thickAbove = ToPlaceLimits(text, PlaceKind::Thick);
  })->group(group);
  AddText(app, "--smallest-place", "Least area of these places", "A", [&](const std::string & text) {
    options.smallestPlace = ToLengthOrNone(text);
  })->group(group);
  AddFile(app, "--places", "Table of these places (.csv)", options.placesFile)->group(group);
  AddFlag(app, "--fail-if-thin", "Exit status 5 if thin, 6 if not measured", options.failsIfThin)->group(group);
}

} // namespace

CLI::Option *
AddSubVoxel(CLI::App & app, ExtractOptions & options)
{
  const auto set = [&options](bool value) { options.subVoxel = value; };
  return AddFlag(app, "--sub-voxel", "Measure walls on gray values; =off: on the object", set);
}

void
AddLocalThicknessMethod(CommandLine & line, CLI::App & app, LocalThicknessMethod & target, const std::string & group)
{
  const std::vector<std::pair<std::string, LocalThicknessMethod>> methods{
    { GetName(LocalThicknessMethod::Wall), LocalThicknessMethod::Wall },
    { GetName(LocalThicknessMethod::Sphere), LocalThicknessMethod::Sphere }
  };
  CLI::Option * const option =
    AddChoice(app, "--local-thickness-method", "Of walls, or of largest balls", "KIND", target, methods);
  line.choices[option->group(group)] = ListNames(methods);
}

CLI::Option *
AddLargestBall(CLI::App & app, std::optional<double> & target)
{
  return AddText(
    app, "--largest-ball", "Its largest value (default: 32 voxels)", "T", [&target](const std::string & text) {
      target = ToLength(text);
    });
}

void
AddMeasureOptions(CommandLine & line, CLI::App & app, ExtractOptions & options)
{
  const std::string group = "Wall thickness";
  AddFile(app, "--thickness-map", "Thickness of the walls at medial cells", options.thicknessFile)->group(group);
  AddFile(app, "--uncertainty-map", "Half of the 95 % interval of the thickness", options.uncertaintyFile)
    ->group(group);
  AddFile(app, "--local-thickness", "Thickness at each object voxel", options.localThicknessFile)->group(group);
  AddLocalThicknessMethod(line, app, options.localThicknessMethod, group);
  AddLargestBall(app, options.maximumLocalThickness)->group(group);
  AddSubVoxel(app, options)->group(group);
  AddLevels(app, options)->group(group);
  AddFile(app, "--thickness-csv", "Histogram of the thickness (.csv)", options.thicknessCsvFile)->group(group);
  AddPlaceOptions(app, options);
}

} // end namespace medialvoxel
