// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSmoothingRule_h
#define medialvoxelSmoothingRule_h

#include "ObjectValues.h"

#include "itkMedialVoxelSmoothing.h"

#include <cmath>

namespace medialvoxel
{

/** Calls function(rule) with what is smoothed: the values when there is one threshold, otherwise the mask. */
template <typename TValue, typename TFunction>
void
WithSmoothingRule(const JobOptions & options, TFunction && function)
{
  using ValueRule = itk::MedialVoxelValueSmoothing<TValue>;
  const auto isLimit = [](const std::optional<itk::MedialVoxelLimit> & limit) {
    return limit && std::isfinite(limit->GetNearestDouble());
  };
  const bool hasLower = isLimit(options.lowerThreshold);
  const bool hasUpper = isLimit(options.upperThreshold);
  if (hasLower && !hasUpper)
  {
    function(ValueRule::FromLower(*options.lowerThreshold));
  }
  else if (hasUpper && !hasLower)
  {
    function(ValueRule::FromUpper(*options.upperThreshold));
  }
  else
  {
    function(itk::MedialVoxelMaskSmoothing<TValue>(MakeObjectPredicate<TValue>(options)));
  }
}

} // end namespace medialvoxel

#endif
