// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "AccuracyTables.h"

#include "MedialVoxelTestSheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

using namespace MedialVoxelTest;

void
PrintAutomaticTable()
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

void
PrintAutomaticWallsTable()
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

void
PrintAutomaticPoresTable()
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

void
PrintAutomaticRimsTable()
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
