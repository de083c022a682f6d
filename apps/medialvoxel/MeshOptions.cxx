// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshOptions.h"

#include "CommandParts.h"
#include "MeasureOptions.h"
#include "OptionValues.h"
#include "SurfaceFormat.h"

namespace medialvoxel
{

CLI::Option *
AddMesh(CLI::App & app, const std::string & name, ExtractOptions & options)
{
  return AddFile(app, name, "Surface: " + CLI::detail::join(ListSurfaceExtensions(), " "), options.meshFile);
}

CLI::Option *
AddSectionWidth(CLI::App & app, ExtractOptions & options)
{
  return AddText(
    app, "--section-width", "Step of the thickness of .inp and .bdf sections", "W", [&](const std::string & text) {
      options.sectionWidth = ToDouble(text);
    });
}

CLI::Option *
AddElementSize(CLI::App & app, ExtractOptions & options)
{
  return AddText(app, "--element-size", "Length of the mesh's sides; auto, voxel", "H", [&](const std::string & text) {
    options.elementSize = ToElementSize(text);
  });
}

void
DefineMesh(CommandLine & line)
{
  CLI::App &       app = *line.mesh;
  ExtractOptions & options = line.meshOptions;
  AddInput(app, options);
  AddMesh(app, "OUTPUT", options)->required();
  AddThickness(line, app, options);
  AddObjectOptions(app, options);
  const std::string group = "Mesh";
  app.add_flag("--triangles", options.meshTriangles, "Split the quadrilaterals")->group(group);
  AddText(app,
          "--smallest-component",
          "Leave out components of fewer quadrilaterals",
          "N",
          [&](const std::string & text) { options.smallestComponent = ToCount(text, 0, LargestCount); })
    ->group(group);
  AddElementSize(app, options)->group(group);
  AddSectionWidth(app, options)->group(group);
  AddText(app, "--min-branch-length", "Leave out branches shorter than L", "L", [&](const std::string & text) {
    options.minimumBranchLength = ToDouble(text);
  })->group(group);
  AddSubVoxel(app, options)->group(group);
  AddFile(app, "--report", "All numbers (JSON); - for stdout", options.reportFile)->group("Further outputs");
  AddRunOptions(line, app, options);
  AddRawOptions(line, app, options);
  line.examples[&app] = { "medialvoxel mesh part.mha part.vtp --lower 72",
                          "medialvoxel mesh part.mha shell.inp --lower 72 --element-size 3" };
  app.footer("Vertices have the thickness of the wall, in the units of the spacing.");
}

} // end namespace medialvoxel
