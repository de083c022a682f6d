// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFoldedElements.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;
using Element = MedialVoxelShellElement;
using Quadrilateral = std::array<Vector, 4>;

/** The coordinate of Gauss points: the root of a third. */
constexpr double Gauss = 0.5773502691896258;

/** Corners in the square from -1 to 1. */
constexpr Quadrilateral Square{ { { { -1, -1, 0 } }, { { 1, -1, 0 } }, { { 1, 1, 0 } }, { { -1, 1, 0 } } } };

/** Of the thickness that counts. */
constexpr double Margin = 1.5;

/** Of the numbers at corners, at a place in the square: their value, or their change along an axis. */
struct Weights
{
  std::array<double, 4> value;
  std::array<double, 4> along0;
  std::array<double, 4> along1;

  explicit Weights(const Vector & place)
  {
    for (unsigned int k = 0; k < 4; ++k)
    {
      const double at0 = 1.0 + Square[k][0] * place[0];
      const double at1 = 1.0 + Square[k][1] * place[1];
      value[k] = at0 * at1 / 4.0;
      along0[k] = Square[k][0] * at1 / 4.0;
      along1[k] = Square[k][1] * at0 / 4.0;
    }
  }
};

Vector
Sum(const Quadrilateral & vectors, const std::array<double, 4> & weights)
{
  Vector sum{};
  for (unsigned int k = 0; k < 4; ++k)
  {
    sum = MedialVoxelAddScaled(sum, vectors[k], weights[k]);
  }
  return sum;
}

/** A triangle of three corners of a quadrilateral, which go on round it. */
Element
MakeTriangle(const Element & element, const std::array<unsigned int, 3> & places)
{
  Element triangle;
  triangle.wall = element.wall;
  for (unsigned int k = 0; k < 3; ++k)
  {
    triangle.corners[k] = element.corners[places[k]];
    if (places[(k + 1) % 3] == (places[k] + 1) % 4)
    {
      triangle.rimSides = static_cast<std::uint8_t>(triangle.rimSides | (element.rimSides >> places[k] & 1u) << k);
      triangle.junctionSides =
        static_cast<std::uint8_t>(triangle.junctionSides | (element.junctionSides >> places[k] & 1u) << k);
    }
  }
  MedialVoxelStartWithLowest(triangle);
  return triangle;
}

/** Along the diagonal whose worse triangle is better. */
std::array<Element, 2>
Split(const Element & element, const Quadrilateral & at)
{
  const auto worse = [&](const unsigned int a, const unsigned int b) {
    return std::min(MedialVoxelShellQuality(std::array<Vector, 3>{ { at[a], at[a + 1], at[b] } }),
                    MedialVoxelShellQuality(std::array<Vector, 3>{ { at[b], at[(b + 1) % 4], at[a] } }));
  };
  if (worse(0, 2) >= worse(1, 3))
  {
    return { { MakeTriangle(element, { { 0, 1, 2 } }), MakeTriangle(element, { { 0, 2, 3 } }) } };
  }
  return { { MakeTriangle(element, { { 0, 1, 3 } }), MakeTriangle(element, { { 1, 2, 3 } }) } };
}

} // namespace

bool
MedialVoxelIsFolded(const std::array<MedialVoxelVector3, 4> & corners, const double thickness)
{
  Quadrilateral normals;
  for (unsigned int k = 0; k < 4; ++k)
  {
    normals[k] =
      MedialVoxelNormalized(MedialVoxelTriangleNormal({ { corners[k], corners[(k + 1) % 4], corners[(k + 3) % 4] } }));
  }
  for (const double z : { -Gauss, Gauss })
  {
    Quadrilateral layer;
    std::transform(
      corners.begin(), corners.end(), normals.begin(), layer.begin(), [&](const auto & corner, const auto & n) {
        return MedialVoxelAddScaled(corner, n, z * thickness / 2.0);
      });
    for (const Vector & corner : Square)
    {
      const Weights weights(MedialVoxelAddScaled({}, corner, Gauss));
      const Vector  across = MedialVoxelCross(Sum(layer, weights.along0), Sum(layer, weights.along1));
      if (!(MedialVoxelDot(across, Sum(normals, weights.value)) > 0.0))
      {
        return true;
      }
    }
  }
  return false;
}

void
MedialVoxelSplitFolded(MedialVoxelRemeshedSheet & sheet)
{
  assert(sheet.thickness.size() == sheet.points.size());
  std::vector<Element> elements;
  for (const Element & element : sheet.elements)
  {
    Quadrilateral at{};
    double        thickness = 0.0;
    for (unsigned int k = 0; k < element.numberOfCorners; ++k)
    {
      at[k] = sheet.points[element.corners[k]];
      thickness = std::max(thickness, sheet.thickness[element.corners[k]]);
    }
    if (element.numberOfCorners == 4 && MedialVoxelIsFolded(at, Margin * thickness))
    {
      const auto halves = Split(element, at);
      elements.insert(elements.end(), halves.begin(), halves.end());
    }
    else
    {
      elements.push_back(element);
    }
  }
  std::sort(elements.begin(), elements.end(), [](const auto & a, const auto & b) { return a.corners < b.corners; });
  sheet.elements = std::move(elements);
}

} // end namespace itk
