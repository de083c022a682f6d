// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionTable.h"

#include "FormatNames.h"
#include "SlicerElements.h"
#include "Text.h"

namespace medialvoxel
{
namespace
{

using namespace Commands;

constexpr const char * Group = "Outputs";

// The module keeps the names of its groups.
constexpr const char * SlicerGroup = "Further outputs";

std::string
ListExtensions(unsigned int components)
{
  return Join(ListOutputExtensions(components), " ", [](const std::string & extension) { return extension; });
}

bool
SeparatesObjects(const ExtractOptions & options)
{
  return options.labels.has_value();
}

bool
HasColors(const ExtractOptions & options)
{
  return !options.htmlFile.empty() || !options.previewFile.empty();
}

bool
HasVectors(const ExtractOptions & options)
{
  return !options.vectorFile.empty();
}

void
AddArguments(std::vector<OptionRow> & rows)
{
  constexpr unsigned int vector = 3;
  AddRow(rows, "OUTPUT", "FILE", File(&ExtractOptions::output))
    .OfJobs(Extractions)
    .OptionalIn(Extract)
    .Help("Labels: " + ListExtensions(1))
    .Slicer(
      { "IO",
        "outputVolume",
        "Medial voxels",
        "Labels of the cells between the voxels: 0 no object, 1 not medial, 2 medial by bound, 3 medial by geodesic "
        "search, 4 added for the topology. Its origin is half a voxel from that of the input",
        SlicerOutput("label"),
        "output" });
  AddRow(rows, "VECTORS", "FILE", File(&DistanceOptions::output))
    .Of(Distance)
    .Help("Vectors to the boundary: " + ListExtensions(vector));
}

void
AddVolumes(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--objects", "FILE", File(&ExtractOptions::objectFile))
    .Of(Extractions, Group)
    .RefusedIn(Plan)
    .Help(
      "With --labels: the label of each cell's object",
      "Of the type of the input, on the grid of the labels. A cell that is medial for several objects has the smallest "
      "label. Named .seg.nrrd, 3D Slicer loads it as a segmentation with the names and colors.")
    .Needs("--labels", SeparatesObjects)
    .Slicer({ SlicerGroup,
              "objectsVolume",
              "Objects",
              "",
              SlicerOutput("label", ".seg.nrrd,.nrrd,.nhdr,.mha,.mhd"),
              "output" });
  AddRow(rows, "--vectors", "FILE", File(&ExtractOptions::vectorFile))
    .OfJobs(Extractions, Group)
    .Hidden()
    .Help("Vectors to the nearest boundary point",
          "32-bit real components x, y, z at object voxels, 0 elsewhere; in units of the spacing, along the axes of "
          "space.")
    .Python(Extract)
    .Slicer({ SlicerGroup, "vectorVolume", "Vectors", "", SlicerOutput("vector"), "output" });
  using Boundary = itk::MedialVoxelBoundary;
  AddRow(rows,
         "--vector-boundary",
         "KIND",
         Choice(&ExtractOptions::vectorBoundary, { Boundary::Object, Boundary::Background }))
    .OfJobs(Extractions, Group)
    .Hidden()
    .Help("Boundary that they lead to", "object: border voxels of the object. background: background voxels beside it.")
    .Needs("--vectors", HasVectors)
    .Python(Extract)
    .Slicer({ SlicerGroup, "vectorBoundary", "Boundary of the vectors", "" });
  AddRow(rows, "--distance", "FILE", File(&JobOptions::distanceFile))
    .OfJobs(Extractions | Distance, Group)
    .HiddenIn(Extractions)
    .Help("Signed distance, negative inside the object")
    .Slicer({ SlicerGroup, "distanceVolume", "Signed distance", "", SlicerOutput("scalar"), "output" });
}

void
AddViews(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--html", "FILE", File(&ExtractOptions::htmlFile))
    .OfJobs(Extractions, Group)
    .Help(
      "Page with verdict, places, 3-D view (.html)",
      "One file that opens offline: walls, places beyond the limits with a section through each, the sheet in 3-D in "
      "colors of the thickness, and its histogram.");
  AddRow(
    rows, "--color-range", "LOW,HIGH", OfLengths(Value(&ExtractOptions::colorRange, ToColorRange, FormatColorRange)))
    .OfJobs(Extractions, Group)
    .Help(
      "Thickness that colors of page and picture span",
      "Fixed, so that parts can be compared; in units of the spacing. Default: from the 1st to the 99th percentile.")
    .HiddenIn(Extractions)
    .Needs("--html or --preview", HasColors);
  AddRow(rows, "--report", "FILE", File(&JobOptions::reportFile))
    .OfJobs(Runs, Group)
    .Help("All numbers (JSON); - for stdout", "With - it takes the place of the table.")
    .Slicer({ SlicerGroup,
              "reportFile",
              "Report",
              "Parameters, counts, seconds and memory as JSON",
              SlicerFile(".json"),
              "output" });
  AddRow(rows, "--preview", "FILE", File(&ExtractOptions::previewFile))
    .OfJobs(Extractions, Group)
    .Help("Picture of slices and a projection (.png)",
          "With --thickness-map a second picture has the colors of the thickness.")
    .Slicer({ SlicerGroup, "previewFile", "Picture", "", SlicerFile(".png"), "output" });
}

} // namespace

void
AddOutputRows(std::vector<OptionRow> & rows)
{
  AddArguments(rows);
  AddViews(rows);
  AddVolumes(rows);
}

} // end namespace medialvoxel
