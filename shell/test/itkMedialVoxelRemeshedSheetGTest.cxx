// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestElements.h"
#include "MedialVoxelTestPhantoms.h"
#include "MedialVoxelTestSupport.h"

#include "itkMedialVoxelElementQuality.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

constexpr double SampleStep = 0.5;

itk::MedialVoxelRemeshedSheet
Remesh(const itk::MedialVoxelSheet & sheet, const itk::MedialVoxelElementSize & size)
{
  return itk::MedialVoxelRemesh(sheet, size, {});
}

/** No face twice, no point twice, marks as the sides are, and walls turned one way but for the conflicts. */
void
ExpectSound(const itk::MedialVoxelRemeshedSheet & result)
{
  const Faces                  faces = FacesOf(result);
  std::set<std::set<unsigned>> distinct;
  for (const auto & face : faces.faces)
  {
    distinct.emplace(face.begin(), face.end());
    EXPECT_EQ(distinct.size(), static_cast<std::size_t>(&face - faces.faces.data()) + 1);
  }
  EXPECT_EQ(std::set<Vector3>(faces.points.begin(), faces.points.end()).size(), faces.points.size());

  const auto                                   sides = faces.CountSides();
  std::map<std::pair<unsigned, unsigned>, int> directed;
  for (const auto & element : result.elements)
  {
    for (unsigned int k = 0; k < element.numberOfCorners; ++k)
    {
      const auto a = element.corners[k];
      const auto b = element.corners[(k + 1) % element.numberOfCorners];
      const int  number = sides.at(std::minmax(a, b));
      EXPECT_EQ(element.rimSides >> k & 1, number == 1 ? 1 : 0);
      EXPECT_EQ(element.junctionSides >> k & 1, number > 2 ? 1 : 0);
      directed[{ a, b }] += number == 2 ? 1 : 0;
    }
  }
  std::uint64_t conflicts = 0;
  for (const auto & entry : directed)
  {
    conflicts += entry.second == 2 ? 1 : 0;
  }
  EXPECT_LE(conflicts, result.summary.orientationConflicts);
}

/** Shapes that solvers take. */
void
ExpectGoodShapes(const Faces & faces)
{
  const std::vector<double> sines = SinesOf(faces);
  ASSERT_FALSE(sines.empty());
  EXPECT_GT(sines.front(), 0.05);
  EXPECT_GE(sines[sines.size() / 100], 0.26); // a scaled Jacobian of 0.3 of a triangle
}

/** The same topology, lines and places, within a distance. */
void
ExpectNear(const itk::MedialVoxelSheet & sheet, const itk::MedialVoxelRemeshedSheet & result, double distance)
{
  const Faces fine = FacesOf(sheet);
  const Faces coarse = FacesOf(result);
  EXPECT_EQ(coarse.GetEulerNumber(),
            fine.GetEulerNumber() + static_cast<long>(result.summary.holesClosed)); // a lid has 1
  EXPECT_LE(LargestGap(fine.points, coarse.Sample(SampleStep)), distance + SampleStep);
  EXPECT_LE(LargestGap(coarse.Sample(4 * SampleStep), fine.points), distance + 1.0);
  // No crack: a free side of the result is one of the sheet.
  EXPECT_LE(LargestGap(coarse.ListMiddles(false), fine.ListMiddles(false)), distance + 1.0);
  EXPECT_LE(LargestGap(coarse.ListMiddles(true), fine.ListMiddles(true)), distance + 1.0);
  EXPECT_EQ(coarse.ListMiddles(true).empty(), fine.ListMiddles(true).empty());
}

TEST(MedialVoxelRemeshedSheet, PlatesAtAnyTilt)
{
  for (const Vector3 & normal : { Vector3{ { 0, 0, 1 } },
                                  Vector3{ { 0, 0.2588, 0.9659 } },
                                  Vector3{ { 1, 2, 5 } },
                                  Vector3{ { 1, 1, 1 } },
                                  Vector3{ { 0, 1, 1 } } })
  {
    const Volume                volume = TiltedPlate({ { 40, 36, 32 } }, { { 20, 18, 16 } }, normal, 4);
    const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 5.0));
    ASSERT_FALSE(sheet.triangles.empty());
    for (const double size : { 3.0, 5.0 })
    {
      const auto result = Remesh(sheet, { size, false, true });
      ExpectSound(result);
      ExpectGoodShapes(FacesOf(result));
      ExpectNear(sheet, result, 0.3 * size);
      EXPECT_NEAR(FacesOf(result).GetArea() / FacesOf(sheet).GetArea(), 1.0, 0.03);
      EXPECT_LT(result.elements.size(), sheet.triangles.size() / (size * size) * 1.5);
      EXPECT_EQ(result.summary.orientationConflicts, 0u);
    }
  }
}

TEST(MedialVoxelRemeshedSheet, JunctionsConform)
{
  for (const int thickness : { 3, 4, 6 })
  {
    const Volume                volume = TeeJunction({ { 48, 30, 40 } }, 6, thickness);
    const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, thickness + 1.0));
    const auto                  result = Remesh(sheet, { 2.0, true, true });
    ExpectSound(result);
    ExpectGoodShapes(FacesOf(result));
    ExpectNear(sheet, result, 0.3 * thickness);
    EXPECT_FALSE(FacesOf(result).ListMiddles(true).empty());
    EXPECT_NEAR(FacesOf(result).GetArea() / FacesOf(sheet).GetArea(), 1.0, 0.04);
  }
}

TEST(MedialVoxelRemeshedSheet, ClosedBoxStaysClosed)
{
  const Index3                size{ { 36, 32, 30 } };
  const Volume                volume = MakeVolume(size, UnitSpacing, [&](const Index3 & v) {
    int inside = 1000;
    for (int axis = 0; axis < 3; ++axis)
    {
      inside = std::min({ inside, v[axis] - 3, size[axis] - 4 - v[axis] });
    }
    return inside >= 0 && inside < 4;
  });
  const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 5.0));
  const auto                  result = Remesh(sheet, { 3.0, true, true });
  ExpectSound(result);
  ExpectNear(sheet, result, 1.5);
  EXPECT_TRUE(FacesOf(result).ListMiddles(false).empty());
  EXPECT_EQ(FacesOf(result).GetEulerNumber(), 2);
  EXPECT_NEAR(FacesOf(result).GetArea() / FacesOf(sheet).GetArea(), 1.0, 0.03);
}

TEST(MedialVoxelRemeshedSheet, RealCrops)
{
  const std::string path = RealDataPath("engine.mha");
  MEDIALVOXEL_SKIP_WITHOUT(path, "engine.mha");
  const Volume engine = VolumeOf(ReadImage<itk::Image<short, 3>>(path).GetPointer(), 72.0);
  for (const Index3 & low : { Index3{ { 60, 140, 20 } }, Index3{ { 110, 60, 40 } } })
  {
    const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(Cropped(engine, low, { { 64, 64, 56 } }), 24.0));
    ASSERT_FALSE(sheet.triangles.empty());
    const auto result = Remesh(sheet, { 2.0, true, true });
    ExpectSound(result);
    ExpectGoodShapes(FacesOf(result));
    itk::MedialVoxelElementShapes shapes;
    for (const auto & element : result.elements)
    {
      shapes.Add(result.points, element.corners, element.numberOfCorners);
    }
    EXPECT_EQ(shapes.Summarize().notPositive, 0u);
    if (result.summary.trianglesLeftOut == 0)
    {
      EXPECT_EQ(FacesOf(result).GetEulerNumber(),
                FacesOf(sheet).GetEulerNumber() + static_cast<long>(result.summary.holesClosed));
    }
  }
}

TEST(MedialVoxelRemeshedSheet, TrianglesStayWhenTheyAreNotJoined)
{
  const Volume                volume = TiltedPlate({ { 30, 30, 24 } }, { { 15, 15, 12 } }, { { 1, 2, 5 } }, 4);
  const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 5.0));
  const auto                  result = Remesh(sheet, { 4.0, false, false });
  for (const auto & element : result.elements)
  {
    EXPECT_EQ(element.numberOfCorners, 3);
  }
  ExpectSound(result);
}

TEST(MedialVoxelRemeshedSheet, RepeatsItself)
{
  const Volume                volume = TeeJunction({ { 40, 24, 32 } }, 6, 4);
  const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 5.0));
  const auto                  first = Remesh(sheet, { 2.0, true, true });
  const auto                  second = Remesh(sheet, { 2.0, true, true });
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(FacesOf(first).faces, FacesOf(second).faces);
}

TEST(MedialVoxelRemeshedSheet, OrderOfPartsDoesNotMatter)
{
  const itk::MedialVoxelSheet       sheet = FlatSquare(140, 4.0f);
  const itk::MedialVoxelElementSize size{ 5.0, false, true };
  const auto                        first = Remesh(sheet, size);
  std::size_t                       mostParts = 0;
  const auto                        second =
    itk::MedialVoxelRemesh(sheet, size, {}, [&](const std::size_t count, const itk::MedialVoxelTask & task) {
      mostParts = std::max(mostParts, count);
      for (std::size_t number = count; number-- > 0;)
      {
        task(number, [] {});
      }
    });
  EXPECT_GT(mostParts, 2u);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(FacesOf(first).faces, FacesOf(second).faces);
  ExpectSound(first);
  ExpectGoodShapes(FacesOf(first));
  EXPECT_NEAR(FacesOf(first).GetArea(), 140.0 * 140.0, 20.0);
}

TEST(MedialVoxelRemeshedSheet, SmallHolesAreClosedAndLargeOnesStay)
{
  for (const double radius : { 1.0, 14.0 })
  {
    // A square with a hole, with elements as long as its wall is thick.
    const itk::MedialVoxelSheet sheet =
      FlatSquare(50, 4.0f, [&](int x, int y) { return std::hypot(x - 24.5, y - 24.5) > radius; });
    const auto result = Remesh(sheet, { 3.0, true, true });
    EXPECT_EQ(result.summary.holesClosed, radius < 2 ? 1u : 0u);
    EXPECT_EQ(FacesOf(result).GetEulerNumber(), radius < 2 ? 1 : 0);
    ExpectSound(result);
    // Each point is near one that was given, also in the lid of a hole.
    for (std::size_t k = 0; k < result.points.size(); ++k)
    {
      ASSERT_LT(result.finePoint[k], sheet.points.size());
    }
  }
}

/** A pocket that is as small as triangles are has three of them on one; it is closed. */
TEST(MedialVoxelRemeshedSheet, PocketsAreClosed)
{
  itk::MedialVoxelSheet sheet = FlatSquare(20, 4.0f);
  const auto            apex = static_cast<std::uint32_t>(sheet.points.size());
  const auto            base = sheet.triangles[sheet.triangles.size() / 2 + 20];
  sheet.points.push_back(sheet.points[base[0]]);
  sheet.points.back()[2] += 0.5;
  sheet.thickness.push_back(4.0f);
  for (unsigned int k = 0; k < 3; ++k)
  {
    sheet.triangles.push_back({ { base[k], base[(k + 1) % 3], apex } });
  }
  const auto result = Remesh(sheet, { 4.0, false, true });
  ExpectSound(result);
  ExpectGoodShapes(FacesOf(result));
  EXPECT_EQ(FacesOf(result).GetEulerNumber(), 1);
  EXPECT_TRUE(FacesOf(result).ListMiddles(true).empty());
}

/** Two rims at one place, with points at different places, as a long slit has them that is narrower than any element.
 */
TEST(MedialVoxelRemeshedSheet, SlitsAreZipped)
{
  itk::MedialVoxelSheet sheet;
  const auto            addStrip = [&](const int first, const int last, const double step) {
    const auto start = static_cast<std::uint32_t>(sheet.points.size());
    const auto columns = static_cast<std::uint32_t>(std::lround(36.0 / step));
    for (int y = first; y <= last; ++y)
    {
      for (std::uint32_t x = 0; x <= columns; ++x)
      {
        sheet.points.push_back({ { x * step, static_cast<double>(y), 0.0 } });
        sheet.thickness.push_back(4.0f);
      }
    }
    for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(last - first); ++y)
    {
      for (std::uint32_t x = 0; x < columns; ++x)
      {
        const std::uint32_t corner = start + y * (columns + 1) + x;
        sheet.AddQuad({ { corner, corner + 1, corner + columns + 2, corner + columns + 1 } });
      }
    }
  };
  addStrip(0, 12, 1.0);
  addStrip(12, 30, 0.75);
  const auto result = Remesh(sheet, { 4.0, false, true });
  ExpectSound(result);
  const Faces faces = FacesOf(result);
  EXPECT_EQ(faces.GetEulerNumber(), 1); // one square, where there were two
  for (const Vector3 & middle : faces.ListMiddles(false))
  {
    // Corners are cut by a part of an element.
    EXPECT_TRUE(middle[0] < 3.0 || middle[0] > 33.0 || middle[1] < 3.0 || middle[1] > 27.0)
      << middle[0] << ' ' << middle[1];
  }
}

TEST(MedialVoxelRemeshedSheet, NothingStaysNothing)
{
  const auto result = Remesh({}, { 3.0, true, true });
  EXPECT_TRUE(result.elements.empty());
  EXPECT_TRUE(result.points.empty());
}
} // namespace
