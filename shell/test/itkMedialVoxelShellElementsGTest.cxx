// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelElementSmoothing.h"
#include "itkMedialVoxelLoneTriangles.h"

#include "MedialVoxelTestElements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

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

/** Elements, and a sheet of the same, or above them. */
class Model
{
public:
  Model(const std::vector<Vector3> & points, const std::vector<std::vector<std::uint32_t>> & corners, double lift = 0.0)
  {
    itk::MedialVoxelSheet sheet;
    for (const Vector3 & point : points)
    {
      sheet.points.push_back({ { point[0], point[1], point[2] + lift } });
      sheet.thickness.push_back(1.0f);
      complex.GetVertex(complex.AddVertex(point)).size = 1.0f;
    }
    for (const auto & list : corners)
    {
      elements.push_back(MakeElement(list));
      for (std::size_t k = 2; k < list.size(); ++k)
      {
        sheet.triangles.push_back({ { list[0], list[k - 1], list[k] } });
        complex.AddTriangle(sheet.triangles.back(), 0);
      }
    }
    m_Fine = std::make_unique<itk::MedialVoxelFineSheet>(sheet, itk::MedialVoxelElementSize{ 1.0 });
  }

  /** \return the elements after it, all of which that are new are good; sizes and topology are the same */
  std::size_t
  JoinLoneTriangles()
  {
    const Faces before = FacesOf(complex, elements);
    itk::MedialVoxelJoinLoneTriangles(complex, *m_Fine, 0.4, elements);
    const Faces after = FacesOf(complex, elements);
    EXPECT_EQ(after.GetEulerNumber(), before.GetEulerNumber());
    EXPECT_NEAR(after.GetArea(), before.GetArea(), 1e-12);
    for (const Element & element : elements)
    {
      EXPECT_GE(itk::MedialVoxelShellQuality(complex, element), 0.4);
    }
    return elements.size();
  }

  std::size_t
  CountTriangles() const
  {
    return static_cast<std::size_t>(
      std::count_if(elements.begin(), elements.end(), [](const Element & e) { return e.numberOfCorners == 3; }));
  }

  Complex              complex;
  std::vector<Element> elements;

private:
  std::unique_ptr<itk::MedialVoxelFineSheet> m_Fine;
};

/** A strip with a half square, whole squares and a half square: both halves meet, whatever is between. */
TEST(MedialVoxelLoneTriangles, MeetThroughQuadrilaterals)
{
  for (std::uint32_t squares = 1; squares < 30; ++squares)
  {
    std::vector<Vector3> points;
    for (std::uint32_t x = 0; x < squares + 2; ++x)
    {
      points.push_back({ { double(x), 0.0, 0.0 } });
      points.push_back({ { double(x), 1.0, 0.0 } });
    }
    std::vector<std::vector<std::uint32_t>> corners{ { 1, 2, 3 } }; // the strip begins without its corner 0
    for (std::uint32_t x = 1; x < squares; ++x)
    {
      corners.push_back({ 2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1 });
    }
    corners.push_back({ 2 * squares, 2 * squares + 2, 2 * squares + 1 }); // and ends without its last one
    Model      model(points, corners);
    const auto outline = FacesOf(model.complex, model.elements).ListMiddles(false);
    EXPECT_EQ(model.JoinLoneTriangles(), squares);
    EXPECT_EQ(model.CountTriangles(), 0u);
    EXPECT_EQ(FacesOf(model.complex, model.elements).ListMiddles(false), outline);
  }
}

/** No way leads over a junction, or to another triangle that is not there; and points of rims stay. */
TEST(MedialVoxelLoneTriangles, StayWhereNoOtherIs)
{
  const std::vector<Vector3> points{ { { 0, 0, 0 } },   { { 1, 0, 0 } },   { { 1, 1, 0 } },   { { 0, 1, 0 } },
                                     { { 2, 0.5, 0 } }, { { 1, 0.5, 1 } }, { { -1, 0.5, 0 } } };
  EXPECT_EQ(Model(points, { { 0, 1, 2, 3 }, { 1, 4, 2 } }).JoinLoneTriangles(), 2u);
  EXPECT_EQ(Model(points, { { 0, 3, 6 }, { 0, 1, 2, 3 }, { 1, 4, 2 }, { 1, 5, 2 } }).JoinLoneTriangles(), 4u);
}

/** A strip of squares with a triangle at one rim: it goes, but not where the rim has a corner, or the sheet is away. */
TEST(MedialVoxelLoneTriangles, GoAtStraightRims)
{
  for (const auto & [height, lift] : { std::pair(0.0, 0.0), std::pair(0.5, 0.0), std::pair(0.0, 0.1) })
  {
    Model      model({ { { 0, 0, 0 } },
                       { { 1, 0, 0 } },
                       { { 2, 0, 0 } },
                       { { 3, 0, 0 } },
                       { { 0, 1, 0 } },
                       { { 0.9, 1, 0 } },
                       { { 1.5, 1 + height, 0 } },
                       { { 2.1, 1, 0 } },
                       { { 3, 1, 0 } } },
                     { { 0, 1, 5, 4 }, { 1, 6, 5 }, { 1, 2, 7, 6 }, { 2, 3, 8, 7 } },
                lift);
    const bool goes = height + lift == 0;
    EXPECT_EQ(model.JoinLoneTriangles(), goes ? 3u : 4u);
    EXPECT_EQ(model.CountTriangles(), goes ? 0u : 1u);
  }
}

/** Two needles back to back between four squares: they are no quadrilateral, and their side becomes a point. */
TEST(MedialVoxelLoneTriangles, NeedlesBecomeALine)
{
  Model model({ { { 0, -0.15, 0 } },
                { { 0, 0.15, 0 } },
                { { -1, 0, 0 } },
                { { 1, 0, 0 } },
                { { -1, 1, 0 } },
                { { 0, 1, 0 } },
                { { 1, 1, 0 } },
                { { -1, -1, 0 } },
                { { 0, -1, 0 } },
                { { 1, -1, 0 } } },
              { { 0, 1, 2 }, { 0, 3, 1 }, { 2, 1, 5, 4 }, { 1, 3, 6, 5 }, { 7, 8, 0, 2 }, { 8, 9, 3, 0 } });
  EXPECT_EQ(model.JoinLoneTriangles(), 4u);
  EXPECT_EQ(model.CountTriangles(), 0u);
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
  const auto elements = itk::MedialVoxelMakeElements(complex, fine, corners, true, itk::MedialVoxelRunInOrder);
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
