// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Options.h"

#include "LabelValues.h"
#include "Text.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

namespace medialvoxel
{

std::optional<LabelValue>
ParseLabel(const std::string & text)
{
  const char * const end = text.data() + text.size();
  const auto isWhole = [end](const std::from_chars_result & read) { return read.ec == std::errc() && read.ptr == end; };
  std::uint64_t whole = 0;
  if (isWhole(std::from_chars(text.data(), end, whole)))
  {
    return LabelValue(whole);
  }
  std::int64_t negative = 0;
  return isWhole(std::from_chars(text.data(), end, negative)) ? std::optional<LabelValue>(negative) : std::nullopt;
}

std::optional<LabelSelection>
ParseLabelSelection(const std::string & text)
{
  if (ToLower(text) == "all")
  {
    return LabelSelection{ true, {}, {} };
  }
  LabelSelection     selection;
  std::istringstream stream(text + ",");
  for (std::string word; std::getline(stream, word, ',');)
  {
    const bool isNumber = word.find_first_not_of("-0123456789") == std::string::npos;
    if (!isNumber && !Trim(word).empty())
    {
      selection.names.push_back(word);
      continue;
    }
    const std::optional<LabelValue>   label = ParseLabel(word);
    const std::optional<std::int64_t> value = label ? ConvertLabel<std::int64_t>(*label) : std::nullopt;
    if (!value || *value == 0)
    {
      return std::nullopt;
    }
    selection.values.push_back(*value);
  }
  std::sort(selection.values.begin(), selection.values.end());
  selection.values.erase(std::unique(selection.values.begin(), selection.values.end()), selection.values.end());
  return selection;
}

std::string
FormatLabel(const LabelValue & label)
{
  const std::optional<std::int64_t> value = ConvertLabel<std::int64_t>(label);
  return value ? std::to_string(*value) : std::to_string(ConvertLabel<std::uint64_t>(label).value());
}

bool
ListsPlaces(const ExtractOptions & options)
{
  return options.thinBelow || options.thickAbove;
}

std::string
GetReportFile(const JobOptions & options)
{
  return options.reportFile == StandardOutput ? "" : options.reportFile;
}

itk::MedialVoxelGrid
GetGrid(const VolumeHeader & header)
{
  itk::MedialVoxelIndex             size{ { 1, 1, 1 } };
  itk::MedialVoxelGrid::SpacingType spacing{ { 1.0, 1.0, 1.0 } };
  for (unsigned int axis = 0; axis < header.geometry.GetDimension(); ++axis)
  {
    size[axis] = static_cast<std::int64_t>(header.geometry.size[axis]);
    spacing[axis] = header.geometry.spacing[axis];
  }
  return { size, spacing };
}

namespace
{

/** Whether a threshold cuts off values that a type has. */
bool
CutsOff(const std::optional<itk::MedialVoxelExactNumber> & threshold, const PixelType type, const bool isLower)
{
  return threshold && DispatchPixelType(type, [&](auto zero) {
           using Limits = std::numeric_limits<decltype(zero)>;
           return isLower ? threshold->IsAbove(Limits::lowest())
                          : itk::MedialVoxelExactNumber(Limits::max()).IsAbove(*threshold);
         });
}

} // namespace

bool
HasOneThreshold(const JobOptions & options, const VolumeHeader & header)
{
  const bool hasLower = options.lowerIsOtsu || CutsOff(options.lowerThreshold, header.GetValueType(), true);
  return hasLower != CutsOff(options.upperThreshold, header.GetValueType(), false);
}

ExtractOptions
GetThicknessOptions(const PartOptions & options)
{
  ExtractOptions extract;
  static_cast<JobOptions &>(extract) = options;
  extract.localThicknessFile = options.output;
  extract.localThicknessMethod = options.localThicknessMethod;
  extract.largestBall = options.largestBall;
  extract.subVoxel = options.subVoxel;
  extract.maximumPoreSize = options.maximumPoreSize;
  extract.smoothing = Smoothing::Off;
  return extract;
}

bool
MayMeasureOnGrayValues(const ExtractOptions & options, const VolumeHeader & header)
{
  return options.subVoxel.value_or(HasOneThreshold(options, header));
}

std::string
DescribeMeasureOnObject(const ExtractOptions & options, const VolumeHeader & header)
{
  if (options.labels || options.label)
  {
    return "objects are labels";
  }
  if (!options.subVoxel.value_or(true))
  {
    return "gray values are switched off";
  }
  return CutsOff(options.upperThreshold, header.GetValueType(), false) ? "the object is between two thresholds"
                                                                       : "no threshold cuts the values";
}

itk::MedialVoxelSheetExtraction::GrayRange
GetGrayRange(const JobOptions & options, const VolumeHeader & header)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool       hasLower = CutsOff(options.lowerThreshold, header.GetValueType(), true);
  const bool       hasUpper = CutsOff(options.upperThreshold, header.GetValueType(), false);
  return { hasLower ? options.lowerThreshold->GetNearestDouble() : -infinity,
           hasUpper ? options.upperThreshold->GetNearestDouble() : infinity };
}

Smoothing
GetRequestedSmoothing(const ExtractOptions & options)
{
  const bool isOff = options.thickness || options.labels;
  return options.smoothing.value_or(isOff ? Smoothing::Off : Smoothing::Automatic);
}

Smoothing
GetSmoothing(const ExtractOptions & options)
{
  const Smoothing smoothing = GetRequestedSmoothing(options);
  if (smoothing != Smoothing::Automatic || !options.roughness)
  {
    return smoothing;
  }
  return options.roughness->NeedsSmoothing() ? Smoothing::On : Smoothing::Off;
}

/** 0: the default. */
static double
GetMaximumThickness(const ExtractOptions & options)
{
  return options.maximumThickness.value_or(options.neededMaximum.value_or(0.0));
}

itk::MedialVoxelParameters::Limits
GetLimitsOfWalls(const ExtractOptions & options, const itk::MedialVoxelGrid & grid)
{
  return itk::MedialVoxelParameters::LimitsOfWalls(
    grid, options.minimumThickness.value_or(0.0), GetMaximumThickness(options));
}

std::optional<double>
GetDefaultMaximumThickness(const ExtractOptions & options, const itk::MedialVoxelGrid & grid)
{
  const bool isDefault = !options.thickness && !options.maximumThickness && !options.neededMaximum && !options.labels;
  return isDefault ? std::optional(GetLimitsOfWalls(options, grid).maximum) : std::nullopt;
}

itk::MedialVoxelParameters
GetParameters(const ExtractOptions & options, const itk::MedialVoxelGrid & grid)
{
  using Parameters = itk::MedialVoxelParameters;
  const Parameters::Limits limits = GetLimitsOfWalls(options, grid);
  if (!options.thickness && limits.minimum > limits.maximum)
  {
    Fail(ExitStatus::Usage,
         "minimum thickness ",
         FormatNumber(limits.minimum),
         " is greater than maximum thickness ",
         FormatNumber(limits.maximum),
         "; it must not be");
  }
  Parameters::Settings settings;
  settings.mode = options.thickness ? itk::MedialVoxelThicknessMode::Fixed : itk::MedialVoxelThicknessMode::Automatic;
  settings.thickness = options.thickness.value_or(settings.thickness);
  settings.minimumThickness = options.minimumThickness.value_or(0.0);
  settings.maximumThickness = GetMaximumThickness(options);
  settings.maximumPoreSize = options.maximumPoreSize;
  return Parameters::ForSettings(grid, settings);
}

itk::MedialVoxelLocalThickness
GetLocalThickness(const ExtractOptions & options, const itk::MedialVoxelGrid & grid)
{
  using Task = itk::MedialVoxelLocalThickness;
  const double maximum = options.largestBall.value_or(Task::GetDefaultMaximum(grid));
  const double largest = Task::GetLargestMaximum(grid);
  if (maximum > largest)
  {
    Fail(ExitStatus::Usage,
         "--largest-ball is ",
         FormatNumber(maximum),
         "; it must be at most ",
         FormatNumber(Task::MostVoxels),
         " voxels, ",
         FormatNumber(largest));
  }
  Task task;
  task.maximumThickness = maximum;
  const itk::MedialVoxelParameters parameters = GetParameters(options, grid);
  task.maximumPoreSize = parameters.maximumPoreSize;
  if (options.localThicknessMethod == LocalThicknessMethod::Wall)
  {
    task.walls.emplace();
    task.walls->parameters = parameters;
  }
  return task;
}

std::string
DescribeThickness(const ExtractOptions & options, const std::string & unit)
{
  return options.thickness ? FormatNumber(*options.thickness) + unit : AutomaticThickness;
}

std::string
GetName(itk::MedialVoxelBoundary boundary)
{
  return boundary == itk::MedialVoxelBoundary::Object ? "object" : "background";
}

std::string
GetName(Smoothing smoothing)
{
  switch (smoothing)
  {
    case Smoothing::Off:
      return "off";
    case Smoothing::On:
      return "on";
    case Smoothing::Automatic:
      return "auto";
  }
  return "unknown";
}

std::string
GetName(LocalThicknessMethod method)
{
  return method == LocalThicknessMethod::Wall ? "wall" : "sphere";
}

std::string
GetName(itk::MedialVoxelRegion region)
{
  switch (region)
  {
    case itk::MedialVoxelRegion::Inside:
      return "inside";
    case itk::MedialVoxelRegion::Outside:
      return "outside";
    case itk::MedialVoxelRegion::Both:
      return "both";
  }
  return "unknown";
}

} // end namespace medialvoxel
