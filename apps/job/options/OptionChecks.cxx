// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionChecks.h"

#include "MeshFormat.h"
#include "Outputs.h"
#include "OptionTable.h"
#include "Text.h"

#include "itkMedialVoxelGridLimits.h"

#include <limits>

namespace medialvoxel
{
namespace
{

/** Each value is one that its option takes. */
template <typename TOptions>
void
CheckRanges(TOptions options)
{
  const OptionTarget target = MakeTarget(options);
  for (const OptionRow & row : ListOptions())
  {
    const std::optional<std::string> text = row.name.empty() ? std::nullopt : row.value.get(target);
    try
    {
      text ? row.value.set(target, *text) : void();
    }
    catch (const WrongValue & error)
    {
      Fail(ExitStatus::Usage, row.name, ": ", error.what());
    }
  }
}

void
CheckJobOptions(const JobOptions & options)
{
  if (options.raw)
  {
    CheckOptions(*options.raw);
  }
  const std::vector<std::uint64_t> & range = options.slices.range;
  if (range.size() == 2 && range[0] > range[1])
  {
    Fail(ExitStatus::Usage, "--slices is ", range[0], "-", range[1], "; its last slice must not be before its first");
  }
  if (options.label && (options.lowerThreshold || options.upperThreshold || options.lowerIsOtsu))
  {
    Fail(ExitStatus::Usage,
         "the label ",
         FormatLabel(*options.label),
         " and a threshold are given; either one value or a range of values is the object");
  }
  if (options.lowerThreshold && options.upperThreshold && options.lowerThreshold->IsAbove(*options.upperThreshold))
  {
    Fail(ExitStatus::Usage,
         "lower threshold ",
         options.lowerThreshold->Format(),
         " is greater than upper threshold ",
         options.upperThreshold->Format(),
         "; it must not be");
  }
}

/** Objects of a label map have no other description, and not all outputs. */
void
CheckLabelOptions(const ExtractOptions & options)
{
  struct Other
  {
    const char * name;
    bool         isGiven;
    const char * remedy;
  };
  constexpr const char * oneOfThem = "they do not go together";
  constexpr const char * oneObject = "they are of one object: take --label, a run for each object";
  const Other            others[] = {
    { "a label", options.label.has_value(), oneOfThem },
    { "a threshold", options.lowerThreshold || options.upperThreshold || options.lowerIsOtsu, oneOfThem },
    { "sub-voxel measures", options.subVoxel.value_or(false), "these need gray values and a threshold" },
    { "smoothing", options.smoothing.value_or(Smoothing::Off) != Smoothing::Off, oneObject },
    { "vectors", !options.vectorFile.empty(), oneObject },
    { "distances", !options.distanceFile.empty(), oneObject },
    { "an importance", FindsImportance(options), oneObject },
    { "walls", NumbersWalls(options), oneObject },
    { "a local thickness", !options.localThicknessFile.empty(), oneObject },
    { "thin or thick places", ListsPlaces(options), oneObject },
  };
  for (const Other & other : others)
  {
    if (other.isGiven)
    {
      Fail(ExitStatus::Usage, "the labels of several objects and ", other.name, " are asked for; ", other.remedy);
    }
  }
}

void
CheckLevels(const ExtractOptions & options)
{
  constexpr double  infinity = std::numeric_limits<double>::infinity();
  const bool        waitsForOtsu = options.lowerIsOtsu && !options.lowerThreshold;
  const std::string problem =
    options.materials && !waitsForOtsu
      ? options.materials->FindProblem(options.lowerThreshold ? options.lowerThreshold->GetNearestDouble() : -infinity,
                                       options.upperThreshold ? options.upperThreshold->GetNearestDouble() : infinity)
      : "";
  if (!problem.empty())
  {
    Fail(ExitStatus::Usage, "--materials: ", problem);
  }
}

void
CheckMeasure(const ExtractOptions & options)
{
  const bool isOff = options.subVoxel && !*options.subVoxel;
  const bool hasThreshold = options.lowerThreshold || options.upperThreshold || options.lowerIsOtsu;
  if (options.subVoxel.value_or(false) && !hasThreshold)
  {
    Fail(ExitStatus::Usage, "sub-voxel measures need a threshold; none is given");
  }
  const bool         needsFit = options.materials || !options.uncertaintyFile.empty();
  const char * const what = options.materials ? "levels of gray values" : "the uncertainty of the thickness";
  if (needsFit && isOff)
  {
    Fail(ExitStatus::Usage, what, " and no sub-voxel measures are asked for; they do not go together");
  }
  if (needsFit && !hasThreshold)
  {
    Fail(ExitStatus::Usage, what, " needs a threshold; none is given");
  }
  CheckLevels(options);
}

void
CheckPlaceOptions(const ExtractOptions & options)
{
  if (options.failsIfThin && !options.thinBelow)
  {
    Fail(ExitStatus::Usage, "a failure for thin places needs the thickness of thin places; none is given");
  }
  if (!options.placesFile.empty() && !ListsPlaces(options))
  {
    Fail(ExitStatus::Usage, options.placesFile, ": a list of places needs the thickness of thin or thick places");
  }
}

} // namespace

void
CheckOptions(const RawDescription & raw)
{
  const size_t dimension = raw.size.size();
  if (dimension < 2 || dimension > 3)
  {
    Fail(ExitStatus::Usage, "--raw-size has ", dimension, " values; it must have 2 or 3");
  }
  std::uint64_t voxels = 1;
  for (const std::uint64_t size : raw.size)
  {
    if (size == 0 || size > itk::MedialVoxelGridLimits::MostVoxels / voxels)
    {
      Fail(ExitStatus::Usage,
           "--raw-size is ",
           FormatSize(raw.size),
           "; each size must be 1 or more, and their product less than 2^59");
    }
    voxels *= size;
  }
}

void
CheckOptions(const JobOptions & options)
{
  CheckRanges(options);
  CheckJobOptions(options);
}

void
CheckOptions(const ExtractOptions & options)
{
  CheckRanges(options);
  CheckJobOptions(options);
  if (options.sameTopology && options.output.empty())
  {
    Fail(ExitStatus::Usage, "the same topology is one of labels; give OUTPUT for them");
  }
  if (options.largestBall && options.localThicknessFile.empty())
  {
    Fail(ExitStatus::Usage, "the largest ball needs a local thickness; none is asked for");
  }
  if (options.extendsRims && options.elementSize.kind == ElementSize::Kind::Voxel)
  {
    Fail(ExitStatus::Usage, "rims of faces of one voxel are not extended; give an element size, such as auto");
  }
  if (options.meshWalls && !options.meshFile.empty() && !HoldsWalls(GetMeshFormat(options.meshFile)))
  {
    Fail(ExitStatus::Usage,
         "walls of faces need a mesh that is written as ",
         Join(ListWallExtensions(), " ", [](const std::string & extension) { return extension; }));
  }
  if (options.labels)
  {
    CheckLabelOptions(options);
  }
  CheckMeasure(options);
  CheckPlaceOptions(options);
}

void
CheckOptions(const PartOptions & options)
{
  CheckOptions(GetThicknessOptions(options));
}

void
CheckOptions(const DistanceOptions & options)
{
  CheckRanges(options);
  CheckJobOptions(options);
}

} // end namespace medialvoxel
