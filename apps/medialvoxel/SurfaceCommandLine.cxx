// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandParts.h"
#include "MeasureOptions.h"
#include "OptionValues.h"
#include "SurfaceFormat.h"

namespace medialvoxel
{

void
DefineSurface(CommandLine & line)
{
  CLI::App &       app = *line.surface;
  SurfaceOptions & options = line.surfaceOptions;
  AddInput(app, options);
  AddFile(app, "OUTPUT", "Triangles: " + CLI::detail::join(ListPartExtensions(), " "), options.output)->required();
  AddObjectOptions(app, options);
  AddFlag(app, "--open", "Leave it open where the volume cuts the part", options.isOpen);
  AddFlag(app, "--sub-voxel", "Place and measure it by gray values; =off: not", [&options](bool value) {
    options.subVoxel = value;
  });
  const std::string group = "Wall thickness";
  AddLocalThicknessMethod(line, app, options.localThicknessMethod, group);
  AddLargestBall(app, options.maximumLocalThickness)->group(group);
  AddPoreSize(app, "Largest pore or grain left out of it (default: 32)", options.maximumPoreSize)->group(group);
  AddFlag(app, "--ray", "Thickness by rays too", options.measuresRays)->group(group);
  AddFile(app, "--report", "All numbers (JSON); - for stdout", options.reportFile)->group("Further outputs");
  AddRunOptions(line, app, options);
  AddRawOptions(line, app, options);
  line.examples[&app] = { "medialvoxel surface part.mha part.glb --lower 72",
                          "medialvoxel surface part.mha part.vtp --lower 72 --ray --report part.json" };
  app.footer("Vertices have the local thickness of the part, in the units of the spacing.");
}

} // end namespace medialvoxel
