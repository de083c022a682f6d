// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Options.h"

#include "Text.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

void
CheckThreshold(const char * name, const std::optional<double> & threshold)
{
  if (threshold && std::isnan(*threshold))
  {
    Fail(ExitStatus::Usage, name, " threshold is nan; it must be a number");
  }
}

void
CheckPositive(const char * name, double value, bool mayBeInfinite)
{
  if (!(value > 0) || (!mayBeInfinite && std::isinf(value)))
  {
    Fail(ExitStatus::Usage,
         name,
         " is ",
         FormatNumber(value),
         "; it must be ",
         mayBeInfinite ? "greater than 0" : "a finite number greater than 0");
  }
}

void
CheckJobOptions(const JobOptions & options)
{
  if (options.raw)
  {
    CheckOptions(*options.raw);
  }
  CheckThreshold("lower", options.lowerThreshold);
  CheckThreshold("upper", options.upperThreshold);
  if (options.lowerThreshold && options.upperThreshold && *options.lowerThreshold > *options.upperThreshold)
  {
    Fail(ExitStatus::Usage,
         "lower threshold ",
         FormatNumber(*options.lowerThreshold),
         " is greater than upper threshold ",
         FormatNumber(*options.upperThreshold),
         "; it must not be");
  }
  if (options.threads && *options.threads == 0)
  {
    Fail(ExitStatus::Usage, "the number of threads is 0; it must be 1 or more");
  }
  if (options.divisions && *options.divisions == 0)
  {
    Fail(ExitStatus::Usage, "the number of divisions is 0; it must be 1 or more");
  }
}

} // namespace

void
CheckOptions(const RawDescription & raw)
{
  const size_t dimension = raw.size.size();
  if (dimension < 2 || dimension > 3)
  {
    Fail(ExitStatus::Usage, "the raw size has ", dimension, " values; it must have 2 or 3");
  }
  std::uint64_t voxels = 1;
  for (const std::uint64_t size : raw.size)
  {
    constexpr std::uint64_t maximumVoxels = std::uint64_t{ 1 } << 59;
    if (size == 0 || size > maximumVoxels / voxels)
    {
      Fail(ExitStatus::Usage,
           "the raw size is ",
           FormatSize(raw.size),
           "; each size must be 1 or more, and their product less than 2^59");
    }
    voxels *= size;
  }
  if (!raw.spacing.empty() && raw.spacing.size() != dimension)
  {
    Fail(ExitStatus::Usage, "the raw spacing has ", raw.spacing.size(), " values; the raw size has ", dimension);
  }
  for (const double spacing : raw.spacing)
  {
    CheckPositive("the raw spacing", spacing, false);
  }
}

void
CheckOptions(const ExtractOptions & options)
{
  CheckJobOptions(options);
  if (options.thickness)
  {
    CheckPositive("thickness", *options.thickness, false);
    if (options.minimumThickness || options.maximumThickness)
    {
      Fail(ExitStatus::Usage,
           "the thickness is ",
           FormatNumber(*options.thickness),
           "; minimum and maximum thickness need the thickness ",
           AutomaticThickness);
    }
  }
  if (options.minimumThickness)
  {
    CheckPositive("minimum thickness", *options.minimumThickness, false);
  }
  if (options.maximumThickness)
  {
    CheckPositive("maximum thickness", *options.maximumThickness, false);
  }
  if (options.sectionWidth)
  {
    CheckPositive("the width of sections", *options.sectionWidth, false);
  }
  if (options.subVoxel && !options.lowerThreshold && !options.upperThreshold)
  {
    Fail(ExitStatus::Usage, "the sub-voxel thickness is measured at a threshold; none is given");
  }
}

itk::MedialVoxelParameters
GetParameters(const ExtractOptions & options, const itk::MedialVoxelGrid & grid)
{
  using Parameters = itk::MedialVoxelParameters;
  const Parameters::Limits limits =
    Parameters::LimitsOfWalls(grid, options.minimumThickness.value_or(0.0), options.maximumThickness.value_or(0.0));
  if (!options.thickness && limits.minimum > limits.maximum)
  {
    Fail(ExitStatus::Usage,
         "minimum thickness ",
         FormatNumber(limits.minimum),
         " is greater than maximum thickness ",
         FormatNumber(limits.maximum),
         "; it must not be");
  }
  Parameters parameters = options.thickness ? Parameters::ForThickness(*options.thickness, options.bound)
                                            : Parameters::ForWalls(limits.minimum, limits.maximum, options.bound);
  parameters.maximumPoreSize =
    options.maximumPoreSize.value_or(options.thickness ? 0 : Parameters::AutomaticMaximumPoreSize);
  return parameters;
}

std::string
DescribeThickness(const ExtractOptions & options, const std::string & unit)
{
  return options.thickness ? FormatNumber(*options.thickness) + unit : AutomaticThickness;
}

void
CheckOptions(const DistanceOptions & options)
{
  CheckJobOptions(options);
  if (options.maximumDistance)
  {
    CheckPositive("maximum distance", *options.maximumDistance, true);
  }
  if (options.distanceFile.empty() && (options.squaredDistance || options.insideIsPositive))
  {
    Fail(ExitStatus::Usage, "squared and inside-positive distances need a distance file to be written to");
  }
}

std::string
GetName(itk::MedialVoxelPseudoGeodesicBound bound)
{
  switch (bound)
  {
    case itk::MedialVoxelPseudoGeodesicBound::FreeSpace:
      return "free-space";
    case itk::MedialVoxelPseudoGeodesicBound::Paper:
      return "paper";
    case itk::MedialVoxelPseudoGeodesicBound::Off:
      return "off";
  }
  return "unknown";
}

std::string
GetName(itk::MedialVoxelBoundary boundary)
{
  return boundary == itk::MedialVoxelBoundary::Object ? "object" : "background";
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
