// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSheetPart.h"

#include "MedialVoxelTestElements.h"
#include "MedialVoxelTestPhantoms.h"
#include "MedialVoxelTestSupport.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
using namespace MedialVoxelTest;

using Index = itk::MedialVoxelSheet::Index;

/** Triangles whose first point is on either side of a plane. */
struct Halves
{
  std::array<std::vector<std::array<Index, 3>>, 2> triangles;
  std::vector<bool>                                isShared;

  Halves(const itk::MedialVoxelSheet & sheet, const Vector3 & normal, const double offset)
    : isShared(sheet.points.size())
  {
    std::vector<unsigned int> users(sheet.points.size());
    for (const auto & corners : sheet.triangles)
    {
      const unsigned int half = Dot(sheet.points[corners[0]], normal) < offset ? 0 : 1;
      triangles[half].push_back(corners);
      for (const Index point : corners)
      {
        users[point] |= 1u << half;
      }
    }
    for (std::size_t point = 0; point < users.size(); ++point)
    {
      isShared[point] = users[point] == 3;
    }
  }
};

/** Both halves, coarsened apart, with their shared points as one. */
Faces
CoarsenHalves(const itk::MedialVoxelSheet & sheet, const Halves & halves)
{
  Faces                  joined;
  std::map<Index, Index> placeOfShared;
  for (const auto & triangles : halves.triangles)
  {
    // Numbers of its own, in another order than those of the sheet.
    itk::MedialVoxelSheet  part;
    std::vector<Index>     numbers;
    std::vector<bool>      isShared;
    std::map<Index, Index> places;
    for (const auto & corners : triangles)
    {
      std::array<Index, 3> own;
      for (unsigned int k = 0; k < 3; ++k)
      {
        const auto [place, isNew] = places.emplace(corners[k], static_cast<Index>(numbers.size()));
        if (isNew)
        {
          numbers.push_back(corners[k]);
          isShared.push_back(halves.isShared[corners[k]]);
          part.points.push_back(sheet.points[corners[k]]);
          part.thickness.push_back(sheet.thickness[corners[k]]);
        }
        own[k] = place->second;
      }
      part.triangles.push_back(own);
    }
    const auto coarsened = itk::MedialVoxelCoarsenPart(part, isShared, { 5.0, true, true }, {});

    std::vector<Index> places2;
    for (std::size_t point = 0; point < coarsened.sheet.points.size(); ++point)
    {
      auto place = static_cast<Index>(joined.points.size());
      EXPECT_EQ(coarsened.sheet.points[point], part.points[coarsened.finePoint[point]]);
      if (isShared[coarsened.finePoint[point]])
      {
        const Index number = numbers[coarsened.finePoint[point]];
        place = placeOfShared.emplace(number, place).first->second;
      }
      if (place == joined.points.size())
      {
        joined.points.push_back(coarsened.sheet.points[point]);
      }
      places2.push_back(place);
    }
    for (const auto & corners : coarsened.sheet.triangles)
    {
      joined.faces.push_back({ places2[corners[0]], places2[corners[1]], places2[corners[2]] });
    }
  }
  return joined;
}

/** The numbers of the sides between points that are given by their places, which may be in other orders. */
std::map<std::pair<Vector3, Vector3>, int>
CountSidesOf(const Faces & faces, const std::set<Vector3> & points)
{
  std::map<std::pair<Vector3, Vector3>, int> found;
  for (const auto & [side, number] : faces.CountSides())
  {
    const Vector3 & a = faces.points[side.first];
    const Vector3 & b = faces.points[side.second];
    if (points.count(a) > 0 && points.count(b) > 0)
    {
      found[std::minmax(a, b)] = number;
    }
  }
  return found;
}

void
ExpectThatPartsFit(const itk::MedialVoxelSheet & sheet, const Vector3 & normal, const double offset)
{
  const Halves halves(sheet, normal, offset);
  const Faces  fine = FacesOf(sheet);
  const double most = 3.0;
  const Faces  coarse = CoarsenHalves(sheet, halves);

  std::set<Vector3> shared;
  for (std::size_t point = 0; point < sheet.points.size(); ++point)
  {
    if (halves.isShared[point])
    {
      shared.insert(sheet.points[point]);
    }
  }
  EXPECT_EQ(CountSidesOf(coarse, shared), CountSidesOf(fine, shared));
  EXPECT_EQ(coarse.GetEulerNumber(), fine.GetEulerNumber());
  std::set<std::set<Index>> distinct;
  for (const auto & face : coarse.faces)
  {
    distinct.emplace(face.begin(), face.end());
  }
  EXPECT_EQ(distinct.size(), coarse.faces.size());
  EXPECT_LT(coarse.faces.size(), fine.faces.size() / 2);
  EXPECT_LE(LargestGap(fine.points, coarse.Sample(0.5)), 1.0);
  EXPECT_LE(LargestGap(coarse.ListMiddles(false), fine.ListMiddles(false)), most);
  EXPECT_LE(LargestGap(coarse.ListMiddles(true), fine.ListMiddles(true)), most);
  EXPECT_EQ(coarse.ListMiddles(true).empty(), fine.ListMiddles(true).empty());
}

TEST(MedialVoxelSheetPart, PartsOfPlatesFit)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> direction(-1.0, 1.0);
  for (const Vector3 & plate : { Vector3{ { 0, 0, 1 } }, Vector3{ { 1, 2, 5 } }, Vector3{ { 0, 1, 1 } } })
  {
    const Volume                volume = TiltedPlate({ { 40, 36, 32 } }, { { 20, 18, 16 } }, plate, 4);
    const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 5.0));
    for (unsigned int round = 0; round < 4; ++round)
    {
      const Vector3 normal{ { direction(random), direction(random), direction(random) } };
      ExpectThatPartsFit(sheet, normal, Dot(normal, { { 20, 18, 16 } }));
    }
  }
}

TEST(MedialVoxelSheetPart, PartsOfJunctionsFit)
{
  const Volume                volume = TeeJunction({ { 48, 30, 40 } }, 6, 4);
  const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 5.0));
  for (const Vector3 & normal : { Vector3{ { 1, 0, 0 } }, Vector3{ { 0, 1, 0 } }, Vector3{ { 1, 1, 1 } } })
  {
    Vector3 middle{};
    for (const Vector3 & point : sheet.points)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        middle[axis] += point[axis] / static_cast<double>(sheet.points.size());
      }
    }
    // Also along the junction, and through it.
    for (const double offset : { -2.0, 0.0, 1.0 })
    {
      ExpectThatPartsFit(sheet, normal, Dot(normal, middle) + offset);
    }
  }
}

/** Lines are left out where that is straight; corners stay where they are. */
TEST(MedialVoxelSheetPart, CornersStay)
{
  const itk::MedialVoxelSheet sheet = FlatSquare(24, 4.0f);
  const auto                  coarsened = itk::MedialVoxelCoarsenPart(sheet, {}, { 10.0, false, true }, {});
  EXPECT_NEAR(FacesOf(coarsened.sheet).GetArea(), 24.0 * 24.0, 1e-9);
  EXPECT_LT(coarsened.sheet.triangles.size(), 24u * 24u / 4u);
  EXPECT_EQ(coarsened.walls, 1u);
  EXPECT_TRUE(coarsened.wallsLeftOut.empty());
}

TEST(MedialVoxelSheetPart, NothingStaysNothing)
{
  const auto part = itk::MedialVoxelCoarsenPart({}, {}, { 2.0, true, true }, {});
  EXPECT_TRUE(part.sheet.triangles.empty());
}
} // namespace
