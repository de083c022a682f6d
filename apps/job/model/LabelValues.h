// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelValues_h
#define medialvoxelLabelValues_h

#include "Options.h"

#include <cmath>
#include <limits>
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
    const auto value = static_cast<TValue>(label.magnitude);
    const bool isExact = value < std::ldexp(TValue{ 1 }, 64) && static_cast<std::uint64_t>(value) == label.magnitude;
    return isExact ? std::optional<TValue>(label.isNegative ? -value : value) : std::nullopt;
  }
  else
  {
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<TValue>::max());
    if (!label.isNegative)
    {
      return label.magnitude <= most ? std::optional<TValue>(static_cast<TValue>(label.magnitude)) : std::nullopt;
    }
    if (std::is_unsigned<TValue>::value || label.magnitude > most + 1)
    {
      return std::nullopt;
    }
    // Not the negative of the magnitude, which the type may lack.
    return static_cast<TValue>(-static_cast<std::int64_t>(label.magnitude - 1) - 1);
  }
}

} // end namespace medialvoxel

#endif
