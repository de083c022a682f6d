// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectValues_h
#define medialvoxelObjectValues_h

#include "LabelValues.h"
#include "Options.h"

#include "itkMedialVoxelObjectPredicate.h"

#include <limits>

namespace medialvoxel
{

/** Which values the options make object: a label, those between thresholds, or all but 0. CheckLabel() has seen that
 * the type has the label. */
template <typename TValue>
itk::MedialVoxelObjectPredicate<TValue>
MakeObjectPredicate(const JobOptions & options)
{
  using PredicateType = itk::MedialVoxelObjectPredicate<TValue>;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (options.label)
  {
    return PredicateType::EqualTo(*ConvertLabel<TValue>(*options.label));
  }
  if (!options.lowerThreshold && !options.upperThreshold)
  {
    return PredicateType::DifferentFrom(TValue{});
  }
  return PredicateType::InRange(options.lowerThreshold.value_or(-infinity), options.upperThreshold.value_or(infinity));
}

} // end namespace medialvoxel

#endif
