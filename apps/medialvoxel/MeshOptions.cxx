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
  return AddFile(app, name, "Mesh: " + CLI::detail::join(ListSurfaceExtensions(), " "), options.meshFile);
}

CLI::Option *
AddSectionWidth(CLI::App & app, ExtractOptions & options)
{
  return AddText(app, "--section-width", "Step of the thickness of sections", "W", [&](const std::string & text) {
    options.sectionWidth = ToLength(text);
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
CompleteElementSize(const CLI::App & app, ExtractOptions & options)
{
  if (app.count("--element-size") == 0 && !options.meshFile.empty() &&
      HoldsElements(GetSurfaceFormat(options.meshFile)))
  {
    options.elementSize.kind = ElementSize::Kind::Automatic;
  }
}

namespace
{

CLI::Option *
AddThicknessPlace(CommandLine & line, CLI::App & app, ExtractOptions & options)
{
  const std::vector<std::pair<std::string, ThicknessPlace>> places{ { "sections", ThicknessPlace::Sections },
                                                                    { "nodes", ThicknessPlace::Nodes } };
  CLI::Option * const                                       option =
    AddChoice(app, "--thickness-at", "Thickness of elements for solvers", "PLACE", options.thicknessPlace, places);
  line.choices[option] = ListNames(places);
  return option;
}

} // namespace

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
  AddFlag(app, "--triangles", "Split the quadrilaterals", options.meshTriangles)->group(group);
  AddText(app,
          "--smallest-component",
          "Leave out components of fewer quadrilaterals",
          "N",
          [&](const std::string & text) { options.smallestComponent = ToCount(text, 0, LargestCount); })
    ->group(group);
  AddElementSize(app, options)->group(group);
  AddThicknessPlace(line, app, options)->group(group);
  AddFlag(app, "--extend-rims", "Carry the sheet on to the free edges of the part", options.extendsRims)->group(group);
  AddSectionWidth(app, options)->group(group);
  AddText(app, "--min-branch-length", "Leave out branches shorter than L", "L", [&](const std::string & text) {
    options.minimumBranchLength = ToLengthOrNone(text);
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
