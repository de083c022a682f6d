// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemeshedSheet.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelRemesher.h"
#include "itkMedialVoxelSheetHoles.h"
#include "itkMedialVoxelSheetPart.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Vector = MedialVoxelVector3;
using Complex = MedialVoxelTriangleComplex;
using Nearest = MedialVoxelSheetTree::Nearest;

double
GetArea(const std::array<Vector, 3> & corners)
{
  return MedialVoxelNorm(MedialVoxelTriangleNormal(corners)) / 2.0;
}

/** The place of the walls of a vertex that is nearest to it. */
Nearest
FindOnFine(const MedialVoxelFineSheet & fine, const Complex & complex, const Index vertex)
{
  Nearest best;
  for (const Index triangle : complex.GetTrianglesOf(vertex))
  {
    const Nearest found = fine.FindOnWall(complex.GetPoint(vertex), complex.GetWall(triangle), best.distance);
    best = found.distance < best.distance ? found : best;
  }
  return best;
}

/** Gives the points of the complex that are in use to the result, by their places, and numbers the elements' corners
 * anew. */
void
PutInOrder(const MedialVoxelFineSheet & fine, const Complex & complex, MedialVoxelRemeshedSheet & result)
{
  std::vector<Index> order;
  for (Index vertex = 0; vertex < complex.GetNumberOfVertices(); ++vertex)
  {
    if (!complex.GetTrianglesOf(vertex).empty())
    {
      order.push_back(vertex);
    }
  }
  std::sort(order.begin(), order.end(), [&](const Index a, const Index b) {
    const Vector & p = complex.GetPoint(a);
    const Vector & q = complex.GetPoint(b);
    return p[2] != q[2] ? p[2] < q[2] : p[1] != q[1] ? p[1] < q[1] : p[0] != q[0] ? p[0] < q[0] : a < b;
  });
  std::vector<Index> numbers(complex.GetNumberOfVertices());
  for (const Index vertex : order)
  {
    numbers[vertex] = static_cast<Index>(result.points.size());
    const Nearest nearest = FindOnFine(fine, complex, vertex);
    result.points.push_back(complex.GetPoint(vertex));
    result.thickness.push_back(fine.GetThickness(nearest.triangle, nearest.point));
    result.finePoint.push_back(fine.GetNearestPoint(nearest.triangle, nearest.point));
  }
  for (MedialVoxelShellElement & element : result.elements)
  {
    const auto begin = element.corners.begin();
    std::transform(begin, begin + element.numberOfCorners, begin, [&](const Index vertex) { return numbers[vertex]; });
    MedialVoxelStartWithLowest(element);
  }
  std::sort(result.elements.begin(), result.elements.end(), [](const auto & a, const auto & b) {
    return a.corners < b.corners;
  });
}

double
GetArea(const Complex & complex)
{
  double area = 0.0;
  for (Index triangle = 0; triangle < complex.GetNumberOfTriangles(); ++triangle)
  {
    area += complex.IsTriangle(triangle) ? GetArea(complex.GetCorners(triangle)) : 0.0;
  }
  return area;
}

double
GetArea(const MedialVoxelSheet & sheet)
{
  double area = 0.0;
  for (const auto & corners : sheet.triangles)
  {
    area += GetArea(
      std::array<Vector, 3>{ { sheet.points[corners[0]], sheet.points[corners[1]], sheet.points[corners[2]] } });
  }
  return area;
}

/** Of the sides of triangles. */
double
GetMeanSide(const MedialVoxelSheet & sheet)
{
  double sum = 0.0;
  for (const auto & corners : sheet.triangles)
  {
    for (unsigned int k = 0; k < 3; ++k)
    {
      sum += MedialVoxelNorm(MedialVoxelSubtract(sheet.points[corners[k]], sheet.points[corners[(k + 1) % 3]]));
    }
  }
  return sheet.triangles.empty() ? 0.0 : sum / static_cast<double>(3 * sheet.triangles.size());
}

/** Closes holes; the point of a lid comes from one beside it.
 * \return how many there were */
std::uint64_t
CloseHoles(MedialVoxelCoarsenedPart & coarse, const double least)
{
  const std::uint64_t holes = MedialVoxelCloseHoles(coarse.sheet, least);
  const std::size_t   given = coarse.finePoint.size();
  coarse.finePoint.resize(coarse.sheet.points.size());
  for (const auto & corners : coarse.sheet.triangles)
  {
    for (const Index corner : corners)
    {
      if (corner >= given)
      {
        coarse.finePoint[corner] = coarse.finePoint[*std::min_element(corners.begin(), corners.end())];
      }
    }
  }
  return holes;
}

/** Elements of a sheet whose rims stay where they are. */
MedialVoxelRemeshedSheet
MakeElements(MedialVoxelSheet                    sheet,
             const MedialVoxelElementSize &      size,
             const double                        noise,
             const MedialVoxelRunTasks &         runTasks,
             const std::function<void(double)> & progress)
{
  MedialVoxelFineSheet fine(std::move(sheet), size);
  MedialVoxelRemesher  remesher(fine, noise);
  remesher.Run(runTasks, progress);

  Complex                        complex = remesher.GetComplex();
  MedialVoxelRemeshedSheet       result;
  std::vector<Complex::Triangle> corners;
  result.summary.holesClosed = remesher.GetNumberOfHolesClosed();
  result.summary.trianglesLeftOut = remesher.GetNumberLeftOut();
  result.summary.orientationConflicts = MedialVoxelOrientWalls(complex, corners);
  result.elements = MedialVoxelMakeElements(complex, fine, corners, size.joinsTriangles, runTasks);
  result.summary.area = GetArea(complex);
  result.summary.wallsLeftOut = MedialVoxelListWallsLeftOut(
    fine.GetSheet(), fine.GetWalls(), complex.FindWallsKept(fine.GetNumberOfWalls()), size.least);
  PutInOrder(fine, complex, result);
  return result;
}

} // namespace

std::uint64_t
MedialVoxelRemeshingBytesPerTriangle()
{
  constexpr std::uint64_t pointsOfParts = 32;
  return MedialVoxelFineSheet::BytesPerTriangle + MedialVoxelTriangleComplex::BytesPerTriangle +
         MedialVoxelSheetWitnesses::BytesPerTriangle + pointsOfParts;
}

MedialVoxelRemeshedSheet
MedialVoxelRemesh(MedialVoxelSheet                    sheet,
                  const MedialVoxelElementSize &      size,
                  const std::function<void(double)> & progress,
                  const MedialVoxelRunTasks &         runTasks)
{
  assert(size.least > 0.0 && sheet.thickness.size() == sheet.points.size());
  const double             area = GetArea(sheet);
  const double             noise = size.GetNoise(GetMeanSide(sheet));
  MedialVoxelCoarsenedPart coarse = MedialVoxelCoarsenPart(std::move(sheet), {}, size, progress);
  const std::uint64_t      holes = CloseHoles(coarse, size.least);

  std::vector<Index>                            origins(coarse.sheet.points.size());
  std::optional<MedialVoxelRimExtensionSummary> rims;
  std::iota(origins.begin(), origins.end(), Index{ 0 });
  if (size.extendsRims)
  {
    rims = MedialVoxelExtendRims(coarse.sheet, size.measureRimRays, size.rimLimits, origins, runTasks);
  }
  // Rims that were extended are straight.
  auto result = MakeElements(std::move(coarse.sheet), size, size.extendsRims ? 0.0 : noise, runTasks, progress);
  for (Index & point : result.finePoint)
  {
    point = coarse.finePoint[origins[point]];
  }
  for (std::size_t k = 0; size.extendsRims && k < result.points.size(); ++k)
  {
    result.points[k] = MedialVoxelMoveWithin(result.points[k], size.rimLimits);
  }
  result.summary.fineArea = area;
  result.summary.walls = coarse.walls;
  MedialVoxelAddWallsLeftOut(coarse.wallsLeftOut, result.summary.wallsLeftOut);
  result.summary.holesClosed += holes;
  result.summary.rims = rims;
  return result;
}

} // end namespace itk
