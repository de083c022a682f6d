// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PreviewLayout.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

constexpr double       LongestSide = 1600.0;
constexpr double       LargestVoxel = 8.0;            // pixels
constexpr unsigned int LeastWidth = 79 * TextAdvance; // of either legend with the longest text of a scale bar

/** Slices across z and y below each other at the left, the projection and the slice across x at the right. */
PreviewLayout
Arrange(const std::vector<unsigned int> & sizes)
{
  const unsigned int top = PreviewGap + PreviewCaptionHeight;
  PreviewLayout      layout;
  layout.areas.push_back({ PreviewGap, top, sizes[0], sizes[1] });
  if (sizes.size() == 3)
  {
    const unsigned int right = PreviewGap + sizes[0] + PreviewGap;
    const unsigned int below = top + sizes[1] + PreviewGap + PreviewCaptionHeight;
    layout.areas.push_back({ PreviewGap, below, sizes[0], sizes[2] });
    layout.areas.push_back({ right, below, sizes[1], sizes[2] });
    layout.areas.push_back({ right, top, sizes[0], sizes[1] });
  }
  for (const Rectangle & area : layout.areas)
  {
    layout.width = std::max(layout.width, area.x + area.width + PreviewGap);
    layout.height = std::max(layout.height, area.y + area.height + PreviewGap);
  }
  layout.width = std::max(layout.width, LeastWidth + 2 * PreviewGap);
  layout.height += TextHeight + PreviewGap;
  return layout;
}

} // namespace

PreviewLayout
ArrangePreview(const VolumeGeometry & geometry)
{
  const double smallest = *std::min_element(geometry.spacing.begin(), geometry.spacing.end());
  const auto   arrange = [&](double pixelsPerVoxel) {
    std::vector<unsigned int> sizes;
    for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
    {
      const double voxels = static_cast<double>(geometry.size[axis]) * geometry.spacing[axis] / smallest;
      sizes.push_back(static_cast<unsigned int>(std::clamp(std::round(voxels * pixelsPerVoxel), 1.0, LongestSide)));
    }
    PreviewLayout layout = Arrange(sizes);
    layout.pixelsPerUnit = pixelsPerVoxel / smallest;
    return layout;
  };
  // Whole pixels per voxel where they fit.
  for (double pixelsPerVoxel = LargestVoxel; pixelsPerVoxel >= 1.0; pixelsPerVoxel -= 1.0)
  {
    const PreviewLayout layout = arrange(pixelsPerVoxel);
    if (std::max(layout.width, layout.height) <= LongestSide)
    {
      return layout;
    }
  }
  double longest = 0.0;
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    longest = std::max(longest, static_cast<double>(geometry.size[axis]) * geometry.spacing[axis] / smallest);
  }
  // Two views lie beside, or below, each other at most.
  return arrange(std::min(1.0, 0.5 * LongestSide / longest));
}

std::array<std::uint64_t, 2>
GetCoveredVoxels(unsigned int pixel, unsigned int numberOfPixels, std::uint64_t numberOfVoxels)
{
  const double scale = static_cast<double>(numberOfVoxels) / numberOfPixels;
  if (scale <= 1.0)
  {
    const auto middle = static_cast<std::uint64_t>((pixel + 0.5) * scale);
    return { middle, middle + 1 };
  }
  const auto first = static_cast<std::uint64_t>(pixel * scale);
  const auto end = static_cast<std::uint64_t>((pixel + 1) * scale);
  return { first, std::min(std::max(end, first + 1), numberOfVoxels) };
}

} // end namespace medialvoxel
