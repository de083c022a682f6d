// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetQuality.h"

#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace medialvoxel
{
namespace
{

using Corners = std::vector<std::uint64_t>;

/** Two squares side by side, 0 1 2 3 and 1 4 5 2; 6 is on the side between them, 7 at the place of 0. */
const std::vector<itk::MedialVoxelVector3> Points{ { 0, 0, 0 },   { 1, 0, 0 },     { 1, 1, 0 },   { 0, 1, 0 },
                                                   { 2, 0, 0 },   { 2, 1, 0 },     { 1, 0.5, 0 }, { 0, 0, 0 },
                                                   { 3, 0.5, 0 }, { 1.2, 0.5, 0 }, { 4, 0, 0 } };

MeshQuality
Measure(const std::vector<itk::MedialVoxelVector3> & points, const std::vector<Corners> & faces)
{
  MeshSpool               spool(std::filesystem::temp_directory_path(), MeshPrecision::Double);
  std::vector<MeshVertex> vertices;
  std::vector<MeshFace>   elements;
  for (const itk::MedialVoxelVector3 & point : points)
  {
    vertices.push_back({ point, 1.0, 0 });
  }
  for (const Corners & corners : faces)
  {
    elements.push_back(MakeFace(corners));
  }
  spool.AddVertices(vertices);
  spool.AddFaces(elements);
  return MeasureQuality(spool);
}

std::vector<std::string>
FindFailing(const std::vector<Corners> & faces)
{
  std::vector<std::string> names;
  for (const MeshLimit & limit : ListMeshLimits(Measure(Points, faces)))
  {
    if (!limit.Holds())
    {
      names.push_back(limit.name);
    }
  }
  return names;
}

using Names = std::vector<std::string>;

TEST(SheetQuality, CountsOfTwoSquares)
{
  const MeshQuality quality = Measure(Points, { { 0, 1, 2, 3 }, { 1, 4, 5, 2 } });
  EXPECT_EQ(quality.nodes, 6u);
  EXPECT_EQ(quality.quads, 2u);
  EXPECT_EQ(quality.triangles, 0u);
  EXPECT_EQ(quality.rimSides, 6u);
  EXPECT_EQ(quality.junctionSides, 0u);
  EXPECT_EQ(quality.walls, 1u);
  EXPECT_EQ(quality.shapes.leastJacobian, 1.0);
  EXPECT_EQ(quality.shapes.largestAspect, 1.0);
  EXPECT_EQ(FindFailing({ { 0, 1, 2, 3 }, { 1, 4, 5, 2 } }), Names());
}

TEST(SheetQuality, EachLimitFailsAlone)
{
  EXPECT_EQ(FindFailing({ { 0, 1, 2, 3 }, { 2, 1, 0, 3 } }), Names{ "elements with the same nodes" });
  EXPECT_EQ(FindFailing({ { 0, 1, 2 }, { 7, 2, 3 } }), Names{ "nodes at one place" });
  EXPECT_EQ(FindFailing({ { 0, 1, 2, 3 }, { 6, 4, 5 }, { 6, 5, 2 } }), Names{ "hanging nodes" });
  EXPECT_EQ(FindFailing({ { 0, 1, 2, 3 }, { 1, 2, 5, 4 } }), Names{ "walls turned both ways" });
  EXPECT_EQ(FindFailing({ { 1, 9, 2, 8 } }),
            (Names{ "elements without a positive Jacobian", "scaled Jacobian of 99 %" }));
  EXPECT_EQ(
    FindFailing({ { 0, 1, 4, 10 } }),
    (Names{
      "elements without a positive Jacobian", "scaled Jacobian of 99 %", "aspect ratio of 99 %", "hanging nodes" }));
}

TEST(SheetQuality, FlatElementsHaveAnInfiniteAspectRatio)
{
  const MeshQuality quality = Measure(Points, { { 0, 1, 4 }, { 0, 1, 2 } });
  EXPECT_TRUE(std::isinf(quality.shapes.largestAspect));
  EXPECT_EQ(quality.shapes.leastJacobian, 0.0);
  EXPECT_EQ(quality.shapes.notPositive, 1u);
}

TEST(SheetQuality, JunctionsEndWalls)
{
  // A third square stands on the side between two: three walls.
  std::vector<itk::MedialVoxelVector3> points = Points;
  points[6] = { 1, 0, 1 };
  points[7] = { 1, 1, 1 };
  const MeshQuality quality = Measure(points, { { 0, 1, 2, 3 }, { 1, 4, 5, 2 }, { 1, 2, 7, 6 } });
  EXPECT_EQ(quality.junctionSides, 1u);
  EXPECT_EQ(quality.rimSides, 9u);
  EXPECT_EQ(quality.walls, 3u);
  EXPECT_EQ(quality.turnedWalls, 0u);
}

/** A ring of quadrilaterals whose last one joins the first, perhaps after half a turn. */
MeshQuality
MeasureRing(const bool isMoebius)
{
  constexpr std::uint64_t              number = 12;
  std::vector<itk::MedialVoxelVector3> points;
  std::vector<Corners>                 faces;
  for (std::uint64_t k = 0; k < number; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * static_cast<double>(k) / number;
    const double turn = isMoebius ? angle / 2.0 : 0.0;
    for (const double side : { -0.5, 0.5 })
    {
      const double radius = 4.0 + side * std::sin(turn);
      points.push_back({ { radius * std::cos(angle), radius * std::sin(angle), side * std::cos(turn) } });
    }
    const bool          isLast = k + 1 == number;
    const std::uint64_t next = isLast ? 0 : 2 * k + 2;
    const std::uint64_t other = isLast && isMoebius ? 1 : 0;
    faces.push_back({ 2 * k, next + other, next + 1 - other, 2 * k + 1 });
  }
  return Measure(points, faces);
}

TEST(SheetQuality, WallsOfOneSideAreNoFault)
{
  const MeshQuality ring = MeasureRing(false);
  EXPECT_EQ(ring.walls, 1u);
  EXPECT_EQ(ring.oneSidedWalls, 0u);
  EXPECT_EQ(ring.turnedWalls, 0u);
  const MeshQuality moebius = MeasureRing(true);
  EXPECT_EQ(moebius.walls, 1u);
  EXPECT_EQ(moebius.oneSidedWalls, 1u);
  EXPECT_EQ(moebius.turnedWalls, 0u);
}

} // namespace
} // end namespace medialvoxel
