// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetPart.h"

#include "itkMedialVoxelRemesher.h"

#include <cassert>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Complex = MedialVoxelTriangleComplex;

/** Of the points that triangles have; shared ones come as they were. */
MedialVoxelCoarsenedPart
Collect(const MedialVoxelFineSheet & fine, const Complex & complex)
{
  MedialVoxelCoarsenedPart result;
  std::vector<Index>       numbers(complex.GetNumberOfVertices());
  for (Index vertex = 0; vertex < complex.GetNumberOfVertices(); ++vertex)
  {
    if (complex.GetTrianglesOf(vertex).empty())
    {
      continue;
    }
    numbers[vertex] = static_cast<Index>(result.sheet.points.size());
    result.sheet.points.push_back(complex.GetPoint(vertex));
    result.isShared.push_back(complex.IsShared(vertex));
    if (complex.IsShared(vertex))
    {
      result.finePoint.push_back(vertex);
      result.sheet.thickness.push_back(fine.GetSheet().thickness[vertex]);
      continue;
    }
    const Index wall = complex.GetWall(complex.GetTrianglesOf(vertex).front());
    const auto  nearest = fine.FindOnWall(complex.GetPoint(vertex), wall);
    result.finePoint.push_back(fine.GetNearestPoint(nearest.triangle, nearest.point));
    result.sheet.thickness.push_back(static_cast<float>(fine.GetThickness(nearest.triangle, nearest.point)));
  }
  for (Index triangle = 0; triangle < complex.GetNumberOfTriangles(); ++triangle)
  {
    if (complex.IsTriangle(triangle))
    {
      const auto & corners = complex.GetTriangle(triangle);
      result.sheet.triangles.push_back({ { numbers[corners[0]], numbers[corners[1]], numbers[corners[2]] } });
    }
  }
  return result;
}

} // namespace

MedialVoxelCoarsenedPart
MedialVoxelCoarsenPart(MedialVoxelSheet                    part,
                       std::vector<bool>                   isShared,
                       const MedialVoxelElementSize &      size,
                       const double                        most,
                       const std::function<void(double)> & progress)
{
  assert(most >= 0.0 && part.thickness.size() == part.points.size());
  if (part.triangles.empty())
  {
    return {};
  }
  MedialVoxelFineSheet fine(std::move(part), std::move(isShared));
  fine.SetSizes(size.least, size.atThickness, size.shareOfThickness);
  MedialVoxelRemesher remesher(fine, size.GetNoise(fine.GetMeanSide()), progress);
  if (most > 0.0)
  {
    remesher.Coarsen(most);
  }
  return Collect(fine, remesher.GetComplex());
}

} // end namespace itk
