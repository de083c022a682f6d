// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionEffects.h"

#include "Errors.h"
#include "Options.h"
#include "Outputs.h"
#include "SurfaceFormat.h"
#include "Text.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace medialvoxel
{
namespace
{

/** An option and when it has an effect. */
template <typename TOptions>
struct OptionEffect
{
  const char * option;
  bool (*hasEffect)(const TOptions &);
  const char * need;
};

template <typename TOptions>
bool
WritesZarr(const TOptions & options)
{
  const std::vector<std::string> names = ListVolumeNames(options);
  return std::any_of(names.begin(), names.end(), [](const std::string & name) {
    return ToLower(std::filesystem::path(name).extension().string()) == ".zarr";
  });
}

bool
HasElements(const ExtractOptions & options)
{
  return !options.meshFile.empty() && HoldsElements(GetSurfaceFormat(options.meshFile));
}

bool
HasSections(const ExtractOptions & options)
{
  return HasElements(options) && options.thicknessPlace == ThicknessPlace::Sections;
}

bool
IsAutomatic(const ExtractOptions & options)
{
  return !options.thickness;
}

const std::vector<OptionEffect<ExtractOptions>> ExtractEffects{
  { "--minimum-thickness", IsAutomatic, "the thickness auto" },
  { "--maximum-thickness", IsAutomatic, "the thickness auto" },
  { "--vector-boundary", [](const ExtractOptions & options) { return !options.vectorFile.empty(); }, "--vectors" },
  { "--local-thickness-method",
    [](const ExtractOptions & options) { return !options.localThicknessFile.empty(); },
    "--local-thickness" },
  { "--objects", [](const ExtractOptions & options) { return options.labels.has_value(); }, "--labels" },
  { "--segments", [](const ExtractOptions & options) { return options.labels.has_value(); }, "--labels" },
  { "--levels", [](const ExtractOptions & options) { return options.subVoxel.value_or(true); }, "sub-voxel measures" },
  { "--smallest-place", ListsPlaces, "--thin-below or --thick-above" },
  { "--places", ListsPlaces, "--thin-below or --thick-above" },
  { "--fail-if-thin", [](const ExtractOptions & options) { return options.thinBelow.has_value(); }, "--thin-below" },
  { "--element-size", [](const ExtractOptions & options) { return !options.meshFile.empty(); }, "--mesh" },
  { "--thickness-at", HasElements, "a mesh that is written as .inp, .bdf or .k" },
  { "--section-width", HasSections, "sections of a mesh that is written as .inp, .bdf or .k" },
  { "--zarr-compression", WritesZarr<ExtractOptions>, "an output that is written as .zarr" },
};

const std::vector<OptionEffect<DistanceOptions>> DistanceEffects{
  { "--zarr-compression", WritesZarr<DistanceOptions>, "an output that is written as .zarr" },
};

template <typename TOptions>
void
Check(const CLI::App & app, const std::vector<OptionEffect<TOptions>> & effects, const TOptions & options)
{
  for (const OptionEffect<TOptions> & effect : effects)
  {
    const CLI::Option * const option = app.get_option_no_throw(effect.option);
    if (option != nullptr && option->count() > 0 && !effect.hasEffect(options))
    {
      Fail(ExitStatus::Usage, effect.option, " has no effect here; it needs ", effect.need);
    }
  }
}

} // namespace

void
CheckOptionEffects(const CommandLine & line)
{
  for (const auto & [app, options] :
       { std::pair<const CLI::App *, const ExtractOptions *>{ line.extract, &line.extractOptions },
         { line.mesh, &line.meshOptions },
         { line.plan, &line.planOptions } })
  {
    Check(*app, ExtractEffects, *options);
  }
  Check(*line.distance, DistanceEffects, line.distanceOptions);
}

} // end namespace medialvoxel
