// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionTable.h"

#include "SlicerElements.h"
#include "MeshFormat.h"
#include "Text.h"

namespace medialvoxel
{
namespace
{

using namespace Commands;

constexpr const char * SolverExtensions = ".inp, .bdf or .k";

constexpr const char * Nodes = "nodes"; // as a step of sections

std::string
JoinExtensions(const std::vector<std::string> & extensions)
{
  return Join(extensions, " ", [](const std::string & extension) { return extension; });
}

bool
HasMesh(const ExtractOptions & options)
{
  return !options.meshFile.empty();
}

bool
HasElements(const ExtractOptions & options)
{
  return HasMesh(options) && HoldsElements(GetMeshFormat(options.meshFile));
}

/** The step of sections, or the word for nodes. */
OptionValue
Sections()
{
  return OfLengths(Value<ExtractOptions>(
    [](ExtractOptions & options, const std::string & text) {
      const bool isAtNodes = ToLower(text) == Nodes;
      options.thicknessPlace = isAtNodes ? ThicknessPlace::Nodes : ThicknessPlace::Sections;
      options.sectionWidth = isAtNodes ? std::nullopt : std::optional<double>(ToLength(text, " or nodes"));
    },
    [](const ExtractOptions & options) {
      return options.thicknessPlace == ThicknessPlace::Nodes ? std::optional<std::string>(Nodes)
             : options.sectionWidth ? std::optional<std::string>(FormatNumber(*options.sectionWidth))
                                    : std::nullopt;
    }));
}

void
AddMesh(std::vector<OptionRow> & rows)
{
  const std::string formats = "Mesh: " + JoinExtensions(ListMeshExtensions());
  AddRow(rows, "OUTPUT", "FILE", File(&ExtractOptions::meshFile)).Of(Mesh).Help(formats);
  AddRow(rows, "--mesh", "FILE", File(&ExtractOptions::meshFile))
    .Of(Extractions, "Mesh")
    .RefusedIn(Plan)
    .Help(formats, "The medial surface, as medialvoxel mesh writes it. With --labels: that of each object, told apart.")
    .Slicer({ "Further outputs",
              "meshModel",
              "Medial surface",
              "Model of the surface in the middle of the walls, with the thickness of the wall at its points",
              "geometry fileExtensions=\".vtp,.vtk,.ply,.stl,.obj\"",
              "output" });
  AddRow(rows, "--triangles", "", Flag(&ExtractOptions::meshTriangles))
    .Of(Mesh, "Mesh")
    .Help("Split the quadrilaterals", "Along the shorter diagonal.")
    .Python(Mesh);
  AddRow(rows, "--mesh-walls", "", Flag(&ExtractOptions::meshWalls))
    .Of(Sheets, "Mesh")
    .Hidden()
    .RefusedIn(Plan)
    .Help("Give faces the number of their wall",
          "That of --walls and --wall-table. A face has the wall of the medial cell that is nearest to the mean of its "
          "corners. " +
            JoinExtensions(ListWallExtensions()) + " have it. Not with --labels. Needs a mesh.")
    .Needs("--mesh", HasMesh)
    .Slicer({ "Further outputs", "meshWalls", "Walls of the medial surface", "" });
  AddRow(rows, "--min-component-size", "N", Count(&ExtractOptions::minimumComponentSize, 0))
    .Of(Sheets, "Mesh")
    .RefusedIn(Plan)
    .HiddenIn(Extract)
    .Help("Leave out components of fewer faces of a voxel",
          std::string("Default 100 for elements of a size in ") + SolverExtensions +
            "; otherwise 0, which keeps all. Holds the whole surface in memory. Needs a mesh.")
    .Needs("--mesh", HasMesh)
    .Python(Mesh);
}

void
AddElements(std::vector<OptionRow> & rows)
{
  const std::string solvers = SolverExtensions;
  using Kind = ElementSize::Kind;
  AddRow(rows, "", "", {})
    .Slicer({ "Further outputs",
              "elementSizeMode",
              "Element size mode",
              "Elements of the medial surface. Voxel: one for each voxel; Automatic: as long as the wall is thick, at "
              "least two "
              "voxels, for solvers; Fixed: of one length, at bends and junctions at least as long as the wall is thick",
              "",
              "",
              Choice<ModuleOptions, Kind>(
                &ModuleOptions::elementSizeMode,
                { { "Voxel", Kind::Voxel }, { "Automatic", Kind::Automatic }, { "Fixed", Kind::Length } }) });
  AddRow(rows, "--element-size", "H", OfLengths(Value(&ExtractOptions::elementSize, ToElementSize, FormatElementSize)))
    .Of(Sheets, "Mesh")
    .RefusedIn(Plan)
    .Help("Length of the mesh's sides; auto, voxel",
          "In units of the spacing; elements are as long as the wall is thick at least at junctions and bends. auto "
          "(default of .inp, .bdf and .k): as long as the wall is thick, at least two voxels. voxel (default of other "
          "meshes): one face a voxel. Needs a mesh.")
    .Needs("--mesh", HasMesh)
    .Python(Mesh)
    .Slicer(
      { "Further outputs",
        "elementSize",
        "Element size",
        "Length of the sides of the elements, used by Fixed, in the units of the spacing (mm); at least the smallest "
        "spacing",
        "double",
        "",
        Length(&ModuleOptions::elementSize) });
  AddRow(rows, "--extend-rims", "", Flag(&ExtractOptions::extendsRims))
    .Of(Sheets, "Mesh")
    .RefusedIn(Plan)
    .HiddenIn(Extract)
    .Help("Carry the sheet on to free edges; =off: not",
          "The sheet ends half the thickness of its wall before each free edge of the part. It is carried on in its "
          "plane to the surface, at most for the thickness; with --labels for half the thickness. Default: on for "
          "elements of a size in " +
            solvers + ", without --labels. Needs an element size.")
    .Needs("--mesh", HasMesh)
    .Python(Mesh)
    .Slicer({ "Further outputs", "extendRims", "Extend rims", "" });
  AddRow(rows, "--sections", "STEP", Sections())
    .Of(Sheets, "Mesh")
    .Hidden()
    .RefusedIn(Plan)
    .Help(
      "Step of the thickness of sections, or nodes",
      "Elements of nearly the same thickness share a section, as every solver reads. STEP is in units of the spacing; "
      "default: a quarter of the smallest spacing. nodes: .inp has the thickness at nodes, .bdf and .k at the corners "
      "of elements. Needs a mesh in " +
        solvers + ".")
    .Needs("a mesh that is written as " + solvers, HasElements);
  AddRow(rows, "--min-branch-length", "L", Length(&ExtractOptions::minimumBranchLength, ToLengthOrNone))
    .Of(Mesh, "Mesh")
    .Help("Leave out branches shorter than L",
          "In units of the spacing; default 0, which keeps all. Holds the whole surface in memory.")
    .Python(Mesh)
    .Slicer({ "Further outputs",
              "minBranchLength",
              "Minimum branch length",
              "",
              "double",
              "",
              Length(&ExtractOptions::minimumBranchLength, ToLengthOrNone) });
}

void
AddBlock(std::vector<OptionRow> & rows)
{
  AddRow(rows, "OUTPUT", "FILE", File(&PartOptions::output))
    .Of(Surface)
    .Help("Triangles: " + JoinExtensions(ListPartExtensions()));
  AddRow(rows, "--open", "", Flag(&PartOptions::isOpen))
    .Of(Surface, "Method")
    .Hidden()
    .Help("Leave it open where the volume cuts the part",
          "Otherwise it is closed half a voxel beyond the last voxels.");
  AddRow(rows, "--sub-voxel", "", Flag(&PartOptions::subVoxel))
    .Of(Surface, "Method")
    .Help(
      "Place and measure it by gray values; =off: not",
      "Vertices are where linear values cross the threshold, and walls are fitted to values where these allow it; "
      "in masks and label maps, vertices are in the middle between voxels. Default: on where one threshold cuts the "
      "values.")
    .Python(Surface);
}

} // namespace

void
AddMeshRows(std::vector<OptionRow> & rows)
{
  AddMesh(rows);
  AddElements(rows);
  AddBlock(rows);
}

} // end namespace medialvoxel
