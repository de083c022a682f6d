// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLocalThicknessSums.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace itk
{

namespace
{
constexpr double PartsOfMaximum = 1 << 21;
constexpr double HighSquare = 4294967296.0;
} // namespace

void
MedialVoxelLocalThicknessSums::Add(const std::vector<float> & thickness, const float maximum)
{
  assert(maximum > 0.0f);
  const double scale = PartsOfMaximum / static_cast<double>(maximum);
  for (const float value : thickness)
  {
    if (value > 0.0f)
    {
      const auto length = static_cast<std::uint64_t>(std::llround(static_cast<double>(value) * scale));
      ++voxels;
      lengths += length;
      lowSquares += (length * length) & 0xFFFFFFFFu;
      highSquares += (length * length) >> 32;
      largest = std::max(largest, value);
    }
  }
}

MedialVoxelLocalThicknessSums &
MedialVoxelLocalThicknessSums::operator+=(const MedialVoxelLocalThicknessSums & other)
{
  voxels += other.voxels;
  lengths += other.lengths;
  lowSquares += other.lowSquares;
  highSquares += other.highSquares;
  largest = std::max(largest, other.largest);
  return *this;
}

double
MedialVoxelLocalThicknessSums::GetMean(const float maximum) const
{
  return voxels == 0
           ? 0.0
           : static_cast<double>(lengths) / static_cast<double>(voxels) / PartsOfMaximum * static_cast<double>(maximum);
}

double
MedialVoxelLocalThicknessSums::GetStandardDeviation(const float maximum) const
{
  if (voxels == 0)
  {
    return 0.0;
  }
  const auto   number = static_cast<double>(voxels);
  const double mean = static_cast<double>(lengths) / number;
  const double squares = (static_cast<double>(highSquares) * HighSquare + static_cast<double>(lowSquares)) / number;
  return std::sqrt(std::max(0.0, squares - mean * mean)) / PartsOfMaximum * static_cast<double>(maximum);
}

} // end namespace itk
