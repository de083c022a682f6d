// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetSides_h
#define itkMedialVoxelSheetSides_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** A side of a triangle, between its lower and its higher point. */
struct MedialVoxelSheetSide
{
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;
};

inline bool
operator==(const MedialVoxelSheetSide & a, const MedialVoxelSheetSide & b)
{
  return a.low == b.low && a.high == b.high;
}

inline bool
operator<(const MedialVoxelSheetSide & a, const MedialVoxelSheetSide & b)
{
  return a.low != b.low ? a.low < b.low : a.high < b.high;
}

/** Those of all triangles, by their points, and by triangle. */
inline std::vector<MedialVoxelSheetSide>
MedialVoxelSortSides(const std::vector<std::array<std::uint32_t, 3>> & triangles)
{
  std::vector<MedialVoxelSheetSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle)
  {
    const auto & corners = triangles[triangle];
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
      sides.push_back({ low, high, triangle });
    }
  }
  std::sort(sides.begin(), sides.end(), [](const MedialVoxelSheetSide & a, const MedialVoxelSheetSide & b) {
    return a == b ? a.triangle < b.triangle : a < b;
  });
  return sides;
}

} // end namespace itk

#endif
