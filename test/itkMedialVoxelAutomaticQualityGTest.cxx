// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelBoundary.h"
#include "itkMedialVoxelClassifier.h"

#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestWalls.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelParameters;

constexpr auto FreeSpace = itk::MedialVoxelPseudoGeodesicBound::FreeSpace;

/** Farther from the mid-surface than this a medial cell is spurious, and a point of it is not covered. */
constexpr double Far = 1.5;

/** What a sheet is worth, in percent of its cells and of the points that it must cover. */
struct Quality
{
  double      spurious;
  double      uncovered;
  std::size_t cells;
};

std::vector<unsigned char>
Classify(const Volume & volume, const MedialVoxelParameters & parameters)
{
  const itk::MedialVoxelGrid grid = GridOf(volume);
  const itk::MedialVoxelBox  image = grid.GetVoxelBox();
  const auto                 object = ObjectBits(volume, image);
  itk::MedialVoxelBits       sites(image);
  itk::MedialVoxelComputeBoundary(object, image, itk::MedialVoxelBoundary::Background, image, sites);
  const itk::MedialVoxelFeatureTransform      transform(grid);
  itk::MedialVoxelFeatureTransform::Workspace transformWorkspace;
  itk::MedialVoxelFeatures                    features;
  EXPECT_TRUE(transform.Compute({ &object, &sites }, image, transformWorkspace, features).IsEmpty());
  const itk::MedialVoxelClassifier      classifier(grid, parameters);
  const itk::MedialVoxelNoProgress      progress;
  itk::MedialVoxelClassifier::Workspace workspace;
  std::vector<unsigned char>            labels;
  itk::MedialVoxelCounts                counts;
  EXPECT_TRUE(classifier.Classify({ &object, &sites }, image, features, progress, workspace, labels, counts).IsEmpty());
  return labels;
}

Quality
Judge(const Part & part, const Volume & volume, const std::vector<unsigned char> & labels)
{
  std::size_t                cells = 0;
  std::size_t                spurious = 0;
  std::vector<unsigned char> isNear(labels.size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] < itk::MedialVoxelLabel::MedialByBound)
    {
      continue;
    }
    const Index3 v = volume.IndexAt(i);
    ++cells;
    spurious += part.middle(PositionIn(part, { { v[0] + 0.5, v[1] + 0.5, v[2] + 0.5 } })) > Far ? 1 : 0;
    isNear[i] = 1;
  }
  std::size_t   uncovered = 0;
  const Vector3 center = CenterOf(part);
  for (const Vector3 & sample : part.samples)
  {
    bool   covered = false;
    Index3 lower;
    for (int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = static_cast<int>(std::floor(sample[axis] + center[axis] - 0.5)) - 1;
    }
    for (int move = 0; move < 64 && !covered; ++move)
    {
      const Index3 v{ { lower[0] + move % 4, lower[1] + move / 4 % 4, lower[2] + move / 16 } };
      if (volume.Contains(v) && isNear[volume.Offset(v)])
      {
        const Vector3 way{
          { v[0] + 0.5 - center[0] - sample[0], v[1] + 0.5 - center[1] - sample[1], v[2] + 0.5 - center[2] - sample[2] }
        };
        covered = Dot(way, way) <= Far * Far;
      }
    }
    uncovered += covered ? 0 : 1;
  }
  return { 100.0 * static_cast<double>(spurious) / static_cast<double>(std::max<std::size_t>(1, cells)),
           100.0 * static_cast<double>(uncovered) / static_cast<double>(part.samples.size()),
           cells };
}

Quality
Judge(const Part & part, const Volume & volume, const MedialVoxelParameters & parameters)
{
  return Judge(part, volume, Classify(volume, parameters));
}

Quality
Judge(const Part & part, Noise noise, const MedialVoxelParameters & parameters)
{
  return Judge(part, Voxelize(part, noise, 77), parameters);
}

/** Where the sheet begins at rims, against where the medial axis of a square rim does; in voxels, positive further in.
 */
struct RimQuality
{
  double      mean;
  double      worst;
  std::size_t strips;
};

RimQuality
JudgeRims(const Part & part, const Volume & volume, const std::vector<unsigned char> & labels)
{
  // A sheet that has not begun so far behind the axis counts as if it began there.
  constexpr double    most = 8.0;
  std::vector<double> lateness(part.rims.size(), most);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] < itk::MedialVoxelLabel::MedialByBound)
    {
      continue;
    }
    const Index3  v = volume.IndexAt(i);
    const Vector3 cell = Turned(PositionIn(part, { { v[0] + 0.5, v[1] + 0.5, v[2] + 0.5 } }));
    for (std::size_t k = 0; k < part.rims.size(); ++k)
    {
      const RimStrip & strip = part.rims[k];
      const double     depth = strip.sign * (cell[strip.inward] - strip.edge[strip.inward]);
      if (std::abs(cell[strip.along] - strip.edge[strip.along]) <= 0.5 &&
          std::abs(cell[strip.across] - strip.edge[strip.across]) <= Far && depth >= 0.0)
      {
        lateness[k] = std::min(lateness[k], depth - strip.half);
      }
    }
  }
  RimQuality quality{ 0.0, 0.0, lateness.size() };
  for (const double late : lateness)
  {
    quality.mean += late / static_cast<double>(lateness.size());
    quality.worst = std::abs(late) > std::abs(quality.worst) ? late : quality.worst;
  }
  return quality;
}

/** The part with the rims of its walls of one thickness alone. */
Part
WithRimsOf(Part part, double thickness)
{
  const auto isOther = [thickness](const RimStrip & strip) { return 2.0 * strip.half != thickness; };
  part.rims.erase(std::remove_if(part.rims.begin(), part.rims.end(), isOther), part.rims.end());
  return part;
}

/** Thicknesses of the walls that have rims. */
std::set<double>
WallsOf(const Part & part)
{
  std::set<double> walls;
  for (const RimStrip & strip : part.rims)
  {
    walls.insert(2.0 * strip.half);
  }
  return walls;
}

MedialVoxelParameters
Automatic()
{
  return MedialVoxelParameters::ForWalls(3.0, 16.0, FreeSpace);
}
} // namespace

TEST(MedialVoxelAutomaticQuality, PlatesHaveOneCellPerColumn)
{
  for (int thickness = 1; thickness <= 8; ++thickness)
  {
    const int    lower = 5;
    const Volume plate = MakeVolume(
      { { 40, 40, 20 } }, UnitSpacing, [&](const Index3 & v) { return v[2] >= lower && v[2] < lower + thickness; });
    const auto labels = Classify(plate, Automatic());
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
  const auto clean = Judge(part, Noise::None, Automatic());
  const auto flipped = Judge(part, Noise::Flip, Automatic());
  const auto fixed = Judge(part, Noise::None, MedialVoxelParameters::ForThickness(3.0, FreeSpace));
  EXPECT_LE(clean.spurious, 0.5);
  EXPECT_LE(clean.uncovered, 1.5);
  EXPECT_LE(flipped.spurious, 0.5);
  EXPECT_LE(flipped.uncovered, 1.5);
  EXPECT_GT(fixed.spurious, 10.0);
}

TEST(MedialVoxelAutomaticQuality, RibsAndBendsKeepTheirSheets)
{
  for (const Part & part : { TeePart(), BendPart() })
  {
    for (const Noise noise : { Noise::None, Noise::Flip, Noise::Scan })
    {
      const auto quality = Judge(part, noise, Automatic());
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
      const auto quality = Judge(part, noise, Automatic());
      EXPECT_LE(quality.spurious, 0.5) << part.name;
      EXPECT_EQ(quality.uncovered, 0.0) << part.name;
    }
  }
}

TEST(MedialVoxelAutomaticQuality, PoresAreLeftOut)
{
  const Part part = StepsPart();
  const auto kept = Judge(part, Voxelize(part, Noise::Pores, 77, 0), Automatic());
  const auto quality = Judge(part, Noise::Pores, Automatic());
  EXPECT_GT(kept.spurious, 10.0);
  EXPECT_LE(quality.spurious, 1.0);
  EXPECT_LE(quality.uncovered, 1.5);
}

/** The tables of doc/thickness.md, as Markdown; takes minutes. */
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
      for (const auto & parameters : { Automatic(),
                                       MedialVoxelParameters::ForThickness(3.0, FreeSpace),
                                       MedialVoxelParameters::ForThickness(5.0, FreeSpace) })
      {
        print(Judge(part, noise.second, parameters));
      }
      print(Judge(part, Voxelize(part, noise.second, 77, 0), Automatic()));
      std::printf("\n");
    }
  }
}

TEST(MedialVoxelAutomaticQuality, SheetsBeginWhereTheAxesOfSquareRimsDo)
{
  const auto expectOnAxis = [](const Part & part, Noise noise) {
    const Volume volume = Voxelize(part, noise, 77);
    const auto   labels = Classify(volume, Automatic());
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

/** The table of rims of doc/thickness.md, as Markdown; takes a minute. */
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
      columns.emplace_back(&volume, Classify(volume, Automatic()));
    }
    for (const double thickness : { 3.0, 5.0 })
    {
      columns.emplace_back(&volumes[0],
                           Classify(volumes[0], MedialVoxelParameters::ForThickness(thickness, FreeSpace)));
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
