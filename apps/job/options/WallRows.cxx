// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionTable.h"

#include "SlicerElements.h"
#include "Text.h"

#include "itkMedialVoxelEngineSettings.h"

namespace medialvoxel
{
namespace
{

using namespace Commands;

constexpr const char * Walls = "Outputs";

constexpr const char * Places = "Options";

constexpr const char * Outputs = "Further outputs";

bool
HasLocalThickness(const ExtractOptions & options)
{
  return !options.localThicknessFile.empty();
}

bool
MayBeSubVoxel(const ExtractOptions & options)
{
  return options.subVoxel.value_or(true);
}

bool
HasThinPlaces(const ExtractOptions & options)
{
  return options.thinBelow.has_value();
}

template <typename TOptions>
OptionValue
Method(LocalThicknessMethod TOptions::* member)
{
  return Choice(member, { LocalThicknessMethod::Wall, LocalThicknessMethod::Sphere });
}

OptionValue
PlacesBeyond(std::optional<PlaceLimits> ExtractOptions::* member, PlaceKind kind)
{
  return OfLengths(
    Value(member, [kind](const std::string & text) { return ToPlaceLimits(text, kind); }, FormatPlaceLimits));
}

void
AddMaps(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--thickness-map", "FILE", File(&ExtractOptions::thicknessFile))
    .OfJobs(Extractions, Walls)
    .Help("Thickness of the walls at medial cells",
          "32-bit real, on the grid of the labels: positive at medial cells, negative at unpaired ones (rims, "
          "junctions), 0 elsewhere.")
    .Python(Extract)
    .Slicer({ Outputs, "thicknessMap", "Thickness", "", SlicerOutput("scalar"), "output" });
  AddRow(rows, "--uncertainty-map", "FILE", File(&ExtractOptions::uncertaintyFile))
    .OfJobs(Extractions, Walls)
    .Help("Half of the 95 % interval of the thickness",
          "32-bit real, on the grid of the labels: NaN at medial cells where it is not known. Needs one threshold and "
          "walls of 5 voxels.")
    .Slicer({ Outputs, "uncertaintyMap", "Uncertainty", "", SlicerOutput("scalar"), "output" });
  AddRow(rows, "--importance", "FILE", File(&ExtractOptions::importanceFile))
    .OfJobs(Extractions, Walls)
    .Hidden()
    .Help(
      "Geodesic distance that decides each cell",
      "32-bit real, on the grid of the labels, in units of the spacing: length of the shortest path on the boundary "
      "between the two points that decide a cell; at most pi / 2 times the largest thickness; 0 at trivial cells. "
      "Values from pi / 2 times a thickness on are the medial cells for that thickness. Not with --labels.")
    .Slicer({ Outputs, "importance", "Importance", "", SlicerOutput("scalar"), "output" });
  AddRow(rows, "--importance-threshold", "FILE", File(&ExtractOptions::importanceThresholdFile))
    .OfJobs(Extractions, Walls)
    .Hidden()
    .Help(
      "What the importance of each cell is compared with",
      "32-bit real, on the grid of the labels, in units of the spacing: medial cells have an importance of at least "
      "their threshold, all others a lower one; 0 where the importance is 0. Not with --labels.");
  AddRow(rows, "--local-thickness", "FILE", File(&ExtractOptions::localThicknessFile))
    .OfJobs(Extractions, Walls)
    .Help("Thickness at each object voxel",
          "32-bit real, on the grid of the input: the thickness of the wall or the ball that covers the center of the "
          "voxel, 0 outside the object. Not with --labels.")
    .Slicer({ Outputs, "localThickness", "Local thickness", "", SlicerOutput("scalar"), "output" });
}

void
AddLocalThickness(std::vector<OptionRow> & rows)
{
  const std::string methodHelp = "Of walls, or of largest balls";
  AddRow(rows, "--local-thickness-method", "KIND", Method(&ExtractOptions::localThicknessMethod))
    .OfJobs(Extractions, Walls)
    .Hidden()
    .Help(
      methodHelp,
      "wall: thickness, as in --thickness-map, of the wall whose ball is the largest that covers the voxel; NaN in "
      "edges and corners that no wall covers. sphere: diameter of the largest ball inside the object that does, for "
      "comparison with other programs.")
    .Needs("--local-thickness", HasLocalThickness)
    .Slicer({ Outputs, "localThicknessMethod", "Local thickness method", "" });
  AddRow(rows, "--local-thickness-method", "KIND", Method(&PartOptions::localThicknessMethod))
    .Of(Surface, Walls)
    .Hidden()
    .Help(
      methodHelp,
      "wall: thickness of the wall whose ball is the largest that covers the object voxel beside the vertex; NaN in "
      "edges and corners that no wall covers. sphere: diameter of the largest ball inside the object that does.")
    .Python(Surface);
  using Task = itk::MedialVoxelLocalThickness;
  const std::string ballHelp =
    "Largest ball of the local thickness (default: " + FormatNumber(Task::DefaultVoxels) + " voxels)";
  const std::string most = "In units of the spacing; at most " + FormatNumber(Task::MostVoxels) + " voxels. ";
  AddRow(rows, "--largest-ball", "T", Length(&ExtractOptions::largestBall))
    .OfJobs(Extractions, Walls)
    .Hidden()
    .Help(ballHelp, most + "Larger balls are cut to it. Time and memory grow with it.")
    .Slicer({ Outputs, "largestBall", "Largest ball", "" });
  AddRow(rows, "--largest-ball", "T", Length(&PartOptions::largestBall))
    .Of(Surface, Walls)
    .Hidden()
    .Help(ballHelp, most + "Larger balls are cut to it, and longer rays have no answer. Time and memory grow with it.")
    .Python(Surface);
  AddRow(rows, "--max-pore-size", "K", Count(&PartOptions::maximumPoreSize, 0, LargestPoreSize))
    .Of(Surface, Walls)
    .Hidden()
    .Help("Largest pore or grain that is not measured (default: " +
            std::to_string(itk::MedialVoxelParameters::DefaultMaximumPoreSize) + ")",
          "In voxels, from 0 to " + std::to_string(LargestPoreSize) +
            ". Pores and grains of up to this size stay in the surface; 0 measures beside them.");
  AddRow(rows, "--ray", "", Flag(&PartOptions::measuresRays))
    .Of(Surface, Walls)
    .Help("Thickness by rays too",
          "A second number of each vertex, ray_thickness: the way through the part along the smoothed gradient to the "
          "opposite surface. NaN where the way leaves the volume or is longer than --largest-ball.");
}

void
AddGrayValues(std::vector<OptionRow> & rows)
{
  using Optional = std::optional<bool>;
  AddRow(rows, "--sub-voxel", "", Flag(&ExtractOptions::subVoxel))
    .OfJobs(Sheets, Walls)
    .HiddenIn(Extractions)
    .Help(
      "Measure walls on gray values; =off: on the object",
      "Fits blurred walls to the values where the scan has walls of 5 voxels; otherwise finds where values cross the "
      "threshold. Masks and label maps are measured on the object. Labels stay the same. Default: on where one "
      "threshold "
      "cuts the values.")
    .Python(Extract | Mesh)
    .Slicer(
      { Outputs,
        "subVoxel",
        "Sub-voxel measures",
        "Measure the thickness and the points of the medial surface on the gray values. Automatic: for maps of the "
        "thickness, where the scan has walls of 5 voxels",
        "",
        "",
        Choice<ExtractOptions, Optional>(&ExtractOptions::subVoxel,
                                         { { "Automatic", std::nullopt }, { "On", true }, { "Off", false } }) });
  AddRow(rows, "--materials", "B,M", Value(&ExtractOptions::materials, ToLevels, FormatLevels))
    .OfJobs(Extractions, Walls)
    .Hidden()
    .Help("Values of background and material for --sub-voxel",
          "Default: those of the scan. Needs one threshold, which is between them; M is in the object.")
    .Needs("sub-voxel measures", MayBeSubVoxel)
    .Python(Extract)
    .Slicer(
      { Outputs,
        "materials",
        "Materials",
        "Values of background and material for sub-voxel measures, with a comma between them; empty: those of the "
        "scan" });
}

void
AddNumbers(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--walls", "FILE", File(&ExtractOptions::wallsFile))
    .Of(Sheets, Walls)
    .RefusedIn(Plan)
    .Hidden()
    .Help("Number of the wall of each medial cell",
          "32-bit whole numbers on the grid of the labels: 1 is the largest wall, 0 no wall. Walls end where more than "
          "two meet, and at sharp bends. Not with --labels.")
    .Slicer({ Outputs, "wallsVolume", "Walls", "", SlicerOutput("label"), "output" });
  AddRow(rows, "--wall-table", "FILE", File(&ExtractOptions::wallTableFile))
    .Of(Sheets, Walls)
    .RefusedIn(Plan)
    .Hidden()
    .Help("Table of the walls (.csv)",
          "A row for each: cells, area, thickness, centroid, normal, flatness, length of its rims, neighbors.")
    .Slicer({ Outputs, "wallTableFile", "Table of walls", "", SlicerFile(".csv"), "output" });
  AddRow(rows, "--seam-table", "FILE", File(&ExtractOptions::seamTableFile))
    .Of(Sheets, Walls)
    .RefusedIn(Plan)
    .Hidden()
    .Help("Table of the seams of walls (.csv)", "A row for each: the walls that meet, its length, their angles.")
    .Slicer({ Outputs, "seamTableFile", "Table of seams", "", SlicerFile(".csv"), "output" });
}

void
AddPlaces(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--thin-below", "T,G,A", PlacesBeyond(&ExtractOptions::thinBelow, PlaceKind::Thin))
    .OfJobs(Extractions, Places)
    .Help("List places thinner than T, grown to G, of area A",
          "In units of the spacing, A in squared ones; G and A may be left out: T, T,G or T,,A. A place is connected "
          "medial "
          "cells with walls thinner than G, one of them thinner than T; default of G: 1.125 T. Its cells thinner than "
          "T have "
          "at least the area A; default: that of ten faces of voxels, 10vx; 0 keeps all. Measured as --thickness-map. "
          "Walls "
          "thinner than 3 voxels may have holes. Not with --labels.")
    .Slicer({ Outputs, "thinBelow", "Thin below", "" });
  AddRow(rows, "--thick-above", "T,G,A", PlacesBeyond(&ExtractOptions::thickAbove, PlaceKind::Thick))
    .OfJobs(Extractions, Places)
    .Help("List places thicker than T, grown to G, of area A",
          "As --thin-below; default of G: 0.875 T. Walls thicker than --max-thickness have no medial "
          "cells.")
    .Slicer({ Outputs,
              "thickAbove",
              "Thick above",
              "The same for thicker walls; by default places grow to 0.875 times as much" });
  const char * const places = "--thin-below or --thick-above";
  AddRow(rows, "--places", "FILE", File(&ExtractOptions::placesFile))
    .OfJobs(Extractions, Places)
    .Help(
      "Table of these places (.csv)",
      "The 10000 largest of each kind, the largest first: area, cells, thickness; position and index of the thinnest "
      "(thickest) cell, its two opposite boundary voxels, first and last index.")
    .Needs(places, ListsPlaces)
    .Slicer({ Outputs, "placesFile", "Places", "", SlicerFile(".csv"), "output" });
  AddRow(rows, "--fail-if-thin", "", Flag(&ExtractOptions::failsIfThin))
    .OfJobs(Extractions, Places)
    .Help("Exit status 5 if thin, 6 if not measured",
          "6: there are no thin places, but too little was measured to know. All outputs are written. Needs "
          "--thin-below.")
    .Needs("--thin-below", HasThinPlaces);
}

} // namespace

void
AddWallRows(std::vector<OptionRow> & rows)
{
  AddMaps(rows);
  AddNumbers(rows);
  AddLocalThickness(rows);
  AddGrayValues(rows);
}

void
AddPlaceRows(std::vector<OptionRow> & rows)
{
  AddPlaces(rows);
}

} // end namespace medialvoxel
