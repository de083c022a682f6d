// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelComplexDivision.h"

#include <algorithm>
#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

/** Appends the parts of a range of triangles. */
void
Divide(const std::vector<MedialVoxelVector3> & centers,
       const std::vector<Index>::iterator      begin,
       const std::vector<Index>::iterator      end,
       const std::size_t                       most,
       std::vector<std::vector<Index>> &       parts)
{
  const auto count = static_cast<std::size_t>(end - begin);
  if (count <= most)
  {
    parts.emplace_back(begin, end);
    std::sort(parts.back().begin(), parts.back().end());
    return;
  }
  unsigned int longest = 0;
  double       extent = -1.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax_element(
      begin, end, [&](const Index a, const Index b) { return centers[a][axis] < centers[b][axis]; });
    const double length = centers[*high][axis] - centers[*low][axis];
    longest = length > extent ? axis : longest;
    extent = std::max(extent, length);
  }
  const auto middle = begin + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(begin, middle, end, [&](const Index a, const Index b) {
    return centers[a][longest] != centers[b][longest] ? centers[a][longest] < centers[b][longest] : a < b;
  });
  Divide(centers, begin, middle, most, parts);
  Divide(centers, middle, end, most, parts);
}

} // namespace

MedialVoxelSheetDivision
MedialVoxelDivideSheet(const MedialVoxelSheet & sheet, const std::size_t most)
{
  std::vector<MedialVoxelVector3> centers;
  for (const auto & corners : sheet.triangles)
  {
    MedialVoxelVector3 sum{};
    for (const Index corner : corners)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += sheet.points[corner][axis];
      }
    }
    centers.push_back(sum);
  }
  std::vector<Index> order(sheet.triangles.size());
  std::iota(order.begin(), order.end(), Index{ 0 });
  MedialVoxelSheetDivision division;
  Divide(centers, order.begin(), order.end(), most, division.parts);

  constexpr Index    none = ~Index{ 0 };
  std::vector<Index> partOf(sheet.points.size(), none);
  division.isShared.resize(sheet.points.size());
  for (Index part = 0; part < division.parts.size(); ++part)
  {
    for (const Index triangle : division.parts[part])
    {
      for (const Index corner : sheet.triangles[triangle])
      {
        division.isShared[corner] = division.isShared[corner] || (partOf[corner] != none && partOf[corner] != part);
        partOf[corner] = part;
      }
    }
  }
  return division;
}

void
MedialVoxelRunInOrder(const std::size_t count, const MedialVoxelTask & task)
{
  for (std::size_t number = 0; number < count; ++number)
  {
    task(number, [] {});
  }
}

} // end namespace itk
