// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ColorRange.h"

#include <algorithm>

namespace medialvoxel
{

ColorRange
GetColorRange(const LengthHistogram & thickness)
{
  constexpr double binsPerHalfVoxel = 32.0;
  ColorRange       range{ thickness.GetPercentile(1.0), thickness.GetPercentile(99.0) };
  if (range.high <= range.low)
  {
    range.low = std::max(0.0, range.low - binsPerHalfVoxel * thickness.GetBinWidth());
    range.high += binsPerHalfVoxel * thickness.GetBinWidth();
  }
  return range;
}

} // end namespace medialvoxel
