// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectWarnings.h"

#include "JobResult.h"
#include "Options.h"
#include "Text.h"
#include "ValueStatistics.h"
#include "WarningRules.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace medialvoxel
{
namespace
{

/** Which values are object. */
std::string
DescribeObject(const JobOptions & options)
{
  const auto & lower = options.lowerThreshold;
  const auto & upper = options.upperThreshold;
  if (lower && upper)
  {
    return "from " + lower->Format() + " to " + upper->Format();
  }
  return lower ? "at least " + lower->Format() : (upper ? "at most " + upper->Format() : "other than 0");
}

/** Names the resampling; without it the warning would seem wrong for a coarse input. */
std::string
DescribeResampling(const VolumeHeader & input)
{
  return input.stored ? " when it is resampled to " + FormatSize(input.geometry.size) + " voxels" : "";
}

std::optional<WarningText>
CheckObject(const JobOptions & options, const JobResult & result)
{
  const itk::MedialVoxelCounts & counts = result.sums.counts;
  if (counts.objectVoxels > 0)
  {
    return std::nullopt;
  }
  if (counts.removedVoxels > 0)
  {
    return WarningText{ "no object is left: all its " + std::to_string(counts.removedVoxels) +
                          " voxels were small grains, taken for dust; a maximum pore size of 0 keeps them",
                        { { "removed_voxels", static_cast<double>(counts.removedVoxels) } } };
  }
  return WarningText{
    "the volume has no object" + DescribeResampling(result.input) + ": no value is " + DescribeObject(options), {}
  };
}

std::optional<WarningText>
CheckBackground(const JobOptions & options, const JobResult & result)
{
  const itk::MedialVoxelCounts & counts = result.sums.counts;
  if (counts.objectVoxels < result.input.geometry.GetNumberOfVoxels())
  {
    return std::nullopt;
  }
  if (counts.filledVoxels > 0)
  {
    return WarningText{ "no background is left: all its " + std::to_string(counts.filledVoxels) +
                          " voxels were small pores, taken for noise; a maximum pore size of 0 keeps them",
                        { { "filled_voxels", static_cast<double>(counts.filledVoxels) } } };
  }
  const bool isChosen = options.lowerThreshold || options.upperThreshold || options.label;
  return WarningText{ "the volume has no background" + DescribeResampling(result.input) +
                        ", so the object has no boundary: all values are " + DescribeObject(options) +
                        (isChosen ? "" : "; a scan of gray values needs a lower threshold"),
                      {} };
}

/** Objects that are there are not in a table of names. */
std::optional<WarningText>
CheckNames(const JobOptions &, const JobResult & result)
{
  if (result.objects.is_null() || result.segments.IsEmpty())
  {
    return std::nullopt;
  }
  std::vector<std::int64_t> unknown;
  for (const Json & object : result.objects["objects"])
  {
    if (result.segments.Find(object["label"]) == nullptr)
    {
      unknown.push_back(object["label"]);
    }
  }
  if (unknown.empty())
  {
    return std::nullopt;
  }
  return WarningText{ "of " + std::to_string(result.objects["objects"].size()) + " labels " +
                        std::to_string(unknown.size()) + " are of no segment, as is " +
                        std::to_string(unknown.front()) +
                        "; they have no name, and 3D Slicer does not show them in a segmentation",
                      { { "labels", static_cast<double>(unknown.size()) } } };
}

const std::vector<Rule<JobOptions, JobResult>> ObjectRules{ { "no_object", CheckObject, true },
                                                            { "no_background", CheckBackground, true },
                                                            { "labels_without_segment", CheckNames } };

/** Noise of a background is other than 0, too. */
std::optional<WarningText>
CheckFaint(const ValueStatistics & values)
{
  constexpr std::uint64_t mostOfMasks = 16; // different values
  constexpr double        much = 0.5;
  if (values.different <= mostOfMasks ||
      static_cast<double>(values.faint) < much * static_cast<double>(values.otherThanZero))
  {
    return std::nullopt;
  }
  const double share = static_cast<double>(values.otherThanZero) / static_cast<double>(values.values);
  const double faint = static_cast<double>(values.faint) / static_cast<double>(values.otherThanZero);
  return WarningText{
    "without a threshold all values other than 0 are object, " + FormatShare(share) + " of the slices in the middle; " +
      FormatShare(faint) + " of these are below " + FormatNumber(*values.otsu) +
      ", the threshold of Otsu; a scan of gray values needs --lower",
    { { "object_percent", 100.0 * share }, { "faint_percent", 100.0 * faint }, { "otsu", *values.otsu } }
  };
}

const std::vector<Rule<ValueStatistics>> ValueRules{ { "faint_object", CheckFaint } };

} // namespace

void
ApplyValueRules(std::vector<Warning> & warnings, const ValueStatistics & values)
{
  Apply(ValueRules, warnings, values);
}

void
ApplyObjectRules(std::vector<Warning> & warnings, const JobOptions & options, const JobResult & result)
{
  const itk::MedialVoxelCounts & counts = result.sums.counts;
  if (options.label && counts.objectVoxels == 0 && counts.removedVoxels == 0)
  {
    Fail(ExitStatus::Usage, result.input.fileName.string(), ": no voxel has the label ", FormatLabel(*options.label));
  }
  Apply<JobOptions, JobResult>(ObjectRules, warnings, options, result);
}

void
AddObjectCodes(std::vector<std::string> & codes)
{
  AddCodes(ValueRules, codes);
  AddCodes(ObjectRules, codes);
}

} // end namespace medialvoxel
