// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelComplexDivision.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Index = MedialVoxelTriangleComplex::Index;

/** Appends the parts of a range of triangles. */
void
Divide(const std::vector<MedialVoxelVector3> & centers,
       const std::vector<Index>::iterator      begin,
       const std::vector<Index>::iterator      end,
       const std::size_t                       most,
       const double                            share,
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
  const auto low = static_cast<std::ptrdiff_t>(share * static_cast<double>(count));
  const auto middle = begin + std::max<std::ptrdiff_t>(1, low);
  std::nth_element(begin, middle, end, [&](const Index a, const Index b) {
    return centers[a][longest] != centers[b][longest] ? centers[a][longest] < centers[b][longest] : a < b;
  });
  Divide(centers, begin, middle, most, share, parts);
  Divide(centers, middle, end, most, share, parts);
}

} // namespace

std::vector<std::vector<Index>>
MedialVoxelDividePlaces(const std::vector<MedialVoxelVector3> & places,
                        std::vector<Index>                      numbers,
                        const std::size_t                       most,
                        const double                            share)
{
  assert(most > 0 && share > 0.0 && share < 1.0);
  std::vector<std::vector<Index>> parts;
  Divide(places, numbers.begin(), numbers.end(), most, share, parts);
  return parts;
}

MedialVoxelComplexDivision
MedialVoxelDivideComplex(const MedialVoxelTriangleComplex & complex, const std::size_t most, const double share)
{
  std::vector<MedialVoxelVector3> centers(complex.GetNumberOfTriangles());
  std::vector<Index>              order;
  for (Index triangle = 0; triangle < complex.GetNumberOfTriangles(); ++triangle)
  {
    if (complex.IsTriangle(triangle))
    {
      order.push_back(triangle);
      for (const MedialVoxelVector3 & corner : complex.GetCorners(triangle))
      {
        std::transform(
          corner.begin(), corner.end(), centers[triangle].begin(), centers[triangle].begin(), std::plus<double>());
      }
    }
  }
  MedialVoxelComplexDivision division;
  division.parts = MedialVoxelDividePlaces(centers, std::move(order), most, share);

  constexpr Index    none = MedialVoxelTriangleComplex::None;
  std::vector<Index> partOf(complex.GetNumberOfVertices(), none);
  division.isShared.resize(partOf.size());
  for (Index part = 0; part < division.parts.size(); ++part)
  {
    for (const Index triangle : division.parts[part])
    {
      for (const Index corner : complex.GetTriangle(triangle))
      {
        division.isShared[corner] = division.isShared[corner] || (partOf[corner] != none && partOf[corner] != part);
        partOf[corner] = part;
      }
    }
  }
  return division;
}

} // end namespace itk
