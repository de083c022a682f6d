// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelElementSmoothing.h"
#include "itkMedialVoxelLoneTriangles.h"

#include "MedialVoxelTestElements.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace MedialVoxelTest;
using Complex = itk::MedialVoxelTriangleComplex;
using Element = itk::MedialVoxelShellElement;

Element
MakeElement(const std::vector<std::uint32_t> & corners)
{
  Element element;
  std::copy(corners.begin(), corners.end(), element.corners.begin());
  element.numberOfCorners = static_cast<std::uint8_t>(corners.size());
  return element;
}

Faces
FacesOf(const Complex & complex, const std::vector<Element> & elements)
{
  Faces faces;
  for (std::uint32_t vertex = 0; vertex < complex.GetNumberOfVertices(); ++vertex)
  {
    faces.points.push_back(complex.GetPoint(vertex));
  }
  for (const Element & element : elements)
  {
    faces.faces.emplace_back(element.corners.begin(), element.corners.begin() + element.numberOfCorners);
  }
  return faces;
}

/** A strip with a half square, whole squares and a half square: both halves meet, whatever is between. */
TEST(MedialVoxelLoneTriangles, MeetThroughQuadrilaterals)
{
  for (std::uint32_t squares = 1; squares < 30; ++squares)
  {
    Complex    complex;
    const auto columns = squares + 2;
    for (std::uint32_t x = 0; x < columns; ++x)
    {
      complex.AddVertex({ { double(x), 0.0, 0.0 } });
      complex.AddVertex({ { double(x), 1.0, 0.0 } });
    }
    std::vector<Element> elements{ MakeElement({ 1, 2, 3 }) }; // the strip begins without its corner 0
    for (std::uint32_t x = 1; x < squares; ++x)
    {
      elements.push_back(MakeElement({ 2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1 }));
    }
    elements.push_back(MakeElement({ 2 * squares, 2 * squares + 2, 2 * squares + 1 })); // and ends without its last one
    const Faces before = FacesOf(complex, elements);
    itk::MedialVoxelJoinLoneTriangles(complex, elements);
    const Faces after = FacesOf(complex, elements);
    EXPECT_EQ(elements.size(), squares);
    for (const Element & element : elements)
    {
      EXPECT_EQ(element.numberOfCorners, 4);
      EXPECT_GE(itk::MedialVoxelShellQuality(complex, element), 0.4);
    }
    EXPECT_EQ(after.GetEulerNumber(), 1);
    EXPECT_NEAR(after.GetArea(), before.GetArea(), 1e-12);
    EXPECT_EQ(after.ListMiddles(false), before.ListMiddles(false)); // the same outline
  }
}

/** No way leads over a junction, or to another triangle that is not there. */
TEST(MedialVoxelLoneTriangles, StayWhereNoOtherIs)
{
  Complex complex;
  for (const Vector3 & point : std::vector<Vector3>{ { { 0, 0, 0 } },
                                                     { { 1, 0, 0 } },
                                                     { { 1, 1, 0 } },
                                                     { { 0, 1, 0 } },
                                                     { { 2, 0.5, 0 } },
                                                     { { 1, 0.5, 1 } },
                                                     { { -1, 0.5, 0 } } })
  {
    complex.AddVertex(point);
  }
  std::vector<Element> alone{ MakeElement({ 0, 1, 2, 3 }), MakeElement({ 1, 4, 2 }) };
  itk::MedialVoxelJoinLoneTriangles(complex, alone);
  EXPECT_EQ(alone.size(), 2u);
  std::vector<Element> junction{
    MakeElement({ 0, 3, 6 }), MakeElement({ 0, 1, 2, 3 }), MakeElement({ 1, 4, 2 }), MakeElement({ 1, 5, 2 })
  };
  itk::MedialVoxelJoinLoneTriangles(complex, junction);
  EXPECT_EQ(junction.size(), 4u);
}

/** A square of triangles whose inner vertices were pushed about: all but few become quadrilaterals, on the plane. */
TEST(MedialVoxelShellElements, TrianglesBecomeQuadrilaterals)
{
  constexpr std::uint32_t n = 12;
  itk::MedialVoxelSheet   sheet;
  for (std::uint32_t y = 0; y <= n; ++y)
  {
    for (std::uint32_t x = 0; x <= n; ++x)
    {
      const bool   isInside = x > 0 && y > 0 && x < n && y < n;
      const double push = isInside ? 0.35 : 0.0;
      sheet.points.push_back(
        { { x + push * std::sin(7.0 * x + 3.0 * y), y + push * std::cos(5.0 * x * y + 1.0), 0.0 } });
      sheet.thickness.push_back(1.0f);
    }
  }
  for (std::uint32_t y = 0; y < n; ++y)
  {
    for (std::uint32_t x = 0; x < n; ++x)
    {
      const std::uint32_t corner = y * (n + 1) + x;
      sheet.AddQuad({ { corner, corner + 1, corner + n + 2, corner + n + 1 } });
    }
  }
  const itk::MedialVoxelFineSheet fine(sheet, { 1.0 });
  Complex                         complex;
  for (const Vector3 & point : sheet.points)
  {
    complex.GetVertex(complex.AddVertex(point)).size = 1.0f;
  }
  for (const auto & corners : sheet.triangles)
  {
    complex.AddTriangle(corners, 0);
  }
  std::vector<Complex::Triangle> corners;
  ASSERT_EQ(itk::MedialVoxelOrientWalls(complex, corners), 0u);
  const auto elements = itk::MedialVoxelMakeElements(complex, fine, corners, true);
  const auto triangles = std::count_if(
    elements.begin(), elements.end(), [](const Element & element) { return element.numberOfCorners == 3; });
  EXPECT_LE(triangles, static_cast<long>(elements.size()) / 20);
  const Faces faces = FacesOf(complex, elements);
  EXPECT_EQ(faces.GetEulerNumber(), 1);
  EXPECT_NEAR(faces.GetArea(), n * n, 1e-9);
  for (const Element & element : elements)
  {
    EXPECT_GE(itk::MedialVoxelShellQuality(complex, element), element.numberOfCorners == 4 ? 0.4 : 0.2);
  }
  for (std::uint32_t point = 0; point < sheet.points.size(); ++point)
  {
    const Vector3 & place = sheet.points[point];
    const bool      isRim = place[0] == 0 || place[1] == 0 || place[0] == n || place[1] == n;
    EXPECT_TRUE(!isRim || complex.GetPoint(point) == place);
    EXPECT_EQ(complex.GetPoint(point)[2], 0.0);
  }
}

/** A roof of two halves: its warpage is the angle between them, and a flat parallelogram has its angles. */
TEST(MedialVoxelElementShapes, WarpageAnglesAndSides)
{
  const double                  angle = 0.3;
  itk::MedialVoxelElementShapes shapes;
  const std::vector<Vector3>    points{ { { 0, 0, 0 } }, { { 1, -1, 0 } },
                                        { { 2, 0, 0 } }, { { 1, std::cos(angle), std::sin(angle) } },
                                        { { 3, 0, 0 } }, { { 4, 1, 0 } } };
  shapes.Add(points, { { 0, 1, 2, 3 } }, 4);
  EXPECT_NEAR(shapes.Summarize().largestWarpage, angle * 180 / std::acos(-1.0), 1e-9);
  shapes = {};
  shapes.Add(points, { { 0, 4, 5 } }, 3); // sides 3, sqrt(2) and sqrt(17)
  const auto summary = shapes.Summarize();
  EXPECT_EQ(summary.largestWarpage, 0.0);
  EXPECT_NEAR(summary.largestAngle, 135.0, 1e-9);
  EXPECT_NEAR(summary.leastAngle, std::atan2(1.0, 4.0) * 180 / std::acos(-1.0), 1e-9);
  EXPECT_NEAR(summary.shortestSide, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(summary.longestSide, std::sqrt(17.0), 1e-12);
  EXPECT_NEAR(summary.meanSide, (3 + std::sqrt(2.0) + std::sqrt(17.0)) / 3, 1e-12);
}
} // namespace
