// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Walls of a tile measured on gray values that a window knows in part.

#include "itkMedialVoxelTileWalls.h"

#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestPhantoms.h"

#include "itkMedialVoxelClassifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace
{
using namespace MedialVoxelTest;

using Values = std::function<double(const itk::MedialVoxelIndex &)>;

void
FillGray(const Values & values, const itk::MedialVoxelBox & box, itk::MedialVoxelGray & gray)
{
  gray.Frame(box, box);
  ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
    gray.GetRow(v[1], v[2])[v[0] - box.lower[0]] = static_cast<float>(values(v));
  });
}

constexpr auto FreeSpace = itk::MedialVoxelPseudoGeodesicBound::FreeSpace;

itk::MedialVoxelParameters
OfThickness(const double thickness)
{
  return itk::MedialVoxelParameters::ForThickness(thickness, FreeSpace);
}

/** A tile of a volume whose voxels of at least 50 are the object. */
class Tile
{
public:
  Tile(const Values &                     values,
       const itk::MedialVoxelBox &        box,
       const Index3 &                     size = { { 24, 24, 24 } },
       const Vector3 &                    spacing = { { 1.0, 1.0, 1.0 } },
       const itk::MedialVoxelParameters & parameters = OfThickness(3.0))
    : m_Volume(MakeVolume(size, spacing, [&](const Index3 & v) { return values(KernelIndex(v)) >= 50.0; }))
    , m_Grid(GridOf(m_Volume))
    , m_Object(ObjectBits(m_Volume, m_Grid.GetVoxelBox()))
    , m_Sites(SiteBits(BoundarySites(m_Volume), m_Grid.GetVoxelBox()))
    , m_Classifier(m_Grid, parameters)
  {
    const itk::MedialVoxelWindow                window{ &m_Object, &m_Sites };
    itk::MedialVoxelFeatureTransform::Workspace transform;
    EXPECT_TRUE(
      itk::MedialVoxelFeatureTransform(m_Grid).Compute(window, this->GetImage(), transform, m_Features).IsEmpty());
    itk::MedialVoxelClassifier::Workspace workspace;
    workspace.keepsRows = true;
    std::vector<std::uint8_t>        labels;
    itk::MedialVoxelCounts           counts;
    const itk::MedialVoxelNoProgress progress;
    EXPECT_TRUE(m_Classifier.Classify(window, box, m_Features, progress, workspace, labels, counts).IsEmpty());
    m_Rows = workspace.rows;
    for (itk::MedialVoxelCellRow & row : m_Rows)
    {
      row.measured = row.byBound | row.byGeodesic;
    }
  }

  itk::MedialVoxelBox
  GetImage() const
  {
    return m_Grid.GetVoxelBox();
  }

  std::vector<itk::MedialVoxelWall>
  Measure() const
  {
    std::vector<itk::MedialVoxelWall> walls;
    itk::MedialVoxelThickness::Memory memory;
    itk::MedialVoxelMeasureWalls(
      itk::MedialVoxelThickness(m_Grid), m_Classifier, { &m_Object, &m_Sites }, m_Features, m_Rows, memory, walls);
    return walls;
  }

  /** \return the number of walls, which are compared with what the cells have one by one */
  std::size_t
  CompareWithSingleCells() const
  {
    const itk::MedialVoxelThickness thickness(m_Grid);
    const auto                      walls = this->Measure();
    const auto                      points = this->GetPoints();
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
      const itk::MedialVoxelWall expected = thickness.Measure(m_Object, points[i]);
      EXPECT_EQ(walls[i].thickness, expected.thickness);
      EXPECT_EQ(walls[i].area, expected.area);
      EXPECT_EQ(walls[i].axis, expected.axis);
      EXPECT_EQ(walls[i].isUnpaired, expected.isUnpaired);
    }
    return walls.size();
  }

  itk::MedialVoxelBox
  Refine(const itk::MedialVoxelGray & gray, std::vector<itk::MedialVoxelWall> & walls) const
  {
    itk::MedialVoxelGrayThickness::Workspace workspace;
    return itk::MedialVoxelRefineWalls(this->GetThickness(), m_Classifier, gray, m_Features, m_Rows, workspace, walls);
  }

  itk::MedialVoxelGrayThickness
  GetThickness() const
  {
    return { m_Grid, 50.0, std::numeric_limits<double>::infinity() };
  }

  std::vector<itk::MedialVoxelWallPoints>
  GetPoints() const
  {
    std::vector<itk::MedialVoxelWallPoints> points;
    const auto                              walls = this->Measure();
    itk::MedialVoxelForEachWall(m_Rows, walls, [&](const itk::MedialVoxelIndex & cell, const itk::MedialVoxelWall &) {
      points.emplace_back();
      EXPECT_TRUE(m_Classifier.GetWallPoints(m_Features, cell, points.back()));
    });
    return points;
  }

private:
  Volume                               m_Volume;
  itk::MedialVoxelGrid                 m_Grid;
  itk::MedialVoxelBits                 m_Object;
  itk::MedialVoxelBits                 m_Sites;
  itk::MedialVoxelClassifier           m_Classifier;
  itk::MedialVoxelFeatures             m_Features;
  std::vector<itk::MedialVoxelCellRow> m_Rows;
};

/** Walls of any directions, some behind narrow gaps. */
Values
DrawShells(std::mt19937 & random, const Index3 & size)
{
  struct Shell
  {
    std::array<double, 3> center;
    double                inner;
    double                outer;
  };
  const auto draw = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Shell> shells(random() % 6);
  for (Shell & shell : shells)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      shell.center[axis] = draw(0.0, static_cast<double>(size[axis]));
    }
    shell.inner = draw(0.0, 9.0);
    shell.outer = shell.inner + draw(2.0, 5.0);
  }
  return [shells](const itk::MedialVoxelIndex & v) {
    const bool isObject = std::any_of(shells.begin(), shells.end(), [&v](const Shell & shell) {
      const double distance = std::hypot(static_cast<double>(v[0]) - shell.center[0],
                                         static_cast<double>(v[1]) - shell.center[1],
                                         static_cast<double>(v[2]) - shell.center[2]);
      return distance >= shell.inner && distance < shell.outer;
    });
    return isObject ? 100.0 : 0.0;
  };
}

} // namespace

TEST(MedialVoxelTileWalls, AreThoseOfSingleCells)
{
  std::mt19937 random(11);
  std::size_t  compared = 0;
  for (unsigned int trial = 0; trial < 60; ++trial)
  {
    const Index3               size = trial % 4 == 0 ? Index3{ { 24, 24, 1 } } : Index3{ { 75, 20, 18 } };
    const std::vector<Vector3> spacings{ { { 1.0, 1.0, 1.0 } }, { { 0.5, 0.5, 0.5 } }, { { 1.0, 0.8, 1.3 } } };
    itk::MedialVoxelBox        box;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = static_cast<std::int64_t>(random() % static_cast<unsigned int>(size[axis]));
      box.upper[axis] = box.lower[axis] + 1 +
                        static_cast<std::int64_t>(random() % static_cast<unsigned int>(size[axis] - box.lower[axis]));
    }
    // Cells decided one by one, together, and together with some around the tile.
    const std::vector<itk::MedialVoxelParameters> parameters{
      OfThickness(3.0), OfThickness(9.0), itk::MedialVoxelParameters::ForWalls(3.0, 8.0, FreeSpace)
    };
    const Tile tile(DrawShells(random, size),
                    box,
                    size,
                    spacings[trial % spacings.size()],
                    parameters[trial / 3 % parameters.size()]);
    compared += tile.CompareWithSingleCells();
  }
  EXPECT_GT(compared, 1000u);
}

TEST(MedialVoxelTileWalls, OnGrayValuesAreThoseOfSingleCells)
{
  std::mt19937 random(5);
  const Index3 size{ { 75, 20, 26 } };
  std::size_t  changed = 0;
  for (unsigned int trial = 0; trial < 6; ++trial)
  {
    const Values shells = DrawShells(random, size);
    const Values values = [shells](const itk::MedialVoxelIndex & v) {
      return std::abs(shells(v) - static_cast<double>((7 * v[0] + 5 * v[1] + 3 * v[2]) % 40));
    };
    const Tile           tile(values, MakeBox({ { 0, 0, 0 } }, { { 75, 20, 26 } }), size);
    itk::MedialVoxelGray gray;
    FillGray(values, tile.GetImage(), gray);
    const auto measured = tile.Measure();
    const auto points = tile.GetPoints();
    auto       walls = measured;
    ASSERT_TRUE(tile.Refine(gray, walls).IsEmpty());
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
      itk::MedialVoxelGrayThickness::Workspace workspace;
      itk::MedialVoxelWall                     expected = measured[i];
      tile.GetThickness().Refine(gray, points[i], workspace, expected);
      EXPECT_EQ(walls[i].thickness, expected.thickness);
      EXPECT_EQ(walls[i].area, expected.area);
      changed += walls[i].thickness != measured[i].thickness ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 1000u);
}

TEST(MedialVoxelTileWalls, AsksForGrayValuesThatAreNotKnown)
{
  const Values         plate = [](const itk::MedialVoxelIndex & v) { return v[2] >= 9 && v[2] < 15 ? 100.0 : 0.0; };
  const Tile           tile(plate, MakeBox({ { 8, 8, 8 } }, { { 16, 16, 16 } }));
  itk::MedialVoxelGray gray;
  auto                 expected = tile.Measure();
  const auto           measured = expected;
  ASSERT_GE(measured.size(), 64u);
  FillGray(plate, tile.GetImage(), gray);
  ASSERT_TRUE(tile.Refine(gray, expected).IsEmpty());

  // Not all values around the boundary points of the wall are known here.
  const itk::MedialVoxelBox small = MakeBox({ { 7, 7, 8 } }, { { 17, 17, 16 } });
  FillGray(plate, small, gray);
  auto                      walls = measured;
  const itk::MedialVoxelBox missing = tile.Refine(gray, walls);
  ASSERT_FALSE(missing.IsEmpty());
  EXPECT_TRUE(tile.GetImage().Contains(missing));
  EXPECT_FALSE(small.Contains(missing));
  FillGray(plate, small.Union(missing), gray);
  walls = measured;
  EXPECT_TRUE(tile.Refine(gray, walls).IsEmpty());
  for (std::size_t i = 0; i < walls.size(); ++i)
  {
    EXPECT_EQ(walls[i].thickness, expected[i].thickness);
    EXPECT_EQ(walls[i].area, expected[i].area);
  }
}

TEST(MedialVoxelGrayThickness, BothSidesOfAWedgeCountTheSame)
{
  // Faces at 17 degrees to each other; the values are linear across them.
  const Values wedge = [](const itk::MedialVoxelIndex & v) {
    const double toLower = static_cast<double>(v[2]) - 7.7;
    const double toUpper = (13.0 + 0.3 * static_cast<double>(v[0] - 12) - static_cast<double>(v[2])) / std::sqrt(1.09);
    return 100.0 * std::clamp(0.5 + 0.4 * std::min(toLower, toUpper), 0.0, 1.0);
  };
  const Tile           tile(wedge, MakeBox({ { 6, 6, 6 } }, { { 18, 18, 18 } }));
  const auto           thickness = tile.GetThickness();
  itk::MedialVoxelGray gray;
  FillGray(wedge, tile.GetImage(), gray);
  const auto refined = [&](const itk::MedialVoxelWallPoints & points) {
    itk::MedialVoxelGrayThickness::Workspace workspace;
    itk::MedialVoxelWall                     wall;
    thickness.Refine(gray, points, workspace, wall);
    return wall;
  };
  std::size_t compared = 0;
  for (const itk::MedialVoxelWallPoints & points : tile.GetPoints())
  {
    itk::MedialVoxelWallPoints turned = points;
    std::swap(turned.a, turned.b);
    EXPECT_NEAR(refined(points).thickness, refined(turned).thickness, 1e-4);
    ++compared;
  }
  EXPECT_GT(compared, 64u);
}
