// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGridLimits.h"

#include "itkMedialVoxelElementary.h"
#include "itkMedialVoxelText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace itk
{

using MedialVoxelText::FormatNumber;

namespace
{

std::string
Describe(const std::string & what, const std::string & value, const std::string & rule)
{
  return what + " is " + value + "; it must " + rule;
}

std::string
AlongAxis(const char * what, const std::size_t axis)
{
  return std::string("its ") + what + " along axis " + std::to_string(axis);
}

struct SpacingRange
{
  double smallest{ std::numeric_limits<double>::infinity() };
  double largest{ 0.0 };

  double
  Ratio() const
  {
    return largest > 0.0 ? largest / smallest : 1.0;
  }
};

/** Of the axes longer than 1. */
template <typename TSizes, typename TSpacings>
SpacingRange
RangeOf(const TSizes & size, const TSpacings & spacing)
{
  SpacingRange range;
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    if (size[axis] > 1)
    {
      range.smallest = std::min(range.smallest, spacing[axis]);
      range.largest = std::max(range.largest, spacing[axis]);
    }
  }
  return range;
}

std::string
FindProblemOfSize(const std::vector<std::uint64_t> & size)
{
  std::uint64_t voxels = 1;
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    if (size[axis] > MedialVoxelGridLimits::LargestSize)
    {
      return Describe(AlongAxis("size", axis),
                      std::to_string(size[axis]),
                      "not exceed " + std::to_string(MedialVoxelGridLimits::LargestSize));
    }
    if (size[axis] > MedialVoxelGridLimits::MostVoxels / voxels)
    {
      return "it has more than 2^59 voxels; it must not";
    }
    voxels *= std::max<std::uint64_t>(1, size[axis]);
  }
  return {};
}

} // namespace

std::string
MedialVoxelGridLimits::FindProblem(const std::vector<std::uint64_t> & size,
                                   const std::vector<double> &        spacing,
                                   const std::vector<double> &        origin)
{
  if (const std::string problem = FindProblemOfSize(size); !problem.empty())
  {
    return problem;
  }
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    // Written so that NaN is out of range.
    if (!(spacing[axis] >= SmallestSpacing && spacing[axis] <= LargestSpacing))
    {
      return Describe(AlongAxis("spacing", axis),
                      FormatNumber(spacing[axis]),
                      "be a number from " + FormatNumber(SmallestSpacing) + " to " + FormatNumber(LargestSpacing));
    }
    const double extent = static_cast<double>(size[axis]) * spacing[axis];
    if (extent > LargestLength)
    {
      return Describe(AlongAxis("extent", axis), FormatNumber(extent), "not exceed " + FormatNumber(LargestLength));
    }
    if (!(std::abs(origin[axis]) <= LargestLength))
    {
      return Describe(AlongAxis("origin", axis),
                      FormatNumber(origin[axis]),
                      "be a number from " + FormatNumber(-LargestLength) + " to " + FormatNumber(LargestLength));
    }
  }
  const SpacingRange range = RangeOf(size, spacing);
  if (range.Ratio() > LargestRatio)
  {
    return Describe("the ratio of its largest spacing to its smallest", FormatNumber(range.Ratio()), "not exceed ") +
           FormatNumber(LargestRatio);
  }
  return {};
}

std::string
MedialVoxelGridLimits::FindShear(const std::vector<std::vector<double>> & axes)
{
  constexpr double degreesPerRadian = 57.29577951308232;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
  {
    for (std::size_t other = axis + 1; other < axes.size(); ++other)
    {
      const double cosine = std::inner_product(axes[axis].begin(), axes[axis].end(), axes[other].begin(), 0.0);
      if (!(std::abs(cosine) <= LargestShear))
      {
        const double degrees = MedialVoxelElementary::ArcCosine(cosine) * degreesPerRadian;
        return std::string("its axes ") + "xyz"[axis] + " and " + "xyz"[other] + " are at " +
               FormatNumber(std::round(100.0 * degrees) / 100.0) +
               " degrees to each other; they must be at 90, within 0.57 degrees";
      }
    }
  }
  return {};
}

double
MedialVoxelGridLimits::RatioOf(const MedialVoxelGrid & grid)
{
  return RangeOf(grid.GetSize(), grid.GetSpacing()).Ratio();
}

std::string
MedialVoxelGridLimits::FindInaccuracy(const MedialVoxelGrid & grid)
{
  const double ratio = RatioOf(grid);
  return ratio > AccurateRatio ? "the largest spacing is " + FormatNumber(std::round(10.0 * ratio) / 10.0) +
                                   " times the smallest; beyond " + FormatNumber(AccurateRatio) +
                                   " times sheets have holes and thickness is wrong"
                               : "";
}

double
MedialVoxelGridLimits::LeastThickness(const MedialVoxelGrid & grid)
{
  return RatioOf(grid) > AccurateRatio ? RangeOf(grid.GetSize(), grid.GetSpacing()).largest : 0.0;
}

} // end namespace itk
