// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestElements.h"
#include "MedialVoxelTestPhantoms.h"
#include "MedialVoxelTestSupport.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

constexpr float Thickness = 4.0F;
constexpr float AtFork = 2.5F;

constexpr double Pi = 3.14159265358979323846;

using PlaceTest = std::function<bool(double x, double y)>;

/** Squares of the plane z = 0 whose middles count, 2 long; points of rims have less thickness, as at a fork. */
itk::MedialVoxelSheet
MakeSheet(int n, const PlaceTest & counts)
{
  itk::MedialVoxelSheet sheet;
  for (int y = 0; y <= n; ++y)
  {
    for (int x = 0; x <= n; ++x)
    {
      sheet.points.push_back({ { 2.0 * x, 2.0 * y, 0.0 } });
    }
  }
  std::vector<int> squares(sheet.points.size());
  for (int y = 0; y < n; ++y)
  {
    for (int x = 0; x < n; ++x)
    {
      const auto corner = static_cast<std::uint32_t>(y * (n + 1) + x);
      if (counts(2.0 * x + 1.0, 2.0 * y + 1.0))
      {
        const std::array<std::uint32_t, 4> corners{ { corner, corner + 1, corner + n + 2, corner + n + 1 } };
        sheet.AddQuad(corners);
        for (const auto point : corners)
        {
          ++squares[point];
        }
      }
    }
  }
  for (const int number : squares)
  {
    sheet.thickness.push_back(number == 4 ? Thickness : AtFork);
  }
  return sheet;
}

bool
Everywhere(double, double)
{
  return true;
}

/** Turned and moved, with a seed. */
itk::MedialVoxelSheet
Placed(itk::MedialVoxelSheet sheet, unsigned int seed)
{
  std::mt19937 generator(seed);
  for (unsigned int turn = 0; turn < 3; ++turn)
  {
    const double angle = static_cast<double>(generator() % 628) / 100.0;
    const auto   i = turn;
    const auto   j = (turn + 1) % 3;
    for (Vector3 & point : sheet.points)
    {
      const double a = point[i];
      point[i] = std::cos(angle) * a - std::sin(angle) * point[j] + 7.0;
      point[j] = std::sin(angle) * a + std::cos(angle) * point[j];
    }
  }
  return sheet;
}

itk::MedialVoxelRimExtensionSummary
Extend(itk::MedialVoxelSheet &                sheet,
       const itk::MedialVoxelMeasureRimRays & measure = {},
       const itk::MedialVoxelRimLimits &      limits = {})
{
  const std::size_t          before = sheet.points.size();
  std::vector<std::uint32_t> origins;
  const auto summary = itk::MedialVoxelExtendRims(sheet, measure, limits, origins, itk::MedialVoxelRunInOrder);
  EXPECT_EQ(origins.size(), sheet.points.size());
  EXPECT_EQ(sheet.thickness.size(), sheet.points.size());
  for (std::size_t point = 0; point < origins.size(); ++point)
  {
    EXPECT_LT(origins[point], before);
  }
  return summary;
}

/** Rays to the faces of a box. */
itk::MedialVoxelMeasureRimRays
ToBox(const Vector3 & low, const Vector3 & high)
{
  return [=](const itk::MedialVoxelRimRays & rays) {
    std::vector<double> lengths;
    for (const Vector3 & start : rays.starts)
    {
      double length = std::numeric_limits<double>::infinity();
      for (int axis = 0; axis < 3; ++axis)
      {
        const double step = rays.direction[axis];
        if (std::abs(step) > 1e-9)
        {
          length = std::min(length, ((step > 0 ? high : low)[axis] - start[axis]) / step);
        }
      }
      lengths.push_back(length <= rays.most ? length : std::numeric_limits<double>::infinity());
    }
    return lengths;
  };
}

TEST(MedialVoxelRimExtension, RimsStopAtTheFacesOfTheVolume)
{
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    itk::MedialVoxelSheet sheet = Placed(MakeSheet(15, Everywhere), seed);
    // Across the tilted plate, a little beyond what it has.
    for (const double left : { 0.0, 0.2, 0.7 })
    {
      itk::MedialVoxelSheet     grown = sheet;
      itk::MedialVoxelRimLimits limits;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        for (const double sign : { -1.0, 1.0 })
        {
          itk::MedialVoxelRimLimit face;
          face.normal[axis] = 2.0 * sign;
          face.limit = -1e9;
          for (const Vector3 & point : sheet.points)
          {
            face.limit = std::max(face.limit, 2.0 * (sign * point[axis] + left));
          }
          limits.push_back(face);
        }
      }
      Extend(grown, {}, limits);
      EXPECT_GT(grown.points.size(), sheet.points.size());
      for (const Vector3 & point : grown.points)
      {
        for (const itk::MedialVoxelRimLimit & face : limits)
        {
          const double way = face.normal[0] * point[0] + face.normal[1] * point[1] + face.normal[2] * point[2];
          EXPECT_LE(way, face.limit + 1e-9);
        }
      }
    }
  }
}

TEST(MedialVoxelRimExtension, PlatesGrowByHalfTheirThicknessAtAnyTilt)
{
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    itk::MedialVoxelSheet sheet = Placed(MakeSheet(15, Everywhere), seed);
    const long            euler = FacesOf(sheet).GetEulerNumber();
    const auto            summary = Extend(sheet);
    const double          side = 30.0 + Thickness;
    EXPECT_NEAR(FacesOf(sheet).GetArea(), side * side, 0.1);
    EXPECT_NEAR(summary.area, side * side - 30.0 * 30.0, 0.1);
    EXPECT_NEAR(summary.length, Thickness / 2, 0.01);
    EXPECT_EQ(summary.cutBack, 0u);
    EXPECT_EQ(summary.points, 60u);
    EXPECT_EQ(FacesOf(sheet).GetEulerNumber(), euler);
    for (const float thickness : sheet.thickness)
    {
      EXPECT_FLOAT_EQ(thickness, Thickness); // of the wall, not of the fork
    }
  }
}

TEST(MedialVoxelRimExtension, RaysDecideAndMissingOnesDoNot)
{
  itk::MedialVoxelSheet sheet = MakeSheet(15, Everywhere);
  const auto            summary = Extend(sheet, ToBox({ { -1.5, -2.5, -9 } }, { { 33.0, 99.0, 9 } }));
  EXPECT_NEAR(FacesOf(sheet).GetArea(), (33.0 + 1.5) * (30.0 + Thickness / 2 + 2.5), 0.5);
  EXPECT_EQ(summary.withoutSurface, 15u);
}

TEST(MedialVoxelRimExtension, CutCornersComeBack)
{
  // The sheet lacks a corner; its edges meet where those of the part do.
  itk::MedialVoxelSheet sheet = MakeSheet(15, Everywhere);
  sheet.triangles.erase(
    std::remove_if(sheet.triangles.begin(),
                   sheet.triangles.end(),
                   [](const auto & triangle) { return std::count(triangle.begin(), triangle.end(), 0u) > 0; }),
    sheet.triangles.end());
  sheet.triangles.push_back({ { 1, 17, 16 } });
  Extend(sheet, ToBox({ { -2, -2, -9 } }, { { 32, 32, 9 } }));
  EXPECT_NEAR(FacesOf(sheet).GetArea(), 34.0 * 34.0, 0.1);
  EXPECT_LE(LargestGap({ { { -2, -2, 0 } } }, sheet.points), 0.01);
}

TEST(MedialVoxelRimExtension, RoundRimsGrowAndHolesShrink)
{
  // Rings of triangles round the origin.
  const auto ring = [](double inner, double outer) {
    itk::MedialVoxelSheet   sheet;
    constexpr std::uint32_t n = 60;
    for (std::uint32_t k = 0; k < 3 * n; ++k)
    {
      const double radius = inner + (outer - inner) * (k / n) / 2.0;
      const double angle = 2.0 * Pi * (k % n) / n;
      sheet.points.push_back({ { radius * std::cos(angle), radius * std::sin(angle), 1.0 } });
      sheet.thickness.push_back(k / n == 1 ? Thickness : AtFork);
    }
    for (std::uint32_t k = 0; k < 2 * n; ++k)
    {
      const std::uint32_t next = k % n == n - 1 ? k + 1 - n : k + 1;
      sheet.AddQuad({ { k, next, next + n, k + n } });
    }
    return sheet;
  };
  for (const double inner : { 3.0, 8.0 })
  {
    itk::MedialVoxelSheet sheet = ring(inner, 20.0);
    const auto            summary = Extend(sheet);
    const double          half = Thickness / 2;
    EXPECT_NEAR(FacesOf(sheet).GetArea() / (Pi * (std::pow(20.0 + half, 2) - std::pow(inner - half, 2))), 1.0, 0.01);
    EXPECT_EQ(summary.cutBack, 0u);
  }
}

TEST(MedialVoxelRimExtension, WallsAtAJunctionStayTogether)
{
  // Three half planes meet at the x axis, and end at x = 0 and 30.
  itk::MedialVoxelSheet sheet = MakeSheet(15, Everywhere);
  const auto            flat = static_cast<std::uint32_t>(sheet.points.size());
  for (std::uint32_t point = 0; point < flat; ++point)
  {
    sheet.thickness[point] = Thickness;
  }
  const auto add = [&](const Vector3 & direction) {
    const auto offset = static_cast<std::uint32_t>(sheet.points.size());
    for (std::uint32_t point = 0; point < flat; ++point)
    {
      const Vector3 place = sheet.points[point];
      sheet.points.push_back({ { place[0], direction[1] * place[1], direction[2] * place[1] } });
      sheet.thickness.push_back(Thickness);
    }
    const std::size_t number = 15 * 15 * 2;
    for (std::size_t k = 0; k < number; ++k)
    {
      auto triangle = sheet.triangles[k];
      for (auto & point : triangle)
      {
        point = point < 16 ? point : point + offset;
      }
      sheet.triangles.push_back(triangle);
    }
  };
  add({ { 1, -1, 0 } });
  add({ { 1, 0, 1 } });
  const double before = FacesOf(sheet).GetArea();
  const auto   summary = Extend(sheet);
  EXPECT_NEAR(before, 3 * 900.0, 1e-6);
  EXPECT_NEAR(FacesOf(sheet).GetArea(), 3 * 34.0 * 32.0, 1.0);
  EXPECT_EQ(summary.cutBack, 0u);
  // The junction goes on to both ends, with all three walls.
  const auto middles = FacesOf(sheet).ListMiddles(true);
  EXPECT_EQ(middles.size(), 17u);
  EXPECT_LE(LargestGap({ { { -1, 0, 0 } }, { { 31, 0, 0 } } }, middles), 0.05);
}

TEST(MedialVoxelRimExtension, StripsStopBeforeOtherRimsAndWalls)
{
  for (const double gap : { 0.5, 1.0, 2.0, 3.0, 6.0 })
  {
    // Two sheets end opposite to each other.
    itk::MedialVoxelSheet sheet = MakeSheet(8, Everywhere);
    const auto            first = static_cast<std::uint32_t>(sheet.points.size());
    const std::size_t     triangles = sheet.triangles.size();
    for (std::uint32_t point = 0; point < first; ++point)
    {
      sheet.points.push_back({ { 16.0 + gap + sheet.points[point][0], sheet.points[point][1], 0.0 } });
      sheet.thickness.push_back(sheet.thickness[point]);
    }
    for (std::size_t k = 0; k < triangles; ++k)
    {
      const auto & corners = sheet.triangles[k];
      sheet.triangles.push_back({ { corners[0] + first, corners[1] + first, corners[2] + first } });
    }
    const auto summary = Extend(sheet);
    double     left = -1e9;
    double     right = 1e9;
    for (const auto & face : FacesOf(sheet).faces)
    {
      const double x = (sheet.points[face[0]][0] + sheet.points[face[1]][0] + sheet.points[face[2]][0]) / 3;
      for (const auto point : face)
      {
        (x < 16.0 + gap / 2 ? left : right) =
          x < 16.0 + gap / 2 ? std::max(left, sheet.points[point][0]) : std::min(right, sheet.points[point][0]);
      }
    }
    EXPECT_GE(right - left, std::min(gap, 0.1 * Thickness));
    EXPECT_EQ(summary.cutBack > 0, gap < 1.2 * Thickness);
    EXPECT_GE(left, 16.0);
    EXPECT_LE(left, 16.0 + gap / 2);
  }
}

/** A wall stands before a rim, but for a gap: what is added there is a slope on one side at least. */
TEST(MedialVoxelRimExtension, GapsMakeNoSpikes)
{
  itk::MedialVoxelSheet sheet = MakeSheet(15, Everywhere);
  for (const auto & [begin, end] : { std::pair(-2.0, 12.5), std::pair(15.5, 32.0) })
  {
    const auto first = static_cast<std::uint32_t>(sheet.points.size());
    for (const double z : { -3.0, 3.0 })
    {
      sheet.points.push_back({ { begin, -1.0, z } });
      sheet.points.push_back({ { end, -1.0, z } });
    }
    sheet.AddQuad({ { first, first + 1, first + 3, first + 2 } });
  }
  sheet.thickness.resize(sheet.points.size(), std::numeric_limits<float>::quiet_NaN()); // of that wall
  std::vector<std::uint32_t> origins;
  const auto                 summary = itk::MedialVoxelExtendRims(sheet, {}, {}, origins, itk::MedialVoxelRunInOrder);
  EXPECT_GT(summary.cutBack, 0u);
  std::array<double, 16> added{};
  for (std::size_t point = 0; point < origins.size(); ++point)
  {
    if (origins[point] < added.size())
    {
      added[origins[point]] = std::max(added[origins[point]], -sheet.points[point][1]);
    }
  }
  EXPECT_GT(*std::max_element(added.begin(), added.end()), 1.0);
  for (std::size_t point = 2; point + 2 < added.size(); ++point)
  {
    const auto getMost = [&](const std::ptrdiff_t step) {
      double most = added[point];
      for (auto k = static_cast<std::ptrdiff_t>(point) + step, n = std::ptrdiff_t{ 1 }; k > 0 && k < 15; k += step, ++n)
      {
        most = std::min(most, added[static_cast<std::size_t>(k)] + 0.6 * 2.0 * static_cast<double>(n));
      }
      return most;
    };
    EXPECT_LE(added[point], std::max(getMost(-1), getMost(1)) + 1e-5);
  }
}

TEST(MedialVoxelRimExtension, UnknownThicknessAddsNothing)
{
  itk::MedialVoxelSheet sheet = MakeSheet(5, Everywhere);
  std::fill(sheet.thickness.begin(), sheet.thickness.end(), std::numeric_limits<float>::quiet_NaN());
  const auto triangles = sheet.triangles;
  Extend(sheet);
  EXPECT_EQ(sheet.triangles, triangles);
  itk::MedialVoxelSheet nothing;
  EXPECT_EQ(Extend(nothing).points, 0u);
}

itk::MedialVoxelElementSize
WithRims(const itk::MedialVoxelMeasureRimRays & measure)
{
  itk::MedialVoxelElementSize size;
  size.least = 2.0;
  size.atThickness = true;
  size.extendsRims = true;
  size.measureRimRays = measure;
  return size;
}

TEST(MedialVoxelRimExtension, PlateOfVoxelsHasItsSizeAgain)
{
  for (const int thickness : { 3, 4, 6 })
  {
    const Volume                volume = MakeVolume({ { 56, 40, 14 } }, UnitSpacing, [&](const Index3 & v) {
      return v[0] >= 4 && v[0] < 52 && v[1] >= 5 && v[1] < 35 && v[2] >= 4 && v[2] < 4 + thickness;
    });
    const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, thickness + 1.0));
    const auto                  measure = ToBox({ { 3.5, 4.5, 3.5 } }, { { 51.5, 34.5, 3.5 + thickness } });
    const auto                  result = itk::MedialVoxelRemesh(sheet, WithRims(measure), {});
    const Faces                 faces = FacesOf(result);
    EXPECT_NEAR(faces.GetArea() / (48.0 * 30.0), 1.0, 0.01);
    ASSERT_TRUE(result.summary.rims.has_value());
    EXPECT_GT(result.summary.rims->length, 0.3 * thickness);
    EXPECT_EQ(faces.GetEulerNumber(), 1);
    EXPECT_GT(SinesOf(faces).front(), 0.3);
    for (const double value : result.thickness)
    {
      EXPECT_NEAR(value, thickness, 0.1);
    }
    const auto again = itk::MedialVoxelRemesh(sheet, WithRims(measure), {});
    EXPECT_EQ(result.points, again.points);
    EXPECT_EQ(faces.faces, FacesOf(again).faces);
  }
}

TEST(MedialVoxelRimExtension, TeeEndsAtItsFaces)
{
  const Volume                volume = TeeJunction({ { 48, 30, 40 } }, 6, 4);
  const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 5.0));
  const auto                  result = itk::MedialVoxelRemesh(sheet, WithRims({}), {});
  const Faces                 faces = FacesOf(result);
  EXPECT_FALSE(faces.ListMiddles(true).empty());
  EXPECT_EQ(faces.GetEulerNumber(), FacesOf(sheet).GetEulerNumber());
  EXPECT_GT(SinesOf(faces).front(), 0.2);
  EXPECT_GT(faces.GetArea(), FacesOf(sheet).GetArea());
}
} // namespace
