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
using Nearest = MedialVoxelSheetTree::Nearest;

/** Of how far the fine sheet may be off: so long are sides at least before rims are extended. */
constexpr double NoisesBefore = 4.0;

/** Of the size, that sides have before rims are extended: about as long as what is added then. */
constexpr double ShareBefore = 0.4;

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

/** The given point of a triangle that is nearest to a place; lids of holes have a point that was not given. */
Index
FindGivenPoint(const MedialVoxelFineSheet & fine, const Nearest & nearest, const Index numberGiven)
{
  const MedialVoxelSheet & sheet = fine.GetSheet();
  const auto &             corners = sheet.triangles[nearest.triangle];
  return *std::min_element(corners.begin(), corners.end(), [&](const Index a, const Index b) {
    const auto distance = [&](const Index point) {
      return point < numberGiven ? MedialVoxelNorm(MedialVoxelSubtract(sheet.points[point], nearest.point))
                                 : MedialVoxelSheetTree::Anywhere;
    };
    return distance(a) < distance(b);
  });
}

/** Gives the points of the complex that are in use to the result, by their places, and numbers the elements' corners
 * anew. */
void
PutInOrder(const MedialVoxelFineSheet & fine,
           const Complex &              complex,
           const Index                  numberGiven,
           MedialVoxelRemeshedSheet &   result)
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
    result.finePoint.push_back(FindGivenPoint(fine, nearest, numberGiven));
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

void
MeasureAreasAndWalls(const MedialVoxelFineSheet &  fine,
                     const Complex &               complex,
                     const double                  least,
                     MedialVoxelRemeshingSummary & summary)
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
  summary.wallsLeftOut = MedialVoxelListWallsLeftOut(fine, isLeft, least);
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

MedialVoxelRemeshedSheet
RemeshAsItIs(MedialVoxelSheet                    sheet,
             const MedialVoxelElementSize &      size,
             const bool                          isStraight,
             const std::function<void(double)> & progress)
{
  const auto           numberGiven = static_cast<Index>(sheet.points.size());
  const std::uint64_t  holes = MedialVoxelCloseHoles(sheet, size.least);
  MedialVoxelFineSheet fine(std::move(sheet));
  fine.SetSizes(size.least, size.atThickness, size.shareOfThickness);
  MedialVoxelRemesher remesher(fine, isStraight ? 0.0 : size.noise, progress);
  remesher.Coarsen(MedialVoxelSheetTree::Anywhere);
  remesher.Finish();

  Complex                        complex = remesher.GetComplex();
  MedialVoxelRemeshedSheet       result;
  std::vector<Complex::Triangle> corners;
  result.summary.holesClosed = holes + remesher.GetNumberOfHolesClosed();
  result.summary.trianglesLeftOut = remesher.GetNumberLeftOut();
  result.summary.orientationConflicts = MedialVoxelOrientWalls(complex, corners);
  result.elements = MedialVoxelMakeElements(complex, fine, corners, size.joinsTriangles);
  PutInOrder(fine, complex, numberGiven, result);
  MeasureAreasAndWalls(fine, complex, size.least, result.summary);
  return result;
}

/** What was found before rims were extended, and after that. */
MedialVoxelRemeshingSummary
Add(const MedialVoxelRemeshingSummary & before, const MedialVoxelRemeshingSummary & after)
{
  MedialVoxelRemeshingSummary sum = after;
  sum.fineArea = before.fineArea;
  sum.walls = before.walls;
  sum.wallsLeftOut.insert(sum.wallsLeftOut.end(), before.wallsLeftOut.begin(), before.wallsLeftOut.end());
  std::stable_sort(
    sum.wallsLeftOut.begin(), sum.wallsLeftOut.end(), [](const auto & a, const auto & b) { return a.area > b.area; });
  sum.holesClosed = before.holesClosed + after.holesClosed;
  sum.trianglesLeftOut = before.trianglesLeftOut + after.trianglesLeftOut;
  return sum;
}


/** Extends the rims of a sheet of a smaller size, so that strips have the shape of elements and those are made
 * anew. */
MedialVoxelRemeshedSheet
RemeshExtended(MedialVoxelSheet                    sheet,
               const MedialVoxelElementSize &      size,
               const std::function<void(double)> & progress)
{
  MedialVoxelElementSize first = MedialVoxelSizeBeforeRims(size);
  first.joinsTriangles = false;
  const MedialVoxelRemeshedSheet before = RemeshAsItIs(std::move(sheet), first, false, progress);

  MedialVoxelSheet carried;
  carried.points = before.points;
  carried.thickness.assign(before.thickness.begin(), before.thickness.end());
  for (const MedialVoxelShellElement & element : before.elements)
  {
    carried.triangles.push_back({ { element.corners[0], element.corners[1], element.corners[2] } });
  }
  std::vector<Index> origins;
  const auto         rims = MedialVoxelExtendRims(carried, size.measureRimRays, size.rimLimits, origins);

  MedialVoxelRemeshedSheet result = RemeshAsItIs(std::move(carried), size, true, progress);
  for (Index & point : result.finePoint)
  {
    point = before.finePoint[origins[point]];
  }
  for (MedialVoxelVector3 & point : result.points)
  {
    point = MedialVoxelMoveWithin(point, size.rimLimits);
  }
  result.summary = Add(before.summary, result.summary);
  result.summary.rims = rims;
  return result;
}

} // namespace

MedialVoxelElementSize
MedialVoxelSizeBeforeRims(const MedialVoxelElementSize & size)
{
  MedialVoxelElementSize before = size;
  before.least = std::max(ShareBefore * size.least, std::min(size.least, NoisesBefore * size.noise));
  before.shareOfThickness = ShareBefore * size.shareOfThickness;
  return before;
}

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
  MedialVoxelElementSize known = size;
  known.noise = size.GetNoise(GetMeanSide(sheet));
  return size.extendsRims ? RemeshExtended(std::move(sheet), known, progress)
                          : RemeshAsItIs(std::move(sheet), known, false, progress);
}

} // end namespace itk
