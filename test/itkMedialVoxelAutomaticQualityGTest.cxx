// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestSheets.h"

namespace
{
using namespace MedialVoxelTest;
} // namespace

TEST(MedialVoxelAutomaticQuality, PlatesHaveOneCellPerColumn)
{
  for (int thickness = 1; thickness <= 8; ++thickness)
  {
    const int    lower = 5;
    const Volume plate = MakeVolume(
      { { 40, 40, 20 } }, UnitSpacing, [&](const Index3 & v) { return v[2] >= lower && v[2] < lower + thickness; });
    const auto labels = Classify(plate, AutomaticThickness());
    for (int y = 0; y < 39; ++y)
    {
      for (int x = 0; x < 39; ++x)
      {
        int cells = 0;
        for (int z = 0; z < 20; ++z)
        {
          cells += labels[plate.Offset({ { x, y, z } })] >= itk::MedialVoxelLabel::MedialByBound ? 1 : 0;
        }
        ASSERT_EQ(cells, 1) << "thickness " << thickness;
      }
    }
  }
}

TEST(MedialVoxelAutomaticQuality, StepsHaveNoBranches)
{
  const Part part = StepsPart();
  const auto clean = Judge(part, Noise::None, AutomaticThickness());
  const auto flipped = Judge(part, Noise::Flip, AutomaticThickness());
  const auto fixed = Judge(part, Noise::None, FixedThickness(3.0));
  EXPECT_LE(clean.spurious, 0.5);
  EXPECT_LE(clean.uncovered, 1.5);
  EXPECT_LE(flipped.spurious, 0.5);
  EXPECT_LE(flipped.uncovered, 1.5);
  EXPECT_GT(fixed.spurious, 10.0);
}

TEST(MedialVoxelAutomaticQuality, HolesAreSeenWhereTheyAre)
{
  const Part part = TeePart();
  Volume     volume = Voxelize(part, Noise::None, 0);
  const auto isPiercedAt = [&](double along) {
    return IsPierced(part, volume, TurnedBack({ { 0.0, along, 8.0 } }), PiercedRadius);
  };
  for (double along = -14.0; along <= 14.0; along += 1.0)
  {
    EXPECT_FALSE(isPiercedAt(along)) << along;
  }
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    const Index3  v = volume.IndexAt(i);
    const Vector3 p = Turned(PositionIn(part, { { double(v[0]), double(v[1]), double(v[2]) } }));
    volume.object[i] = std::hypot(p[1], p[2] - 8.0) < 1.0 && p[0] > 0.0 ? 0 : volume.object[i];
  }
  EXPECT_FALSE(isPiercedAt(0.0)) << "a pit";
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    const Index3  v = volume.IndexAt(i);
    const Vector3 p = Turned(PositionIn(part, { { double(v[0]), double(v[1]), double(v[2]) } }));
    volume.object[i] = std::hypot(p[1], p[2] - 8.0) < 1.0 ? 0 : volume.object[i];
  }
  EXPECT_TRUE(isPiercedAt(0.0));
  EXPECT_TRUE(isPiercedAt(1.0));
  EXPECT_FALSE(isPiercedAt(-5.0));
  EXPECT_FALSE(isPiercedAt(5.0));
}

TEST(MedialVoxelAutomaticQuality, NoiseLeavesSheetsWholeWhereItLeavesWallsWhole)
{
  for (const Part & part : { StepsPart(), RibsPart() })
  {
    for (const auto & [name, noise] : NoisesOfSurfaces)
    {
      const Volume volume = Voxelize(part, noise, 77);
      const auto   labels = Classify(volume, AutomaticThickness());
      EXPECT_LE(Judge(part, volume, labels).spurious, 0.5) << part.name << ", " << name;
      for (const auto & [thickness, wall] : JudgeWalls(part, volume, labels))
      {
        // Not none: the medial surface itself leaves the plate of 4 where a rib of 8 stands on it.
        EXPECT_LE(Percent(wall.uncovered - wall.uncoveredPierced, wall.points), 0.3)
          << part.name << ", " << name << ", wall " << thickness;
        if (thickness >= 3.0)
        {
          EXPECT_LE(Percent(wall.uncovered, wall.points), 1.5) << part.name << ", " << name << ", wall " << thickness;
        }
      }
    }
  }
}

TEST(MedialVoxelAutomaticQuality, RibsAndBendsKeepTheirSheets)
{
  for (const Part & part : { TeePart(), BendPart() })
  {
    for (const Noise noise : { Noise::None, Noise::Flip, Noise::Scan })
    {
      const auto quality = Judge(part, noise, AutomaticThickness());
      EXPECT_LE(quality.spurious, 0.5) << part.name;
      EXPECT_LE(quality.uncovered, 1.5) << part.name;
    }
  }
}

TEST(MedialVoxelAutomaticQuality, ClosedShellsHaveNoHoles)
{
  for (const double thickness : { 4.0, 10.0 })
  {
    const Part part = ShellPart(thickness);
    for (const Noise noise : { Noise::None, Noise::Flip })
    {
      const auto quality = Judge(part, noise, AutomaticThickness());
      EXPECT_LE(quality.spurious, 0.5) << part.name;
      EXPECT_EQ(quality.uncovered, 0.0) << part.name;
    }
  }
}

TEST(MedialVoxelAutomaticQuality, PoresAreLeftOut)
{
  const Part part = StepsPart();
  const auto kept = Judge(part, Voxelize(part, Noise::Pores, 77, 0), AutomaticThickness());
  const auto quality = Judge(part, Noise::Pores, AutomaticThickness());
  EXPECT_GT(kept.spurious, 10.0);
  EXPECT_LE(quality.spurious, 1.0);
  EXPECT_LE(quality.uncovered, 1.5);
}

TEST(MedialVoxelAutomaticQuality, WhatPoresLeaveIsBesidePits)
{
  const Part   part = ShellPart(10.0);
  const Volume volume = Voxelize(part, Noise::Pores, 77);
  EXPECT_EQ(WithoutPores(volume, 1000).object, volume.object) << "a larger size leaves out no more";
  EXPECT_GT(Judge(part, volume, AutomaticThickness()).spurious, 0.5);
  EXPECT_EQ(Judge(part, WithoutPits(part, volume), AutomaticThickness()).spurious, 0.0);
}

TEST(MedialVoxelAutomaticQuality, SheetsBeginWhereTheAxesOfSquareRimsDo)
{
  const auto expectOnAxis = [](const Part & part, Noise noise) {
    const Volume volume = Voxelize(part, noise, 77);
    const auto   labels = Classify(volume, AutomaticThickness());
    for (const double thickness : WallsOf(part))
    {
      const RimQuality quality = JudgeRims(WithRimsOf(part, thickness), volume, labels);
      EXPECT_LE(std::abs(quality.mean), 1.0) << part.name << ", wall " << thickness;
      EXPECT_LE(std::abs(quality.worst), 2.0) << part.name << ", wall " << thickness;
    }
  };
  for (const Part & part : { StepsPart(), RibsPart() })
  {
    expectOnAxis(part, Noise::None);
  }
  for (const Part & part : { TeePart(), BendPart() })
  {
    for (const Noise noise : { Noise::Flip, Noise::Shift, Noise::Scan })
    {
      expectOnAxis(part, noise);
    }
  }
}
