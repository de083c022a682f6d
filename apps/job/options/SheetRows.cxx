// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionTable.h"

#include "SlicerElements.h"
#include "Text.h"

namespace medialvoxel
{
namespace
{

using namespace Commands;
using Parameters = itk::MedialVoxelParameters;

OptionValue
Thickness()
{
  return OfLengths(Value<ExtractOptions>(
    [](ExtractOptions & options, const std::string & text) {
      options.thickness =
        ToLower(text) == AutomaticThickness ? std::nullopt : std::optional<double>(ToLength(text, " or auto"));
    },
    [](const ExtractOptions & options) {
      return options.thickness ? std::optional<std::string>(FormatNumber(*options.thickness)) : std::nullopt;
    }));
}

bool
IsAutomatic(const ExtractOptions & options)
{
  return !options.thickness;
}

/** The pore size of the module: -1 stands for the default. */
OptionValue
ModulePoreSize()
{
  OptionValue value = Value<ExtractOptions>(
    [](ExtractOptions & options, const std::string & text) {
      const std::int64_t size = ToInteger(text, -1, static_cast<std::int64_t>(LargestPoreSize));
      options.maximumPoreSize = size < 0 ? std::nullopt : std::optional<std::uint64_t>(size);
    },
    [](const ExtractOptions & options) {
      return std::optional<std::string>(options.maximumPoreSize ? std::to_string(*options.maximumPoreSize) : "-1");
    });
  return value;
}

/** The numbers in texts. */
std::string
Format(double value)
{
  return FormatNumber(value);
}

void
AddThickness(std::vector<OptionRow> & rows)
{
  const std::string group = "Object";
  const std::string fewest = Format(Parameters::FewestVoxelsOfWalls);
  const std::string most = Format(Parameters::MostVoxelsOfWalls);
  using Mode = itk::MedialVoxelThicknessMode;
  AddRow(rows, "", "", {})
    .Slicer({ group,
              "thicknessMode",
              "Thickness mode",
              "Automatic: each wall from " + fewest + " to " + most +
                " voxels by its own thickness; Fixed: one thickness for all walls",
              "",
              "",
              Choice<ModuleOptions, Mode>(&ModuleOptions::thicknessMode,
                                          { { "Automatic", Mode::Automatic }, { "Fixed", Mode::Fixed } }) });
  AddRow(rows, "--thickness", "T", Thickness())
    .OfJobs(Sheets, "Method")
    .Help("Thickness of the walls, or auto (default: auto)",
          "In units of the spacing; greater than 0. A number gives all cells the same threshold.")
    .Python(Extract | Mesh)
    .Slicer(
      { group,
        "thickness",
        "Thickness",
        "Thickness of the walls that become sheets, used by Fixed, in the units of the spacing (mm); greater than 0. "
        "3 voxels suit walls below 6 voxels, 5 voxels walls up to 8 voxels",
        "double",
        "",
        Length(&ModuleOptions::thickness) });
  AddRow(rows, "--min-thickness", "T", Length(&ExtractOptions::minimumThickness))
    .OfJobs(Sheets, "Method")
    .Hidden()
    .Help("auto: thinner walls count as this (default: " + fewest + " voxels)",
          "In units of the spacing. Needs the thickness auto.")
    .Needs("the thickness auto", IsAutomatic)
    .Python(Extract | Mesh);
  AddRow(rows, "--max-thickness", "T", Length(&ExtractOptions::maximumThickness))
    .OfJobs(Sheets, "Method")
    .Help(
      "auto: thickest wall to be a sheet (default: " + most + ")",
      "In units of the spacing. Needs the thickness auto. The default is doubled where walls need it. Time and memory "
      "grow with it.")
    .Needs("the thickness auto", IsAutomatic)
    .Python(Extract | Mesh);
}

void
AddNoise(std::vector<OptionRow> & rows)
{
  const std::string group = "Object";
  const std::string pores = std::to_string(Parameters::DefaultMaximumPoreSize);
  const std::string largest = std::to_string(LargestPoreSize);
  AddRow(rows, "--max-pore-size", "K", Count(&ExtractOptions::maximumPoreSize, 0, LargestPoreSize))
    .OfJobs(Sheets, "Method")
    .Hidden()
    .Help("Largest pore or grain left out (auto: " + pores + ", else 0)",
          "In voxels, from 0 to " + largest +
            ". Cavities and grains of up to this size are taken for noise; 0 keeps all.")
    .Python(Extract | Mesh)
    .Slicer({ group,
              "maxPoreSize",
              "Maximum pore size",
              "Cavities and grains of up to this many voxels are taken for noise and left out. 0 keeps all; -1 means " +
                pores + " with Automatic and 0 with Fixed",
              "integer",
              "",
              ModulePoreSize(),
              SlicerLimits("-1", largest) });
  using Optional = std::optional<Smoothing>;
  AddRow(rows,
         "--smooth",
         "KIND",
         Choice(&ExtractOptions::smoothing, { Smoothing::Automatic, Smoothing::On, Smoothing::Off }))
    .OfJobs(Sheets, "Method")
    .Help(
      "Noise of the object: smooth it away?",
      "on: smooth the values of a scan, and of everything else the mask; edges and thin walls stay in place. auto: "
      "when 0.75 % or more of the border voxels stand alone, which reads the volume once more. Default: auto with the "
      "thickness auto, otherwise off.")
    .Python(Extract | Mesh)
    .Slicer(
      { group,
        "smoothing",
        "Smoothing",
        "Smooth noise of the object away; edges and thin walls stay in place. Automatic: where the object is rough, "
        "and only with the thickness mode Automatic",
        "",
        "",
        Choice<ExtractOptions, Optional>(
          &ExtractOptions::smoothing,
          { { "Automatic", std::nullopt }, { "On", Smoothing::On }, { "Off", Smoothing::Off } }) });
}

bool
HasLabels(const ExtractOptions & options)
{
  return !options.output.empty();
}

void
AddTopology(std::vector<OptionRow> & rows)
{
  AddRow(rows, "--same-topology", "", Flag(&ExtractOptions::sameTopology))
    .OfJobs(Extractions, "Method")
    .Hidden()
    .Help(
      "Add cells, so that the sheet has the object's topology",
      "They have the label 4. The labels 2, 3 and 4 together have as many parts, tunnels and cavities as the "
      "object; with --labels, as each object. Labels 2 and 3 stay. Takes 2 bytes of scratch space for each voxel; with "
      "--labels 3, and 2 more for each pass.")
    .Needs("OUTPUT", HasLabels)
    .Python(Extract)
    .Slicer({ "Object",
              "sameTopology",
              "Same topology",
              "Add cells with the label 4, so that the labels 2, 3 and 4 together have as many parts, tunnels and "
              "cavities as the object; with Labels, as each object" });
}

void
AddDistances(std::vector<OptionRow> & rows)
{
  using Boundary = itk::MedialVoxelBoundary;
  using Region = itk::MedialVoxelRegion;
  AddRow(rows, "--boundary", "KIND", Choice(&DistanceOptions::boundary, { Boundary::Object, Boundary::Background }))
    .Of(Distance, "Method")
    .Help("Boundary that the vectors lead to",
          "object: border voxels of the object, as ITK's SignedMaurer. background: voxels beside it.")
    .Python(Distance);
  AddRow(rows, "--region", "PART", Choice(&DistanceOptions::region, { Region::Both, Region::Inside, Region::Outside }))
    .Of(Distance, "Method")
    .Help("Voxels with a vector")
    .Python(Distance);
  AddRow(rows, "--max-distance", "X", Length(&DistanceOptions::maximumDistance, ToDistance))
    .Of(Distance, "Method")
    .Help("Voxels farther than this become NaN", "In units of the spacing; greater than 0. Default: none.")
    .Python(Distance);
}

} // namespace

void
AddSheetRows(std::vector<OptionRow> & rows)
{
  AddThickness(rows);
  AddNoise(rows);
  AddTopology(rows);
  AddDistances(rows);
}

} // end namespace medialvoxel
