// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestElements.h"
#include "MedialVoxelTestPhantoms.h"

#include "itkMedialVoxelNearestWall.h"
#include "itkMedialVoxelSheetWalls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace
{
using namespace MedialVoxelTest;
using Walls = itk::MedialVoxelSheetWalls;
using Set = std::vector<std::uint32_t>;

/** A rectangle of squares from a corner along two directions, one after the other. Points of earlier ones are shared.
 */
void
AddRectangle(itk::MedialVoxelSheet & sheet,
             const Vector3 &         corner,
             const Vector3 &         u,
             int                     nu,
             const Vector3 &         v,
             int                     nv)
{
  const auto pointOf = [&](const int i, const int k) {
    Vector3 point = corner;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] += i * u[axis] + k * v[axis];
    }
    const auto isSame = [&](const Vector3 & other) {
      return std::abs(other[0] - point[0]) + std::abs(other[1] - point[1]) + std::abs(other[2] - point[2]) < 1e-6;
    };
    const auto found = std::find_if(sheet.points.begin(), sheet.points.end(), isSame);
    if (found != sheet.points.end())
    {
      return static_cast<std::uint32_t>(found - sheet.points.begin());
    }
    sheet.points.push_back(point);
    sheet.thickness.push_back(4.0F);
    return static_cast<std::uint32_t>(sheet.points.size() - 1);
  };
  for (int i = 0; i < nu; ++i)
  {
    for (int k = 0; k < nv; ++k)
    {
      sheet.AddQuad({ { pointOf(i, k), pointOf(i + 1, k), pointOf(i + 1, k + 1), pointOf(i, k + 1) } });
    }
  }
}

const Vector3 X{ { 1, 0, 0 } };
const Vector3 Y{ { 0, 1, 0 } };
const Vector3 Z{ { 0, 0, 1 } };

/** Two halves of a plate, and a web that leaves their line at an angle in degrees. */
itk::MedialVoxelSheet
MakeTee(const int height, const double degrees = 90.0)
{
  const double          angle = degrees * std::acos(-1.0) / 180.0;
  itk::MedialVoxelSheet sheet;
  AddRectangle(sheet, { { -20, 0, 0 } }, X, 20, Y, 30);
  AddRectangle(sheet, { { 0, 0, 0 } }, X, 20, Y, 30);
  AddRectangle(sheet, { { 0, 0, 0 } }, { { std::cos(angle), 0, std::sin(angle) } }, height, Y, 30);
  return sheet;
}

void
ExpectNumbers(const Walls & walls, std::size_t number, std::size_t seams)
{
  EXPECT_EQ(walls.walls.size(), number);
  EXPECT_EQ(walls.seams.size(), seams);
  for (std::size_t i = 1; i < walls.walls.size(); ++i)
  {
    EXPECT_GE(walls.walls[i - 1].area, walls.walls[i].area);
  }
}

TEST(MedialVoxelSheetWalls, PlateIsOneWall)
{
  itk::MedialVoxelSheet sheet;
  AddRectangle(sheet, { { 3, 5, 7 } }, X, 30, Z, 20);
  sheet.thickness[5] = 2.0F;
  sheet.thickness[6] = 0.0F; // unknown
  const Walls walls = itk::MedialVoxelFindWalls(sheet);
  ExpectNumbers(walls, 1, 0);
  const auto & wall = walls.walls.front();
  EXPECT_EQ(wall.cells, 31u * 21u);
  EXPECT_EQ(wall.measured, wall.cells - 1);
  EXPECT_NEAR(wall.area, 600.0, 1e-9);
  EXPECT_NEAR(wall.rimLength, 100.0, 1e-9);
  EXPECT_NEAR(wall.flatness, 0.0, 1e-6);
  EXPECT_NEAR(wall.normal[1], 1.0, 1e-9);
  EXPECT_NEAR(wall.centroid[0], 18.0, 1e-9);
  EXPECT_NEAR(wall.centroid[1], 5.0, 1e-9);
  EXPECT_NEAR(wall.centroid[2], 17.0, 1e-9);
  EXPECT_EQ(wall.leastThickness, 2.0);
  EXPECT_EQ(wall.mostThickness, 4.0);
  const auto measured = static_cast<double>(wall.measured);
  EXPECT_NEAR(wall.meanThickness, 4.0 - 2.0 / measured, 1e-9);
  EXPECT_NEAR(wall.spreadOfThickness, 2.0 * std::sqrt(measured - 1.0) / measured, 1e-9);
  EXPECT_TRUE(wall.neighbors.empty());
}

TEST(MedialVoxelSheetWalls, TeeHasThreeWallsAndASeam)
{
  const Walls walls = itk::MedialVoxelFindWalls(MakeTee(15));
  ExpectNumbers(walls, 3, 1);
  EXPECT_EQ(walls.seams[0].walls, (Set{ 1, 2, 3 }));
  EXPECT_NEAR(walls.seams[0].length, 30.0, 1.5);
  ASSERT_EQ(walls.seams[0].angles.size(), 3u);
  EXPECT_NEAR(walls.seams[0].angles[0], 180.0, 5.0); // the halves of the plate are larger than the web
  EXPECT_NEAR(walls.seams[0].angles[1], 90.0, 5.0);
  EXPECT_NEAR(walls.seams[0].angles[2], 90.0, 5.0);
  EXPECT_NEAR(walls.walls[2].area, 450.0, 30.0);
  EXPECT_EQ(walls.walls[2].neighbors, (Set{ 1, 2 }));
  EXPECT_NEAR(walls.walls[2].normal[0], 1.0, 1e-3);

  const Walls slanted = itk::MedialVoxelFindWalls(MakeTee(15, 60.0));
  ExpectNumbers(slanted, 3, 1);
  EXPECT_NEAR(slanted.seams[0].angles[1] + slanted.seams[0].angles[2], 180.0, 10.0);
  EXPECT_NEAR(std::min(slanted.seams[0].angles[1], slanted.seams[0].angles[2]), 60.0, 10.0);
}

TEST(MedialVoxelSheetWalls, SpursCutNoWall)
{
  for (const int height : { 1, 2, 3 })
  {
    ExpectNumbers(itk::MedialVoxelFindWalls(MakeTee(height)), 1, 0);
  }
  for (const int height : { 10, 12 })
  {
    ExpectNumbers(itk::MedialVoxelFindWalls(MakeTee(height)), 3, 1);
  }
}

/** Two plates that turn by an angle. */
TEST(MedialVoxelSheetWalls, SharpBendsAreSeams)
{
  for (const double degrees : { 0.0, 15.0, 30.0, 70.0, 90.0, 110.0 })
  {
    const double          angle = degrees * std::acos(-1.0) / 180.0;
    itk::MedialVoxelSheet sheet;
    AddRectangle(sheet, { { -20, 0, 0 } }, X, 20, Y, 30);
    AddRectangle(sheet, { { 0, 0, 0 } }, { { std::cos(angle), 0, std::sin(angle) } }, 20, Y, 30);
    const Walls walls = itk::MedialVoxelFindWalls(sheet);
    ExpectNumbers(walls, degrees < 45.0 ? 1 : 2, degrees < 45.0 ? 0 : 1);
    for (const auto & seam : walls.seams)
    {
      EXPECT_EQ(seam.walls, (Set{ 1, 2 }));
      EXPECT_NEAR(seam.length, 30.0, 1.5);
      EXPECT_NEAR(seam.angles.at(0), 180.0 - degrees, 10.0);
    }
  }
}

TEST(MedialVoxelSheetWalls, CubeHasTwelveSeams)
{
  itk::MedialVoxelSheet sheet;
  for (const double side : { 0.0, 25.0 })
  {
    AddRectangle(sheet, { { 0, 0, side } }, X, 25, Y, 25);
    AddRectangle(sheet, { { 0, side, 0 } }, X, 25, Z, 25);
    AddRectangle(sheet, { { side, 0, 0 } }, Y, 25, Z, 25);
  }
  const Walls walls = itk::MedialVoxelFindWalls(sheet);
  ExpectNumbers(walls, 6, 12);
  for (const auto & seam : walls.seams)
  {
    EXPECT_EQ(seam.walls.size(), 2u);
    EXPECT_NEAR(seam.length, 25.0, 3.5);
    EXPECT_NEAR(seam.angles.at(0), 90.0, 6.0);
  }
  for (const auto & wall : walls.walls)
  {
    EXPECT_EQ(wall.neighbors.size(), 4u);
    EXPECT_NEAR(wall.area, 625.0, 40.0);
    EXPECT_EQ(wall.rimLength, 0.0);
  }
}

TEST(MedialVoxelSheetWalls, TubeIsOneWall)
{
  for (const double radius : { 8.0, 15.0 })
  {
    itk::MedialVoxelSheet sheet;
    const auto            around = static_cast<std::uint32_t>(6.0 * radius);
    constexpr int         length = 60;
    for (int k = 0; k <= length; ++k)
    {
      for (std::uint32_t i = 0; i < around; ++i)
      {
        const double angle = 2.0 * std::acos(-1.0) * i / around;
        sheet.points.push_back({ { radius * std::cos(angle), radius * std::sin(angle), 1.0 * k } });
        sheet.thickness.push_back(4.0F);
      }
    }
    for (std::uint32_t k = 0; k < length; ++k)
    {
      for (std::uint32_t i = 0; i < around; ++i)
      {
        const std::uint32_t next = (i + 1) % around;
        sheet.AddQuad({ { k * around + i, k * around + next, (k + 1) * around + next, (k + 1) * around + i } });
      }
    }
    const Walls walls = itk::MedialVoxelFindWalls(sheet);
    ExpectNumbers(walls, 1, 0);
    EXPECT_NEAR(walls.walls[0].flatness, radius / std::sqrt(2.0), 0.1);
  }
}

/** Pieces that are too small for a wall have none. */
TEST(MedialVoxelSheetWalls, CrumbsAreNoWalls)
{
  itk::MedialVoxelSheet sheet;
  AddRectangle(sheet, { { 0, 0, 0 } }, X, 20, Y, 20);
  AddRectangle(sheet, { { 40, 0, 0 } }, X, 2, Y, 2);
  AddRectangle(sheet, { { 60, 0, 0 } }, X, 3, Y, 20); // too narrow for a core, but large enough
  sheet.points.push_back({ { 90, 0, 0 } });           // no triangle has it
  sheet.thickness.push_back(4.0F);
  const Walls walls = itk::MedialVoxelFindWalls(sheet);
  ExpectNumbers(walls, 2, 0);
  EXPECT_EQ(walls.wallOf[0], 1u);
  EXPECT_EQ(walls.wallOf[21 * 21], 0u);
  EXPECT_EQ(walls.wallOf[21 * 21 + 9], 2u);
  EXPECT_EQ(walls.wallOf.back(), 0u);
  ExpectNumbers(itk::MedialVoxelFindWalls({}), 0, 0);
}

/** Walls of many voxels are found on coarser nodes, with the same result. */
TEST(MedialVoxelSheetWalls, ScaleChangesNothing)
{
  itk::MedialVoxelSheet sheet;
  AddRectangle(sheet, { { -60, 0, 0 } }, X, 120, Y, 90);
  AddRectangle(sheet, { { 0, 0, 0 } }, Z, 45, Y, 90);
  std::fill(sheet.thickness.begin(), sheet.thickness.end(), 12.0F);
  const Walls walls = itk::MedialVoxelFindWalls(sheet);
  ExpectNumbers(walls, 3, 1);
  EXPECT_NEAR(walls.seams[0].length, 90.0, 3.0);
  EXPECT_NEAR(walls.seams[0].angles[1], 90.0, 5.0);
  EXPECT_NEAR(walls.walls[0].area, 5400.0, 300.0);
}

/** Against a look at all points. */
TEST(MedialVoxelNearestWall, IsThatOfTheFirstNearestPoint)
{
  std::vector<Vector3>       points;
  std::vector<std::uint32_t> walls;
  for (std::uint32_t k = 0; k < 500; ++k)
  {
    const std::uint32_t draw = k * 2654435761u;
    points.push_back({ { draw % 7 * 1.0, draw / 7 % 11 * 1.0, draw / 77 % 13 * 1.0 } }); // some of them twice
    walls.push_back(k % 10);
  }
  const itk::MedialVoxelNearestWall nearest(points, walls);
  for (int k = 0; k < 1000; ++k)
  {
    const Vector3 place{ { k % 15 * 0.5, k / 15 % 23 * 0.5, k / 345 * 0.5 } };
    const auto    first = std::min_element(points.begin(), points.end(), [&](const Vector3 & a, const Vector3 & b) {
      const Vector3 toA = itk::MedialVoxelSubtract(a, place);
      const Vector3 toB = itk::MedialVoxelSubtract(b, place);
      return itk::MedialVoxelDot(toA, toA) < itk::MedialVoxelDot(toB, toB);
    });
    EXPECT_EQ(nearest.Find(place), walls[static_cast<std::size_t>(first - points.begin())]);
  }
  EXPECT_EQ(itk::MedialVoxelNearestWall({}, {}).Find({}), 0u);
}

/** Tasks in any order give the same numbers to the last bit. */
TEST(MedialVoxelSheetWalls, OrderOfTasksChangesNothing)
{
  const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(TeeJunction({ { 48, 30, 40 } }, 6, 4), 5.0));
  const auto                  backwards = [](const std::size_t count, const itk::MedialVoxelTask & task) {
    for (std::size_t number = count; number-- > 0;)
    {
      task(number, [] {});
    }
  };
  const Walls one = itk::MedialVoxelFindWalls(sheet);
  const Walls other = itk::MedialVoxelFindWalls(sheet, backwards);
  ExpectNumbers(one, 3, 1);
  EXPECT_EQ(one.wallOf, other.wallOf);
  ASSERT_EQ(other.seams.size(), 1u);
  EXPECT_EQ(one.seams[0].length, other.seams[0].length);
  EXPECT_EQ(one.seams[0].angles, other.seams[0].angles);
  for (std::size_t i = 0; i < one.walls.size(); ++i)
  {
    EXPECT_EQ(one.walls[i].area, other.walls[i].area);
    EXPECT_EQ(one.walls[i].normal, other.walls[i].normal);
    EXPECT_EQ(one.walls[i].flatness, other.walls[i].flatness);
  }
}

} // namespace
