// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetPart.h"

#include "itkMedialVoxelSheetDecimation.h"
#include "itkMedialVoxelSheetSizes.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Complex = MedialVoxelTriangleComplex;

/** Of the points that triangles have. */
MedialVoxelCoarsenedPart
Collect(const MedialVoxelSheet & fine, const Complex & complex)
{
  MedialVoxelCoarsenedPart result;
  std::vector<Index>       numbers(complex.GetNumberOfVertices());
  for (Index vertex = 0; vertex < complex.GetNumberOfVertices(); ++vertex)
  {
    if (!complex.GetTrianglesOf(vertex).empty())
    {
      numbers[vertex] = static_cast<Index>(result.sheet.points.size());
      result.sheet.points.push_back(complex.GetPoint(vertex));
      result.sheet.thickness.push_back(fine.thickness[vertex]);
      result.finePoint.push_back(vertex);
    }
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

/** Of the size: sides of the coarse sheet, about as long as what rims are extended by. */
constexpr double ShareOfCoarse = 0.4;

/** So many fine sides are sides of the coarse sheet at least, where elements are that large. */
constexpr double FineSidesOfCoarse = 2.0;

} // namespace

MedialVoxelElementSize
MedialVoxelElementSize::MakeCoarse(const double meanSide) const
{
  MedialVoxelElementSize coarse = *this;
  coarse.least = std::max(ShareOfCoarse * least, std::min(least, 2.0 * FineSidesOfCoarse * this->GetNoise(meanSide)));
  coarse.shareOfThickness = ShareOfCoarse * shareOfThickness;
  return coarse;
}

MedialVoxelCoarsenedPart
MedialVoxelCoarsenPart(MedialVoxelSheet                    part,
                       const std::vector<bool> &           isShared,
                       const MedialVoxelElementSize &      size,
                       const std::function<void(double)> & progress)
{
  assert(part.thickness.size() == part.points.size());
  const MedialVoxelSheetLines lines = MedialVoxelFindLines(part, isShared);
  const MedialVoxelSheetSizes sizes(part, lines, size.MakeCoarse(lines.meanSide));
  Complex                     complex;
  for (Index point = 0; point < part.points.size(); ++point)
  {
    complex.AddVertex(part.points[point]);
    complex.GetVertex(point).size = sizes.Get(point);
    complex.GetVertex(point).isShared = !isShared.empty() && isShared[point];
  }
  for (Index triangle = 0; triangle < part.triangles.size(); ++triangle)
  {
    complex.AddTriangle(part.triangles[triangle], lines.wallOf[triangle]);
  }
  MedialVoxelSheetDecimation(complex, size.GetNoise(lines.meanSide), progress).Run();
  MedialVoxelCoarsenedPart result = Collect(part, complex);
  result.walls = lines.numberOfWalls;
  result.wallsLeftOut =
    MedialVoxelListWallsLeftOut(part, lines.wallOf, complex.FindWallsKept(lines.numberOfWalls), size.least);
  return result;
}

} // end namespace itk
