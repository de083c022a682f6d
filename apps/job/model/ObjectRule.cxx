// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectRule.h"

#include "Errors.h"
#include "LabelValues.h"

namespace medialvoxel
{

void
CheckLabel(const JobOptions & options, const VolumeHeader & header)
{
  if (!options.label)
  {
    return;
  }
  const PixelType type = header.GetStored().GetValueType();
  const bool      isPossible =
    DispatchPixelType(type, [&options](auto zero) { return ConvertLabel<decltype(zero)>(*options.label).has_value(); });
  if (!isPossible)
  {
    Fail(ExitStatus::Usage,
         header.fileName.string(),
         ": the label ",
         FormatLabel(*options.label),
         " is not a value of its type, ",
         GetTraits(type).name);
  }
  if (header.stored && !ConvertLabel<double>(*options.label))
  {
    Fail(ExitStatus::Usage,
         header.fileName.string(),
         ": the label ",
         FormatLabel(*options.label),
         " is lost by --resample, whose values are float64; give a label that float64 holds, or leave out --resample");
  }
}

itk::MedialVoxelObjectRule
GetObjectRule(const JobOptions & options)
{
  itk::MedialVoxelObjectRule rule;
  if (!options.label && !options.lowerThreshold && !options.upperThreshold)
  {
    rule.background = 0;
  }
  rule.lower = options.label ? *options.label : options.lowerThreshold.value_or(rule.lower);
  rule.upper = options.label ? *options.label : options.upperThreshold.value_or(rule.upper);
  return rule;
}

} // end namespace medialvoxel
