// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestSheets.h"

#include <cstdio>

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

/** The table of all parts of doc/explanation/accuracy.md, as Markdown; takes minutes. */
TEST(MedialVoxelAutomaticQuality, DISABLED_Table)
{
  const std::pair<const char *, Noise> noises[] = { { "clean", Noise::None },  { "flip", Noise::Flip },
                                                    { "shift", Noise::Shift }, { "scan", Noise::Scan },
                                                    { "pores", Noise::Pores }, { "pores, flip", Noise::PoresAndFlip } };
  const auto                           print = [](const Quality & quality) {
    EXPECT_GT(quality.cells, 0u);
    std::printf(" %.2f / %.2f |", quality.spurious, quality.uncovered);
  };
  std::printf("| part | noise | automatic | fixed 3 | fixed 5 | automatic, pores kept |\n");
  std::printf("| --- | --- | --- | --- | --- | --- |\n");
  for (const Part & part :
       { StepsPart(), RibsPart(), TeePart(), BendPart(), GyroidPart(), ShellPart(4.0), ShellPart(10.0) })
  {
    for (const auto & noise : noises)
    {
      std::printf("| %s | %s |", part.name.c_str(), noise.first);
      for (const auto & parameters : { AutomaticThickness(), FixedThickness(3.0), FixedThickness(5.0) })
      {
        print(Judge(part, noise.second, parameters));
      }
      print(Judge(part, Voxelize(part, noise.second, 77, 0), AutomaticThickness()));
      std::printf("\n");
    }
  }
}

/** The table of single walls of doc/explanation/accuracy.md, as Markdown: those that are not covered everywhere. */
TEST(MedialVoxelAutomaticQuality, DISABLED_WallTable)
{
  std::printf(
    "| part | noise | wall | spurious | not covered | farther than 2 | pierced | not covered and not pierced |\n"
    "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Part & part : { StepsPart(), RibsPart() })
  {
    for (const auto & [name, noise] : NoisesOfSurfaces)
    {
      const Volume volume = Voxelize(part, noise, 77);
      for (const auto & [thickness, wall] : JudgeWalls(part, volume, Classify(volume, AutomaticThickness())))
      {
        EXPECT_GT(wall.cells, 0u);
        if (wall.uncovered > 0)
        {
          std::printf("| %s | %s | %g | %.2f | %.2f | %.2f | %.1f | %.2f |\n",
                      part.name.c_str(),
                      name,
                      thickness,
                      Percent(wall.spurious, wall.cells),
                      Percent(wall.uncovered, wall.points),
                      Percent(wall.farUncovered, wall.points),
                      Percent(wall.pierced, wall.points),
                      Percent(wall.uncovered - wall.uncoveredPierced, wall.points));
        }
      }
    }
  }
}

/** The table of pores of doc/explanation/accuracy.md, as Markdown: mean and worst of five volumes; takes minutes. */
TEST(MedialVoxelAutomaticQuality, DISABLED_PoreTable)
{
  std::printf("| part | noise | 32 | 64 | 128 | 32, pits filled |\n| --- | --- | --- | --- | --- | --- |\n");
  const auto print = [](const Part & part, Noise noise, std::size_t poreSize, bool withPits) {
    double sum = 0.0;
    double worst = 0.0;
    for (unsigned int seed = 77; seed < 82; ++seed)
    {
      const Volume volume = Voxelize(part, noise, seed, poreSize);
      const auto   quality = Judge(part, withPits ? volume : WithoutPits(part, volume), AutomaticThickness());
      EXPECT_GT(quality.cells, 0u);
      sum += quality.spurious;
      worst = std::max(worst, quality.spurious);
    }
    std::printf(" %.2f / %.2f |", sum / 5, worst);
  };
  for (const Part & part : { StepsPart(), RibsPart(), ShellPart(10.0) })
  {
    for (const auto & [name, noise] : { std::make_pair("pores", Noise::Pores), { "pores, flip", Noise::PoresAndFlip } })
    {
      std::printf("| %s | %s |", part.name.c_str(), name);
      for (const std::size_t poreSize : { 32, 64, 128 })
      {
        print(part, noise, poreSize, true);
      }
      print(part, noise, 32, false);
      std::printf("\n");
    }
  }
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

/** The table of rims of doc/explanation/accuracy.md, as Markdown; takes a minute. */
TEST(MedialVoxelAutomaticQuality, DISABLED_RimTable)
{
  std::printf("| part | wall | clean | flip | shift | scan | fixed 3, clean | fixed 5, clean |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Part & part : { StepsPart(), RibsPart() })
  {
    std::vector<Volume> volumes;
    for (const Noise noise : { Noise::None, Noise::Flip, Noise::Shift, Noise::Scan })
    {
      volumes.push_back(Voxelize(part, noise, 77));
    }
    std::vector<std::pair<const Volume *, std::vector<unsigned char>>> columns;
    for (const Volume & volume : volumes)
    {
      columns.emplace_back(&volume, Classify(volume, AutomaticThickness()));
    }
    for (const double thickness : { 3.0, 5.0 })
    {
      columns.emplace_back(&volumes[0], Classify(volumes[0], FixedThickness(thickness)));
    }
    for (const double thickness : WallsOf(part))
    {
      const Part walls = WithRimsOf(part, thickness);
      std::printf("| %s | %g |", part.name.c_str(), thickness);
      for (const auto & column : columns)
      {
        const RimQuality quality = JudgeRims(walls, *column.first, column.second);
        EXPECT_GT(quality.strips, 0u);
        std::printf(" %+.1f / %+.1f |", quality.mean, quality.worst);
      }
      std::printf("\n");
    }
  }
}
