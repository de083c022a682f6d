// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelIsosurface.h"
#include "itkMedialVoxelIsosurfaceTable.h"
#include "itkMedialVoxelWallRay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace
{

using Table = itk::MedialVoxelIsosurfaceTable;
using Index = itk::MedialVoxelIndex;
using Side = std::pair<std::uint64_t, std::uint64_t>;

/** Takes a surface into memory. */
class Collector : public itk::MedialVoxelIsosurfaceConsumer
{
public:
  void
  AddVertices(const std::vector<itk::MedialVoxelIsosurfaceVertex> & vertices) override
  {
    m_Vertices.insert(m_Vertices.end(), vertices.begin(), vertices.end());
  }

  void
  AddTriangles(const std::vector<itk::MedialVoxelIsosurfaceTriangle> & triangles) override
  {
    m_Triangles.insert(m_Triangles.end(), triangles.begin(), triangles.end());
  }

  std::vector<itk::MedialVoxelIsosurfaceVertex>   m_Vertices;
  std::vector<itk::MedialVoxelIsosurfaceTriangle> m_Triangles;
};

/** The surface of voxels for which margin(x, y, z) is not negative. */
template <typename TMargin>
Collector
Build(const Index & size, bool isClosed, const TMargin & margin)
{
  Collector                  collector;
  itk::MedialVoxelMargins    margins(size, 2);
  itk::MedialVoxelIsosurface surface(margins, isClosed, collector);
  for (std::int64_t z = 0; z < size[2]; ++z)
  {
    itk::MedialVoxelBits bits({ { 0, 0, z }, { size[0], size[1], z + 1 } });
    for (std::int64_t y = 0; y < size[1]; ++y)
    {
      for (std::int64_t x = 0; x < size[0]; ++x)
      {
        margins.GetRow(y, z)[x] = margin(x, y, z);
        if (margin(x, y, z) >= 0.0f)
        {
          bits.Set({ x, y, z });
        }
      }
    }
    surface.AddSlice(bits);
  }
  surface.Finish();
  return collector;
}

/** How often each side is walked along in its direction. */
std::map<Side, int>
CountSides(const Collector & surface)
{
  std::map<Side, int> sides;
  for (const auto & triangle : surface.m_Triangles)
  {
    for (unsigned int i = 0; i < 3; ++i)
    {
      ++sides[{ triangle.vertices[i], triangle.vertices[(i + 1) % 3] }];
    }
  }
  return sides;
}

void
ExpectClosed(const Collector & surface)
{
  const auto sides = CountSides(surface);
  for (const auto & [side, count] : sides)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({ side.second, side.first }), 1u);
  }
}

double
GetVolume(const Collector & surface)
{
  double volume = 0.0;
  for (const auto & triangle : surface.m_Triangles)
  {
    const auto & a = surface.m_Vertices[triangle.vertices[0]].point;
    const auto & b = surface.m_Vertices[triangle.vertices[1]].point;
    const auto & c = surface.m_Vertices[triangle.vertices[2]].point;
    volume +=
      (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
      6.0;
  }
  return volume;
}

TEST(MedialVoxelIsosurfaceTable, HasTrianglesForAllCorners)
{
  std::size_t most = 0;
  for (unsigned int corners = 0; corners < 256; ++corners)
  {
    const auto & triangles = Table::Get(corners);
    EXPECT_EQ(triangles.empty(), corners == 0 || corners == 255);
    std::set<unsigned int> crossed;
    for (unsigned int edge = 0; edge < Table::NumberOfEdges; ++edge)
    {
      const unsigned int lower = Table::GetLowerCorner(edge);
      const unsigned int upper = lower | 1u << Table::GetAxis(edge);
      if ((corners >> lower & 1u) != (corners >> upper & 1u))
      {
        crossed.insert(edge);
      }
    }
    std::set<unsigned int> used;
    for (const auto & triangle : triangles)
    {
      used.insert(triangle.begin(), triangle.end());
    }
    EXPECT_EQ(used, crossed) << corners;
    most = std::max(most, triangles.size());
  }
  EXPECT_EQ(most, 5u);
}

TEST(MedialVoxelIsosurface, OfNoiseIsClosedWithTwoFacesAtEachSide)
{
  const Index                           size{ 67, 9, 8 };
  std::mt19937                          draw(7);
  std::uniform_real_distribution<float> margin(-1.0f, 1.0f);
  std::vector<float>                    margins(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  std::generate(margins.begin(), margins.end(), [&] { return margin(draw); });
  const Collector surface = Build(size, true, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return margins[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)];
  });
  EXPECT_GT(surface.m_Triangles.size(), 5000u);
  ExpectClosed(surface);
  EXPECT_GT(GetVolume(surface), 0.0);
}

TEST(MedialVoxelIsosurface, OfOneVoxelIsAnOctahedron)
{
  const Collector surface = Build({ 1, 1, 1 }, true, [](auto...) { return 0.5f; });
  EXPECT_EQ(surface.m_Vertices.size(), 6u);
  EXPECT_EQ(surface.m_Triangles.size(), 8u);
  ExpectClosed(surface);
  EXPECT_NEAR(GetVolume(surface), 1.0 / 6.0, 1e-12);
  EXPECT_TRUE(Build({ 1, 1, 1 }, false, [](auto...) { return 0.5f; }).m_Vertices.empty());
}

TEST(MedialVoxelIsosurface, CrossesWhereLinearMarginsDo)
{
  // Of a plane across z, whose margins are zero at 2.3.
  const Collector surface =
    Build({ 4, 4, 6 }, false, [](auto, auto, std::int64_t z) { return static_cast<float>(2.3 - z); });
  EXPECT_EQ(surface.m_Vertices.size(), 16u);
  EXPECT_EQ(surface.m_Triangles.size(), 18u);
  for (const auto & vertex : surface.m_Vertices)
  {
    EXPECT_NEAR(vertex.point[2], 2.3, 1e-6);
    EXPECT_EQ(vertex.object[2], 2);
  }
  for (const auto & triangle : surface.m_Triangles)
  {
    EXPECT_FALSE(triangle.isCap);
  }
}

TEST(MedialVoxelIsosurface, MarginsOfZeroAndNaNKeepVerticesApart)
{
  const float nan = std::nanf("");
  const auto  surface = Build({ 3, 1, 1 }, true, [nan](std::int64_t x, auto, auto) { return x == 1 ? 0.0f : nan; });
  ExpectClosed(surface);
  std::set<std::array<double, 3>> points;
  for (const auto & vertex : surface.m_Vertices)
  {
    points.insert(vertex.point);
  }
  EXPECT_EQ(points.size(), 6u);
  const auto zero = Build({ 3, 1, 1 }, false, [](std::int64_t x, auto, auto) { return x == 1 ? 0.0f : -1.0f; });
  EXPECT_TRUE(zero.m_Triangles.empty());
  EXPECT_EQ(zero.m_Vertices.size(), 2u);
  EXPECT_NEAR(zero.m_Vertices[0].point[0], 1.0 - 1.0 / 256.0, 1e-12);
}

TEST(MedialVoxelWallRay, MeasuresATiltedPlateInUnequalSpacing)
{
  const Index                             size{ 40, 40, 40 };
  const itk::MedialVoxelGrid::SpacingType spacing{ 0.7, 0.7, 1.2 };
  const std::array<double, 3>             normal{ 2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0 };
  itk::MedialVoxelMargins                 margins(size, size[2]);
  for (std::int64_t z = 0; z < size[2]; ++z)
  {
    for (std::int64_t y = 0; y < size[1]; ++y)
    {
      for (std::int64_t x = 0; x < size[0]; ++x)
      {
        const double distance =
          normal[0] * (x - 19.6) * 0.7 + normal[1] * (y - 20.1) * 0.7 + normal[2] * (z - 19.9) * 1.2;
        margins.GetRow(y, z)[x] = static_cast<float>(2.5 - std::abs(distance));
      }
    }
  }
  const itk::MedialVoxelWallRay ray(margins, spacing, 10.0);
  // A point of the surface whose foot on the middle is (19.6, 20.1, 19.9).
  std::array<double, 3> start{ 19.6, 20.1, 19.9 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    start[axis] += 2.5 * normal[axis] / spacing[axis];
  }
  const auto length = ray.Measure(start);
  ASSERT_TRUE(length);
  EXPECT_NEAR(*length, 5.0, 0.01);
  EXPECT_FALSE(itk::MedialVoxelWallRay(margins, spacing, 4.5).Measure(start)) << "longer than the maximum";
  EXPECT_FALSE(ray.Measure({ -0.5, 20.0, 20.0 })) << "outside";
}

TEST(MedialVoxelWallRay, HasNoAnswerWithoutGradientOrOpposite)
{
  const Index             size{ 12, 12, 12 };
  itk::MedialVoxelMargins margins(size, size[2]);
  for (std::int64_t z = 0; z < size[2]; ++z)
  {
    for (std::int64_t y = 0; y < size[1]; ++y)
    {
      std::fill_n(margins.GetRow(y, z), size[0], z < 6 ? -0.5f : 0.5f);
    }
  }
  const itk::MedialVoxelWallRay ray(margins, { 1.0, 1.0, 1.0 }, 50.0);
  EXPECT_FALSE(ray.Measure({ 5.0, 5.0, 5.5 })) << "leaves the image";
  EXPECT_FALSE(ray.Measure({ 5.0, 5.0, 0.0 })) << "all margins around it are equal";
}

} // namespace
