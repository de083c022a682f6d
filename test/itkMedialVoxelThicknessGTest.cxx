// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelThickness.h"

#include "MedialVoxelTestTiltedPlates.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
using namespace MedialVoxelTest;

bool
Everywhere(const itk::MedialVoxelIndex &)
{
  return true;
}
} // namespace

TEST(MedialVoxelThickness, PlatesAlongAnAxisAreExactUpToTheFacesOfTheImage)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int thickness = 1; thickness <= 8; ++thickness)
    {
      for (const double unit : { 1.0, 0.25 })
      {
        const Volume      volume = AxisPlate({ { 14, 14, 14 } }, { { unit, unit, unit } }, axis, 3, thickness);
        const Measurement measured(volume, 3.0 * unit, Everywhere);
        EXPECT_EQ(measured.GetValues().size(), 13u * 13u);
        for (const double value : measured.GetValues())
        {
          EXPECT_EQ(value, thickness * unit) << axis;
        }
      }
    }
  }
}

TEST(MedialVoxelThickness, PlatesWhoseBoundaryIsAtTheFaceOfTheImageAreExact)
{
  const Volume      volume = AxisPlate({ { 12, 12, 6 } }, UnitSpacing, 2, 1, 4);
  const Measurement measured(volume, 3.0, Everywhere);
  ASSERT_EQ(measured.GetValues().size(), 11u * 11u);
  for (const double value : measured.GetValues())
  {
    EXPECT_EQ(value, 4.0);
  }
}

TEST(MedialVoxelThickness, UnequalSpacingIsMeasuredInItsUnits)
{
  const Vector3 spacing{ { 0.5, 0.75, 1.5 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int thickness = 1; thickness <= 4; ++thickness)
    {
      const Volume      volume = AxisPlate({ { 16, 15, 14 } }, spacing, axis, 4, thickness);
      const Measurement measured(volume, 1.5, Everywhere);
      ASSERT_FALSE(measured.GetValues().empty());
      for (const double value : measured.GetValues())
      {
        EXPECT_NEAR(value, thickness * spacing[axis], 1e-6) << axis;
      }
    }
  }
}

TEST(MedialVoxelThickness, LinesInThePlaneAreExact)
{
  for (int axis = 0; axis < 2; ++axis)
  {
    const Volume      volume = AxisPlate({ { 20, 20, 1 } }, UnitSpacing, axis, 6, 5);
    const Measurement measured(volume, 3.0, Everywhere);
    ASSERT_EQ(measured.GetValues().size(), 19u);
    for (const double value : measured.GetValues())
    {
      EXPECT_EQ(value, 5.0);
    }
  }
}

TEST(MedialVoxelThickness, WallsBesideNarrowGapsAreExactAlongAnAxis)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int thickness : { 1, 2, 4, 8 })
    {
      for (const int gap : { 1, 2 })
      {
        for (const bool onBothSides : { false, true })
        {
          const int         first = 4 + gap;
          const Volume      volume = MakeVolume({ { 24, 24, 24 } }, { { 0.5, 0.5, 0.5 } }, [=](const Index3 & v) {
            const int place = v[axis];
            return (place >= first && place < first + thickness) ||
                   (place >= first + thickness + gap && place < first + thickness + gap + 3) ||
                   (onBothSides && place >= first - gap - 3 && place < first - gap);
          });
          const Measurement measured(
            volume, 1.0, [=](const auto & cell) { return cell[axis] >= first - 1 && cell[axis] < first + thickness; });
          EXPECT_EQ(measured.GetWallValues().size(), 23u * 23u);
          for (const double value : measured.GetWallValues())
          {
            ASSERT_EQ(value, 0.5 * thickness) << axis << ' ' << gap << ' ' << onBothSides;
          }
        }
      }
    }
  }
}

TEST(MedialVoxelThickness, TiltedWallsBesideNarrowGapsAreNotThicker)
{
  for (const Tilt & tilt : Tilts)
  {
    for (const double thickness : { 2.0, 4.0 })
    {
      const PlateErrors alone = MeasureTiltedPlates(tilt.normal, thickness);
      for (const double gap : { 1.0, 2.0 })
      {
        for (const int others : { 1, 2 })
        {
          const PlateErrors errors = MeasureTiltedPlates(tilt.normal, thickness, gap, others);
          EXPECT_NEAR(errors.mean, alone.mean, 0.1) << tilt.name << ' ' << thickness << ' ' << gap << ' ' << others;
          EXPECT_NEAR(errors.largest, alone.largest, 0.15) << tilt.name << ' ' << thickness;
        }
      }
    }
  }
}

TEST(MedialVoxelThickness, TiltedWallsAreRightInTheMeanOverPlaces)
{
  for (const Tilt & tilt : Tilts)
  {
    for (const double thickness : { 2.0, 3.0, 4.0, 6.0, 8.0 })
    {
      const PlateErrors errors = MeasureTiltedPlates(tilt.normal, thickness);
      const std::string name = tilt.name + (" " + std::to_string(thickness));
      EXPECT_LT(std::abs(errors.mean), 0.21) << name;
      EXPECT_LT(errors.deviation, 0.27) << name;
      // A plate holds whole layers: up to one more or less than its thickness.
      EXPECT_LT(std::max(-errors.smallest, errors.largest), tilt.layer + 0.15) << name;
    }
  }
}

TEST(MedialVoxelThickness, CellsOfWallsWithoutRimsAreNotMarked)
{
  for (const Tilt & tilt : Tilts)
  {
    for (const double thickness : { 1.5, 2.0, 4.0, 8.0 })
    {
      const Measurement measured(
        TiltedPlate({ { 40, 40, 40 } }, PlaceInVoxel(20.99, 3, 13), tilt.normal, thickness), 3.0, Inside(40, 10));
      const double rims = static_cast<double>(measured.GetValues().size() - measured.GetWallValues().size());
      EXPECT_LE(rims / static_cast<double>(measured.GetValues().size()), thickness < 2.0 ? 0.05 : 0.01)
        << tilt.name << ' ' << thickness;
    }
  }
  const Measurement shell(SphericalShell({ { 60, 60, 60 } }, { { 29.4, 29.7, 29.5 } }, 24.0, 4.0), 3.0, Everywhere);
  EXPECT_EQ(shell.GetWallValues().size(), shell.GetValues().size());
}

TEST(MedialVoxelThickness, IsNeverZero)
{
  for (const double density : { 0.3, 0.6, 0.9 })
  {
    const Measurement measured(RandomVolume({ { 40, 30, 20 } }, { { 1.0, 0.5, 2.0 } }, density, 80), 0.6, Everywhere);
    ASSERT_GT(measured.GetValues().size(), 100u);
    EXPECT_GE(*std::min_element(measured.GetValues().begin(), measured.GetValues().end()), 0.5 / 64);
  }
}

TEST(MedialVoxelThickness, TiltedWallsInMillimetersAreRightInTheMean)
{
  // The phantoms measure in voxels: this one is a plate in millimeters.
  const Vector3 spacing{ { 0.5, 0.75, 0.6 } };
  const Vector3 normal{ { 0.3, 0.2, 0.933 } };
  for (const double thickness : { 1.5, 2.4, 4.8 })
  {
    const Volume      volume = MakeVolume({ { 48, 36, 40 } }, spacing, [&](const Index3 & v) {
      const Vector3 r{ { spacing[0] * v[0] - 12, spacing[1] * v[1] - 13.1, spacing[2] * v[2] - 12.2 } };
      return std::abs(Dot(r, normal)) / std::sqrt(Dot(normal, normal)) <= thickness / 2;
    });
    const Measurement measured(volume, 1.8, Inside(36, 9));
    EXPECT_GT(measured.GetValues().size(), 300u);
    EXPECT_NEAR(measured.Mean(), thickness, 0.2 * 0.6) << thickness;
  }
}

TEST(MedialVoxelThickness, AreasOfWallsAlongAnAxisAreExact)
{
  const Vector3 spacing{ { 0.5, 0.75, 1.5 } };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const Volume      volume = AxisPlate({ { 16, 15, 14 } }, spacing, static_cast<int>(axis), 4, 3);
    const Measurement measured(volume, 1.5, Everywhere);
    double            area = static_cast<double>(measured.GetValues().size());
    for (unsigned int other = 0; other < 3; ++other)
    {
      area *= other == axis ? 1.0 : spacing[other];
    }
    EXPECT_NEAR(measured.Area(), area, 1e-4);
    EXPECT_EQ(measured.CellsAcross()[axis], measured.GetValues().size());
  }
  // In the plane the area is a length.
  const Measurement line(AxisPlate({ { 20, 20, 1 } }, { { 0.5, 0.5, 7.0 } }, 1, 6, 5), 1.5, Everywhere);
  EXPECT_EQ(line.Area(), 19 * 0.5);
}

TEST(MedialVoxelThickness, AreasOfTiltedWallsAreRightInTheMean)
{
  for (const Vector3 & normal : { Vector3{ { 1, 2, 5 } }, Vector3{ { 1, 1, 1 } }, Vector3{ { 0, 0.268, 1 } } })
  {
    for (const double thickness : { 2.0, 4.0, 8.0 })
    {
      // The part of the plane above a square, seen along z.
      const Measurement measured(
        TiltedPlate({ { 60, 60, 100 } }, { { 30.2, 29.7, 50.3 } }, normal, thickness), 3.0, [](const auto & cell) {
          return cell[0] >= 14 && cell[0] < 44 && cell[1] >= 14 && cell[1] < 44;
        });
      const double area = 30.0 * 30.0 * std::sqrt(Dot(normal, normal)) / normal[2];
      EXPECT_NEAR(measured.Area() / area, 1.0, thickness < 6.0 ? 0.1 : 0.05)
        << normal[0] << ' ' << normal[1] << ' ' << normal[2];
    }
  }
  for (const double thickness : { 2.0, 4.0, 6.0 })
  {
    const Measurement measured(
      SphericalShell({ { 60, 60, 60 } }, { { 29.4, 29.7, 29.5 } }, 24.0, thickness), 3.0, Everywhere);
    const double area = 4.0 * 3.14159265358979323846 * 24.0 * 24.0;
    EXPECT_NEAR(measured.Area() / area, 1.0, thickness < 6.0 ? 0.1 : 0.05) << thickness;
  }
}

TEST(MedialVoxelThickness, ShellsAreRightInTheMean)
{
  for (const double thickness : { 2.0, 4.0 })
  {
    const Volume      shell = SphericalShell({ { 60, 60, 60 } }, { { 29.4, 29.7, 29.5 } }, 24.0, thickness);
    const Measurement measured(shell, 3.0, Everywhere);
    EXPECT_NEAR(measured.Mean(), thickness, 0.1);
    EXPECT_LT(measured.Deviation(), 0.2);
  }
}

TEST(MedialVoxelThickness, TheSpacingOfEqualVoxelsScalesAll)
{
  Volume            volume = RandomBoxes({ { 40, 30, 20 } }, UnitSpacing, 20, 77);
  const Measurement voxels(volume, 3.0, Everywhere);
  volume.spacing = { { 0.5, 0.5, 0.5 } };
  const Measurement millimeters(volume, 1.5, Everywhere);
  ASSERT_EQ(voxels.GetValues().size(), millimeters.GetValues().size());
  ASSERT_FALSE(voxels.GetValues().empty());
  for (std::size_t i = 0; i < voxels.GetValues().size(); ++i)
  {
    EXPECT_NEAR(millimeters.GetValues()[i], 0.5 * voxels.GetValues()[i], 1e-6);
  }
}

TEST(MedialVoxelThickness, PartsOfATileGiveTheSameBits)
{
  const Volume        volume = RandomBoxes({ { 70, 30, 24 } }, { { 1.0, 1.2, 1.5 } }, 25, 78);
  std::vector<double> whole = Measurement(volume, 3.0, Everywhere).GetValues();
  std::vector<double> parts;
  for (const auto & range : { Index3{ { 0, 5, 0 } }, Index3{ { 5, 24, 0 } } })
  {
    const auto values =
      Measurement(volume, 3.0, Everywhere, MakeBox({ { 0, 0, range[0] } }, { { 70, 30, range[1] } })).GetValues();
    parts.insert(parts.end(), values.begin(), values.end());
  }
  EXPECT_FALSE(whole.empty());
  EXPECT_EQ(whole, parts);
}

TEST(MedialVoxelThickness, SeesVoxelsAroundAPointAndContinuesTheImage)
{
  const Volume                    volume = RandomVolume({ { 130, 9, 8 } }, UnitSpacing, 0.5, 79);
  const itk::MedialVoxelGrid      grid = GridOf(volume);
  const itk::MedialVoxelBits      object = ObjectBits(volume, grid.GetVoxelBox());
  const itk::MedialVoxelThickness thickness(grid);
  ForEachVoxel(grid.GetVoxelBox(), [&](const itk::MedialVoxelIndex & point) {
    std::uint32_t expected = 0;
    ForEachVoxel(MakeBox({ { -1, -1, -1 } }, { { 2, 2, 2 } }), [&](const itk::MedialVoxelIndex & offset) {
      Index3 voxel;
      for (int axis = 0; axis < 3; ++axis)
      {
        voxel[axis] = std::clamp(static_cast<int>(point[axis] + offset[axis]), 0, volume.size[axis] - 1);
      }
      expected |= volume.IsObject(voxel) ? 1u << (13 + offset[0] + 3 * offset[1] + 9 * offset[2]) : 0u;
    });
    EXPECT_EQ(thickness.GetObjectAround(object, point), expected) << point[0] << ' ' << point[1] << ' ' << point[2];
  });
}

TEST(MedialVoxelThickness, MemoryChangesNoMeasure)
{
  std::mt19937                                      random(813);
  itk::MedialVoxelThickness::Memory                 memory;
  const Index3                                      size{ { 70, 11, 9 } };
  std::array<std::uniform_int_distribution<int>, 3> anywhere;
  for (int axis = 0; axis < 3; ++axis)
  {
    anywhere[axis] = std::uniform_int_distribution<int>(0, size[axis] - 1);
  }
  for (const double density : { 0.2, 0.5, 0.9 })
  {
    const Volume                    volume = RandomVolume(size, { { 1.0, 0.7, 1.9 } }, density, 814);
    const itk::MedialVoxelGrid      grid = GridOf(volume);
    const itk::MedialVoxelBits      object = ObjectBits(volume, grid.GetVoxelBox());
    const itk::MedialVoxelThickness thickness(grid);
    memory.Clear();
    // More points than the memory has places for, some of them again and again.
    for (int round = 0; round < 4000; ++round)
    {
      itk::MedialVoxelWallPoints wall;
      wall.numberOfCorners = 8;
      for (auto & corner : wall.corners)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          corner[axis] = axis == 0 && round % 2 == 0 ? anywhere[axis](random) % 3 : anywhere[axis](random);
        }
      }
      wall.a = wall.corners[0];
      wall.b = wall.corners[7];
      if (wall.a == wall.b)
      {
        continue;
      }
      const itk::MedialVoxelWall expected = thickness.Measure(object, wall);
      const itk::MedialVoxelWall measured = thickness.Measure(object, wall, memory);
      ASSERT_EQ(measured.thickness, expected.thickness);
      ASSERT_EQ(measured.area, expected.area);
      ASSERT_EQ(measured.axis, expected.axis);
      ASSERT_EQ(measured.isUnpaired, expected.isUnpaired);
      if (wall.GetSides() == wall.GetNearerSides() && !wall.IsThin())
      {
        ASSERT_EQ(thickness.MeasureThickness(object, wall, memory), expected.thickness);
      }
    }
  }
}
