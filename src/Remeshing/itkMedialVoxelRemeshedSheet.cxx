// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemeshedSheet.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelRemesher.h"
#include "itkMedialVoxelSheetHoles.h"
#include "itkMedialVoxelSheetVectors.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Vector = MedialVoxelVector3;
using Complex = MedialVoxelTriangleComplex;
using Distances = MedialVoxelRemeshingSummary::Distances;
using Nearest = MedialVoxelSheetTree::Nearest;

Distances
Summarize(std::vector<double> & distances)
{
  Distances result;
  if (!distances.empty())
  {
    result.mean = std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(distances.size());
    result.largest = *std::max_element(distances.begin(), distances.end());
    result.most = MedialVoxelFindPercentile(distances, 0.99);
  }
  return result;
}

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

/** Rotates corners, so that the lowest one comes first, and the marks of the sides with them. */
void
StartWithLowest(MedialVoxelShellElement & element)
{
  const unsigned int number = element.numberOfCorners;
  const auto         begin = element.corners.begin();
  const auto         lowest = static_cast<unsigned int>(std::min_element(begin, begin + number) - begin);
  std::rotate(begin, begin + lowest, begin + number);
  const auto rotate = [&](const std::uint8_t bits) {
    return static_cast<std::uint8_t>((bits >> lowest | bits << (number - lowest)) & ((1u << number) - 1));
  };
  element.rimSides = rotate(element.rimSides);
  element.junctionSides = rotate(element.junctionSides);
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
    StartWithLowest(element);
  }
  std::sort(result.elements.begin(), result.elements.end(), [](const auto & a, const auto & b) {
    return a.corners < b.corners;
  });
}

/** At the middles of the four parts of each triangle, which stand for equal areas. */
Distances
MeasureToFine(const MedialVoxelFineSheet & fine, const Complex & complex)
{
  std::vector<double> distances;
  double              sum = 0.0;
  double              areas = 0.0;
  for (Index triangle = 0; triangle < complex.GetNumberOfTriangles(); ++triangle)
  {
    if (!complex.IsTriangle(triangle))
    {
      continue;
    }
    const auto   corners = complex.GetCorners(triangle);
    const double area = GetArea(corners) / 4.0;
    const Vector middle = MedialVoxelMiddle(corners[0], corners[1]);
    const Vector center = MedialVoxelAddScaled(middle, MedialVoxelSubtract(corners[2], middle), 1.0 / 3.0);
    for (const Vector & sample : { center,
                                   MedialVoxelMiddle(corners[0], center),
                                   MedialVoxelMiddle(corners[1], center),
                                   MedialVoxelMiddle(corners[2], center) })
    {
      distances.push_back(fine.FindOnWall(sample, complex.GetWall(triangle)).distance);
      sum += area * distances.back();
      areas += area;
    }
  }
  Distances result = Summarize(distances);
  result.mean = areas > 0.0 ? sum / areas : 0.0;
  return result;
}

Distances
MeasureFromFine(const MedialVoxelFineSheet & fine, const Complex & complex)
{
  std::vector<Vector>            points;
  std::vector<Complex::Triangle> triangles;
  for (Index vertex = 0; vertex < complex.GetNumberOfVertices(); ++vertex)
  {
    points.push_back(complex.GetPoint(vertex));
  }
  for (Index triangle = 0; triangle < complex.GetNumberOfTriangles(); ++triangle)
  {
    if (complex.IsTriangle(triangle))
    {
      triangles.push_back(complex.GetTriangle(triangle));
    }
  }
  const MedialVoxelSheetTree tree(points, triangles, std::vector<Index>(triangles.size(), 0));
  std::vector<double>        distances;
  for (const Vector & point : fine.GetSheet().points)
  {
    distances.push_back(tree.Find(point, 0).distance);
  }
  return Summarize(distances);
}

void
MeasureShapes(MedialVoxelRemeshedSheet & sheet)
{
  MedialVoxelElementShapes shapes;
  for (const MedialVoxelShellElement & element : sheet.elements)
  {
    shapes.Add(sheet.points, element.corners, element.numberOfCorners);
  }
  const MedialVoxelShapeSummary found = shapes.Summarize();
  sheet.summary.elementsWithoutQuality = found.notPositive;
  sheet.summary.leastQuality = found.leastJacobian;
  sheet.summary.lowQuality = found.lowJacobian;
  sheet.summary.highAspect = found.highAspect;
}

void
MeasureAreasAndWalls(const MedialVoxelFineSheet & fine, const Complex & complex, MedialVoxelRemeshingSummary & summary)
{
  const MedialVoxelSheet & sheet = fine.GetSheet();
  for (const auto & corners : sheet.triangles)
  {
    summary.fineArea += GetArea({ { sheet.points[corners[0]], sheet.points[corners[1]], sheet.points[corners[2]] } });
  }
  std::vector<bool> isLeft(fine.GetNumberOfWalls());
  for (Index triangle = 0; triangle < complex.GetNumberOfTriangles(); ++triangle)
  {
    if (complex.IsTriangle(triangle))
    {
      summary.area += GetArea(complex.GetCorners(triangle));
      isLeft[complex.GetWall(triangle)] = true;
    }
  }
  summary.walls = isLeft.size();
  summary.wallsLeftOut = static_cast<std::uint64_t>(std::count(isLeft.begin(), isLeft.end(), false));
}

} // namespace

std::uint64_t
MedialVoxelRemeshingBytesPerTriangle()
{
  return MedialVoxelFineSheet::BytesPerTriangle + MedialVoxelTriangleComplex::BytesPerTriangle +
         MedialVoxelSheetWitnesses::BytesPerTriangle;
}

MedialVoxelRemeshedSheet
MedialVoxelRemesh(MedialVoxelSheet                    sheet,
                  const MedialVoxelElementSize &      size,
                  const std::function<void(double)> & progress)
{
  assert(size.least > 0.0 && sheet.thickness.size() == sheet.points.size());
  const std::uint64_t  holes = MedialVoxelCloseHoles(sheet, size.least);
  MedialVoxelFineSheet fine(std::move(sheet));
  fine.SetSizes(size.least, size.atThickness);
  MedialVoxelRemesher remesher(fine, progress);
  remesher.Run();

  const Complex &                complex = remesher.GetComplex();
  MedialVoxelRemeshedSheet       result;
  std::vector<Complex::Triangle> corners;
  result.summary.holesClosed = holes + remesher.GetNumberOfHolesClosed();
  result.summary.trianglesLeftOut = remesher.GetNumberLeftOut();
  result.summary.orientationConflicts = MedialVoxelOrientWalls(complex, corners);
  result.elements = MedialVoxelPairTriangles(complex, corners, size.joinsTriangles);
  PutInOrder(fine, complex, result);
  result.summary.toFine = MeasureToFine(fine, complex);
  result.summary.fromFine = MeasureFromFine(fine, complex);
  MeasureAreasAndWalls(fine, complex, result.summary);
  MeasureShapes(result);
  return result;
}

} // end namespace itk
