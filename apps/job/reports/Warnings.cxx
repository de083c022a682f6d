// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Warnings.h"

#include "FillIn.h"
#include "JobResult.h"
#include "MeshWarnings.h"
#include "ObjectWarnings.h"
#include "Options.h"
#include "Progress.h"
#include "Survey.h"
#include "Text.h"
#include "WarningRules.h"

#include "itkMedialVoxelGridLimits.h"
#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace medialvoxel
{
namespace
{

/** The smallest spacing of axes longer than 1, in physical units. */
double
GetSmallestSpacing(const VolumeGeometry & geometry)
{
  double smallest = 0.0;
  for (std::size_t axis = 0; axis < geometry.size.size(); ++axis)
  {
    if (geometry.size[axis] > 1 && (smallest == 0.0 || geometry.spacing[axis] < smallest))
    {
      smallest = geometry.spacing[axis];
    }
  }
  return smallest > 0.0 ? smallest : geometry.spacing.front();
}

struct Length
{
  std::string name;
  double      value; ///< in the units of the job
  double      voxels;
  std::string text; ///< name and value in both units
};

Length
MeasureLength(const char * name, double value, const VolumeHeader & input)
{
  const double      spacing = GetSmallestSpacing(input.geometry);
  const std::string unit = input.geometry.DescribeUnit();
  Length            length{ name, value, value / spacing, "" };
  length.text = std::string("the ") + name + " of " + FormatShort(value) + " " + unit;
  length.text += unit == "voxels" ? "" : " is " + FormatShort(length.voxels) + " voxels";
  return length;
}

/** Lengths of walls that are far from the usual 1 to 50 voxels: often the units are others than the user thinks. */
std::optional<WarningText>
CheckLength(const char * name, const std::optional<double> & value, const VolumeHeader & input)
{
  constexpr double farBelow = 0.5;
  constexpr double farAbove = 100.0;
  if (!value)
  {
    return std::nullopt;
  }
  const Length length = MeasureLength(name, *value, input);
  if (length.voxels >= farBelow && length.voxels <= farAbove)
  {
    return std::nullopt;
  }
  return WarningText{ length.text + "; 1 to 50 voxels are usual",
                      { { "length", *value }, { "voxels", length.voxels } } };
}

std::optional<WarningText>
CheckMaximumDistance(const DistanceOptions & options, const VolumeHeader & input)
{
  if (!options.maximumDistance)
  {
    return std::nullopt;
  }
  const Length length = MeasureLength("maximum distance", *options.maximumDistance, input);
  if (length.voxels >= 1.0)
  {
    return std::nullopt;
  }
  return WarningText{ length.text + "; only voxels of the boundary have a vector",
                      { { "length", length.value }, { "voxels", length.voxels } } };
}

std::optional<WarningText>
CheckScratch(const JobOptions & options, const VolumeHeader & input)
{
  if (options.scratchFolder.empty() || input.compressed)
  {
    return std::nullopt;
  }
  return WarningText{ "the scratch folder has no use here: the volume is not compressed, and there is no mesh", {} };
}

/** Vectors and distances are exact at any spacing. */
std::optional<WarningText>
CheckSpacing(const ExtractOptions &, const VolumeHeader & input)
{
  const itk::MedialVoxelGrid grid = GetGrid(input);
  const std::string          inaccuracy = itk::MedialVoxelGridLimits::FindInaccuracy(grid);
  if (inaccuracy.empty())
  {
    return std::nullopt;
  }
  return WarningText{ inaccuracy + "; --resample auto brings the input to equal spacing",
                      { { "spacing_ratio", itk::MedialVoxelGridLimits::RatioOf(grid) },
                        { "largest_accurate_ratio", itk::MedialVoxelGridLimits::AccurateRatio } } };
}

const std::vector<Rule<ExtractOptions, VolumeHeader>> RequestRules{
  { "unequal_spacing", CheckSpacing },
  { "unusual_thickness",
    [](const ExtractOptions & options, const VolumeHeader & input) {
      return CheckLength("thickness", options.thickness, input);
    } },
  { "unusual_min_thickness",
    [](const ExtractOptions & options, const VolumeHeader & input) {
      return CheckLength("minimum thickness", options.minimumThickness, input);
    } },
  { "unusual_max_thickness",
    [](const ExtractOptions & options, const VolumeHeader & input) {
      return CheckLength("maximum thickness", options.maximumThickness, input);
    } },
  { "unused_scratch",
    [](const ExtractOptions & options, const VolumeHeader & input) {
      return options.meshFile.empty() ? CheckScratch(options, input) : std::nullopt;
    } },
};

const std::vector<Rule<ExtractOptions, VolumeHeader>> ThicknessRequestRules{ { "unequal_spacing", CheckSpacing } };

const std::vector<Rule<DistanceOptions, VolumeHeader>> DistanceRequestRules{
  { "unusual_max_distance", CheckMaximumDistance },
  { "unused_scratch",
    [](const DistanceOptions & options, const VolumeHeader & input) { return CheckScratch(options, input); } },
};

std::optional<WarningText>
CheckMedialCells(const ExtractOptions & options, const JobResult & result)
{
  const itk::MedialVoxelCounts & counts = result.sums.counts;
  if (counts.objectVoxels == 0 || counts.objectVoxels == result.input.geometry.GetNumberOfVoxels() ||
      counts.boundCells + counts.geodesicMedialCells > 0)
  {
    return std::nullopt;
  }
  return WarningText{ std::string("there are no medial cells and no thickness: no part of the object is a sheet") +
                        (options.thickness ? " of at least the given thickness" : ", as of rods and balls none is"),
                      {} };
}

const std::vector<Rule<ExtractOptions, JobResult>> SheetRules{ { "no_medial_cells", CheckMedialCells, true } };

/** Facts about the walls after an extraction. */
struct WallFacts
{
  const ExtractOptions & options;
  const JobResult &      result;
  const Survey &         survey;

  std::uint64_t
  GetMedialCells() const
  {
    return result.sums.counts.boundCells + result.sums.counts.geodesicMedialCells;
  }

  bool
  AreMeasured() const
  {
    return survey.GetSums().GetAreas().GetTotal() > 0;
  }

  /** False without cells, and when the sample may have missed the few cells of a large volume. */
  bool
  ShouldBeMeasured() const
  {
    constexpr std::uint64_t few = 64;
    const unsigned int      step = survey.GetSample().GetStep();
    return this->GetMedialCells() > (step == 1 ? 0 : few * step);
  }
};

/** A histogram of areas above a length, as a share of all. */
double
GetShareAbove(const LengthHistogram & areas, double length)
{
  const std::vector<std::uint64_t> & numbers = areas.GetNumbers();
  std::uint64_t                      above = 0;
  for (std::size_t bin = areas.GetBin(length) + 1; bin < numbers.size(); ++bin)
  {
    above += numbers[bin];
  }
  return static_cast<double>(above) / static_cast<double>(areas.GetTotal());
}

/** Walls beyond the maximum of the automatic thickness have sheets towards their edges that thinner walls have not. */
std::optional<WarningText>
CheckMaximumThickness(const WallFacts & facts)
{
  constexpr double much = 0.1;
  constexpr double nearlyAll = 99.0;
  if (facts.options.thickness || !facts.AreMeasured())
  {
    return std::nullopt;
  }
  const itk::MedialVoxelGrid grid = GetGrid(facts.result.input);
  const LengthHistogram &    areas = facts.survey.GetSums().GetAreas();
  const double               maximum = GetLimitsOfWalls(facts.options, grid).maximum;
  const double               share = GetShareAbove(areas, maximum);
  if (share < much)
  {
    return std::nullopt;
  }
  const double edge = GetSmallestSpacing(facts.result.input.geometry);
  const double suggestion = std::ceil(areas.GetPercentile(nearlyAll) / edge) * edge;
  return WarningText{
    FormatShare(share) + " of the sheet is of walls thicker than the maximum thickness " + FormatShort(maximum) +
      ", and may be branches towards their edges; a maximum thickness of " + FormatShort(suggestion) +
      " reaches nearly all",
    { { "area_percent", 100.0 * share }, { "max_thickness", maximum }, { "suggested_max_thickness", suggestion } }
  };
}

/** The volume that the medial cells account for: the mean of area times thickness, times the number of cells, so that
 * unmeasured cells count as well. */
double
GetVolumeOfWalls(const WallFacts & facts)
{
  const LengthHistogram & areas = facts.survey.GetSums().GetAreas();
  if (areas.GetTotal() == 0)
  {
    return 0.0;
  }
  const double measured = static_cast<double>(areas.GetTotal()) * facts.survey.GetAreaUnit() * areas.GetMean();
  return measured / static_cast<double>(facts.survey.GetSums().GetCells().GetTotal()) *
         static_cast<double>(facts.GetMedialCells());
}

double
GetVolumeOfObject(const JobResult & result)
{
  const itk::MedialVoxelGrid grid = GetGrid(result.input);
  auto                       volume = static_cast<double>(result.sums.counts.objectVoxels);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    volume *= grid.IsActive(axis) ? grid.GetSpacing()[axis] : 1.0;
  }
  return volume;
}

/** The sheet explains 60 to 110 % of the volume of plates, shells and real parts, and up to a third of rods, balls
 * and solids. */
std::optional<WarningText>
CheckSheets(const WallFacts & facts)
{
  constexpr double half = 0.5;
  if (!facts.ShouldBeMeasured())
  {
    return std::nullopt;
  }
  const double share = GetVolumeOfWalls(facts) / GetVolumeOfObject(facts.result);
  if (share >= half)
  {
    return std::nullopt;
  }
  return WarningText{
    "the sheet explains only " + FormatShare(share) +
      " of the object's volume by its area and thickness; rods, balls and thick blocks have no sheet, "
      "and the thickness says nothing about them",
    { { "explained_percent", 100.0 * share } }
  };
}

/** Balls are cut at the maximum, so the maximum is no thickness. */
std::optional<WarningText>
CheckBalls(const ExtractOptions & options, const JobResult & result)
{
  constexpr double much = 0.01;
  const auto       object = static_cast<double>(std::max<std::uint64_t>(1, result.sums.counts.objectVoxels));
  const double     share = static_cast<double>(result.sums.voxelsAtMaximum) / object;
  if (options.localThicknessFile.empty() || share < much)
  {
    return std::nullopt;
  }
  const double maximum = GetLocalThickness(options, GetGrid(result.input)).maximumThickness;
  return WarningText{ FormatShare(share) + " of the object has the thickness of the largest ball, " +
                        FormatShort(maximum) + ", and may be thicker; a larger --largest-ball measures it",
                      { { "object_percent", 100.0 * share }, { "largest_ball", maximum } } };
}

/** A verdict on a label map is one on each of its objects. */
std::optional<WarningText>
CheckObjectsWithoutWalls(const WallFacts & facts)
{
  if (!facts.options.failsIfThin || facts.result.objects.is_null())
  {
    return std::nullopt;
  }
  std::vector<std::int64_t> unmeasured;
  for (const Json & object : facts.result.objects["objects"])
  {
    if (object["medial_cells"] == 0 || (object["thickness"]["cells"] == 0 && facts.survey.GetSample().GetStep() == 1))
    {
      unmeasured.push_back(object["label"]);
    }
  }
  if (unmeasured.empty())
  {
    return std::nullopt;
  }
  return WarningText{ "of " + std::to_string(facts.result.objects["objects"].size()) + " labels " +
                        std::to_string(unmeasured.size()) + " have no wall that was measured, as has " +
                        std::to_string(unmeasured.front()),
                      { { "labels", static_cast<double>(unmeasured.size()) } } };
}

const std::vector<Rule<WallFacts>> WallRules{ { "beyond_max_thickness", CheckMaximumThickness },
                                              { "few_sheets", CheckSheets, true },
                                              { "labels_without_walls", CheckObjectsWithoutWalls, true } };

const std::vector<Rule<ExtractOptions, JobResult>> BallRules{ { "beyond_largest_ball", CheckBalls } };

} // namespace

std::vector<Warning>
FindWarningsOfRequest(const ExtractOptions & options, const VolumeHeader & input)
{
  std::vector<Warning> warnings = input.GetStored().warnings;
  Apply(RequestRules, warnings, options, input);
  return warnings;
}

std::vector<Warning>
FindWarningsOfRequest(const DistanceOptions & options, const VolumeHeader & input)
{
  std::vector<Warning> warnings = input.GetStored().warnings;
  Apply(DistanceRequestRules, warnings, options, input);
  return warnings;
}

std::vector<Warning>
FindWarningsOfRequest(const PartOptions & options, const VolumeHeader & input)
{
  std::vector<Warning> warnings = input.GetStored().warnings;
  Apply(ThicknessRequestRules, warnings, GetThicknessOptions(options), input);
  return warnings;
}

std::vector<Warning>
FindWarningsOfResult(const ExtractOptions & options, const JobResult & result)
{
  std::vector<Warning> warnings;
  ApplyObjectRules(warnings, options, result);
  Apply(SheetRules, warnings, options, result);
  ApplyMeshRules(warnings, result);
  Apply(BallRules, warnings, options, result);
  return warnings;
}

std::vector<Warning>
FindWarningsOfResult(const ExtractOptions & options, const JobResult & result, const Survey & survey)
{
  std::vector<Warning> warnings = FindWarningsOfResult(options, result);
  Apply(WallRules, warnings, WallFacts{ options, result, survey });
  return warnings;
}

std::vector<Warning>
FindWarningsOfResult(const DistanceOptions & options, const JobResult & result)
{
  std::vector<Warning> warnings;
  ApplyObjectRules(warnings, options, result);
  return warnings;
}

std::vector<Warning>
FindWarningsOfResult(const PartOptions & options, const JobResult & result)
{
  std::vector<Warning> warnings;
  ApplyObjectRules(warnings, options, result);
  Apply(BallRules, warnings, GetThicknessOptions(options), result);
  return warnings;
}

std::set<std::string>
ListWarningCodes()
{
  std::vector<std::string> codes(HeaderWarnings::All.begin(), HeaderWarnings::All.end());
  AddCodes(RequestRules, codes);
  AddCodes(ThicknessRequestRules, codes);
  AddCodes(DistanceRequestRules, codes);
  AddObjectCodes(codes);
  AddCodes(SheetRules, codes);
  AddMeshCodes(codes);
  AddCodes(WallRules, codes);
  AddCodes(BallRules, codes);
  return { codes.begin(), codes.end() };
}

void
TellWarnings(ProgressSink & sink, const std::vector<Warning> & warnings, std::size_t first)
{
  for (std::size_t i = first; i < warnings.size(); ++i)
  {
    sink.Warn(warnings[i].code, warnings[i].message);
  }
}

} // end namespace medialvoxel
