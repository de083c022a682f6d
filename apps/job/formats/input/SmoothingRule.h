// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSmoothingRule_h
#define medialvoxelSmoothingRule_h

#include "ObjectValues.h"

#include "itkMedialVoxelSmoothing.h"

#include <limits>

namespace medialvoxel
{

/** Calls function(rule) with what is smoothed. */
template <typename TValue, typename TFunction>
void
WithSmoothingRule(const JobOptions & options, TFunction && function)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  itk::MedialVoxelWithSmoothingRule(MakeObjectPredicate<TValue>(options),
                                    options.lowerThreshold.value_or(-infinity),
                                    options.upperThreshold.value_or(infinity),
                                    function);
}

} // end namespace medialvoxel

#endif
