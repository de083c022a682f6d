// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelWallFitting.h"

#include "MedialVoxelTestElements.h"
#include "MedialVoxelTestPhantoms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace MedialVoxelTest;

constexpr double Noise = 0.5;

/** Squares of a height over a lattice of n by n steps. */
template <typename THeight>
itk::MedialVoxelSheet
MakeSheet(const int n, const double step, THeight && height)
{
  itk::MedialVoxelSheet sheet;
  for (int y = 0; y <= n; ++y)
  {
    for (int x = 0; x <= n; ++x)
    {
      sheet.points.push_back({ { x * step, y * step, height(x * step, y * step) } });
      sheet.thickness.push_back(4.0f);
    }
  }
  for (int y = 0; y < n; ++y)
  {
    for (int x = 0; x < n; ++x)
    {
      const auto corner = static_cast<std::uint32_t>(y * (n + 1) + x);
      sheet.AddQuad({ { corner, corner + 1, corner + n + 2, corner + n + 1 } });
    }
  }
  return sheet;
}

/** The nodes where the fine sheet, given in parts, moves them. */
std::vector<Vector3>
Fit(const itk::MedialVoxelRemeshedSheet & coarse, const itk::MedialVoxelSheet & fine, const std::size_t parts)
{
  itk::MedialVoxelWallFitting fitting(coarse, Noise);
  for (std::size_t part = 0; part < parts; ++part)
  {
    itk::MedialVoxelSheet some;
    for (std::size_t k = part; k < fine.points.size(); k += parts)
    {
      some.points.push_back(fine.points[k]);
    }
    fitting.Add(fitting.Measure(some));
  }
  return fitting.FindPlaces(itk::MedialVoxelRunInOrder);
}

/** The steps of voxels on a plane of any slope. */
TEST(MedialVoxelWallFitting, StepsBecomeAPlane)
{
  for (const double slope : { 0.04, 0.1, 0.3 })
  {
    const auto plane = [slope](const double x, const double y) { return slope * x + 0.4 * slope * y + 10.0; };
    const auto fine =
      MakeSheet(60, 1.0, [&](const double x, const double y) { return std::round(plane(x, y) - 0.5) + 0.5; });
    const auto coarse = itk::MedialVoxelRemesh(fine, { 4.0, false, true }, {});
    double     before = 0.0;
    double     after = 0.0;
    const auto off = [&](const Vector3 & point) { return std::abs(point[2] - plane(point[0], point[1])); };
    const auto places = Fit(coarse, fine, 3);
    ASSERT_EQ(places.size(), coarse.points.size());
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      before = std::max(before, off(coarse.points[k]));
      after = std::max(after, off(places[k]));
    }
    EXPECT_GT(before, 0.25) << slope;
    EXPECT_LT(after, 0.12) << slope; // at the corners; they have one side of neighbors only
    const auto isMiddle = [](const Vector3 & point) {
      return std::max(std::abs(point[0] - 30.0), std::abs(point[1] - 30.0)) < 22.0;
    };
    for (const Vector3 & place : places)
    {
      EXPECT_TRUE(!isMiddle(place) || off(place) < 0.05) << slope;
    }
  }
}

/** A cap of a sphere stays one: a plane through its points would be lower by a share of its radius. */
TEST(MedialVoxelWallFitting, RoundWallsStayRound)
{
  constexpr double radius = 40.0;
  const auto       height = [](const double x, const double y) {
    return std::sqrt(radius * radius - (x - 20.0) * (x - 20.0) - (y - 20.0) * (y - 20.0));
  };
  const auto fine = MakeSheet(40, 1.0, height);
  const auto coarse = itk::MedialVoxelRemesh(fine, { 4.0, false, true }, {});
  for (const Vector3 & place : Fit(coarse, fine, 1))
  {
    const double distance = std::hypot(place[0] - 20.0, place[1] - 20.0, place[2]);
    EXPECT_NEAR(distance, radius, 0.1);
  }
}

/** Nodes of a junction move with all walls that meet there: it stays one line, at the middle of both walls. */
TEST(MedialVoxelWallFitting, JunctionsStayTogether)
{
  const itk::MedialVoxelSheet fine = SheetOf(MakeSurface(TeeJunction({ { 48, 30, 40 } }, 6, 4), 5.0));
  auto                        coarse = itk::MedialVoxelRemesh(fine, { 2.0, true, true }, {});
  const auto                  old = FacesOf(coarse).ListMiddles(true);
  coarse.points = Fit(coarse, fine, 1);
  const auto moved = FacesOf(coarse).ListMiddles(true);
  ASSERT_EQ(moved.size(), old.size());
  ASSERT_FALSE(moved.empty());
  EXPECT_LT(LargestGap(moved, old), 2 * Noise);
}

TEST(MedialVoxelWallFitting, DivisionOfThePointsMattersOnlyToTheLastDigits)
{
  const auto fine = MakeSheet(30, 1.0, [](const double x, const double y) { return std::round(0.2 * x + 0.1 * y); });
  const auto coarse = itk::MedialVoxelRemesh(fine, { 3.0, false, true }, {});
  const auto once = Fit(coarse, fine, 1);
  const auto often = Fit(coarse, fine, 5);
  for (std::size_t k = 0; k < once.size(); ++k)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(once[k][axis], often[k][axis], 1e-9);
    }
  }
}

/** A square with a tab of 1 by 6 on a junction's side: its width, area, place and size are known. */
TEST(MedialVoxelWallsLeftOut, AreMeasured)
{
  itk::MedialVoxelSheet sheet = MakeSheet(12, 1.0, [](double, double) { return 0.0; });
  const auto            first = static_cast<std::uint32_t>(sheet.points.size());
  for (std::uint32_t x = 3; x <= 9; ++x)
  {
    sheet.points.push_back({ { double(x), 6.0, 1.0 } });
    sheet.thickness.push_back(4.0f);
  }
  for (std::uint32_t x = 3; x < 9; ++x)
  {
    const std::uint32_t corner = 6 * 13 + x;
    sheet.AddQuad({ { corner, corner + 1, first + x - 2, first + x - 3 } });
  }
  const itk::MedialVoxelFineSheet fine(sheet, { 2.0 });
  ASSERT_EQ(fine.GetNumberOfWalls(), 2u);
  const auto walls = itk::MedialVoxelListWallsLeftOut(sheet, fine.GetWalls(), { true, false }, 2.0);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_NEAR(walls[0].area, 6.0, 1e-12);
  EXPECT_NEAR(walls[0].width, 12.0 / 14.0, 1e-12);
  EXPECT_NEAR(walls[0].elementSize, 4.0, 1e-6);
  EXPECT_NEAR(walls[0].place[0], 6.0, 1e-12);
  EXPECT_NEAR(walls[0].place[2], 0.5, 1e-12);
  EXPECT_EQ(itk::MedialVoxelListWallsLeftOut(sheet, fine.GetWalls(), { true, true }, 2.0).size(), 0u);
}
} // namespace
