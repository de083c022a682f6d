// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelValues_h
#define medialvoxelLabelValues_h

#include "Options.h"

#include <optional>
#include <type_traits>

namespace medialvoxel
{

/** The label as a value of a type; nothing when the type does not have it exactly. */
template <typename TValue>
std::optional<TValue>
ConvertLabel(const LabelValue & label)
{
  if constexpr (std::is_floating_point<TValue>::value)
  {
    const auto value = static_cast<TValue>(label.GetNearestDouble());
    const bool isExact = label == LabelValue(static_cast<double>(value));
    return isExact ? std::optional<TValue>(value) : std::nullopt;
  }
  else
  {
    const std::optional<TValue> first = label.GetFirstValue<TValue>();
    return first == label.GetLastValue<TValue>() ? first : std::nullopt;
  }
}

} // end namespace medialvoxel

#endif
