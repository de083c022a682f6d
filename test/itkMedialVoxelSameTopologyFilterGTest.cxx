// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The filter with SameTopology: against the definition in loops over the whole volume, and for any division.

#include "MedialVoxelTestPores.h"
#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestTopology.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkStreamingImageFilter.h"

namespace
{
using namespace MedialVoxelTest;

const Vector3 SkewSpacing{ { 0.7, 1.1, 1.3 } };

struct Run
{
  std::vector<unsigned char> labels;
  std::size_t                numberOfAddedCells;
};

template <unsigned int D>
Run
RunFilter(const Volume & volume, const bool sameTopology, const std::size_t maximumPoreSize = 0)
{
  auto filter = MakeMedialFilter<D>(volume, 3.0);
  filter->SetSameTopology(sameTopology);
  filter->SetMaximumPoreSize(static_cast<long>(maximumPoreSize));
  filter->UpdateLargestPossibleRegion();
  return { PixelsOf(filter->GetOutput()), static_cast<std::size_t>(filter->GetNumberOfAddedCells()) };
}

Values
ValuesOf(const Volume & volume, const std::vector<unsigned char> & values, const int least)
{
  Values result({ { volume.size[0], volume.size[1], volume.size[2] } }, 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const Index3 v = volume.IndexAt(i);
    result.Set({ { v[0], v[1], v[2] } }, values[i] >= least ? 1 : 0);
  }
  return result;
}

/** The distance of the nearest background voxel to each corner, in smallest spacings. */
int
LevelOf(const Volume & volume, const Values & object, const itk::MedialVoxelIndex & cell)
{
  double smallest = 0.0;
  double length = std::numeric_limits<double>::infinity();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    smallest =
      volume.size[axis] > 1 && (smallest == 0.0 || volume.spacing[axis] < smallest) ? volume.spacing[axis] : smallest;
  }
  itk::MedialVoxelBox corners{ cell, { { cell[0] + 2, cell[1] + 2, cell[2] + 2 } } };
  corners = corners.Intersection(object.GetBox());
  ForEachIndex(corners, [&](const auto & corner) {
    ForEachIndex(object.GetBox(), [&](const auto & v) {
      if (object.Get(v) == 0)
      {
        length = std::min(length,
                          PhysicalDistance(volume,
                                           Index3{ { int(corner[0]), int(corner[1]), int(corner[2]) } },
                                           Index3{ { int(v[0]), int(v[1]), int(v[2]) } }));
      }
    });
  });
  return static_cast<int>(std::floor(length / smallest + 1e-9));
}

template <unsigned int D>
void
ExpectDefinition(const Volume & volume, const std::size_t maximumPoreSize)
{
  const auto   without = RunFilter<D>(volume, false, maximumPoreSize);
  const auto   with = RunFilter<D>(volume, true, maximumPoreSize);
  const Volume clean = maximumPoreSize > 0 ? WithoutPores(volume, static_cast<int>(maximumPoreSize)) : volume;
  const Values object = ValuesOf(clean, clean.object, 1);
  Scene        scene(object.GetBox().upper);
  scene.object = FillInLoops(object, maximumPoreSize);
  scene.medial = ValuesOf(clean, without.labels, 2);
  ForEachIndex(GridOf(object.GetBox().upper).GetCellBox(),
               [&](const auto & cell) { scene.levels.Set(cell, LevelOf(clean, object, cell)); });
  const Values               kept = ThinInLoops(scene);
  std::vector<unsigned char> expected = without.labels;
  std::size_t                added = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const Index3 v = volume.IndexAt(i);
    if (kept.Get(v[0], v[1], v[2]) != 0 && expected[i] < 2)
    {
      expected[i] = 4;
      ++added;
    }
  }
  EXPECT_TRUE(AreEqual(with.labels, expected));
  EXPECT_EQ(with.numberOfAddedCells, added);
  EXPECT_EQ(without.numberOfAddedCells, 0u);
  EXPECT_EQ(FindBettiNumbers(scene.object, ValuesOf(clean, with.labels, 2)), FindBettiNumbersOfVoxels(scene.object));
}

TEST(MedialVoxelSameTopology, TheFilterFollowsTheDefinition)
{
  for (unsigned int seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    ExpectDefinition<3>(RandomBoxes({ { 15, 13, 14 } }, UnitSpacing, 9, seed), 0);
    ExpectDefinition<3>(RandomBoxes({ { 14, 12, 13 } }, SkewSpacing, 9, seed), 0);
    ExpectDefinition<3>(RandomVolume({ { 12, 11, 13 } }, UnitSpacing, 0.3 * seed, seed), 5);
    ExpectDefinition<2>(RandomBoxes({ { 40, 30, 1 } }, UnitSpacing, 12, seed), 0);
    ExpectDefinition<2>(RandomVolume({ { 30, 26, 1 } }, SkewSpacing, 0.3 * seed, seed), 4);
  }
}

TEST(MedialVoxelSameTopology, DivisionsDoNotMatter)
{
  for (const Volume & volume : { RandomBoxes({ { 80, 37, 41 } }, UnitSpacing, 30, 604),
                                 RandomVolume({ { 70, 40, 30 } }, UnitSpacing, 0.7, 605),
                                 RandomBoxes({ { 60, 30, 40 } }, SkewSpacing, 25, 606) })
  {
    const auto expected = RunFilter<3>(volume, true, 6).labels;
    for (const unsigned int tileSize : { 0u, 7u, 16u })
    {
      for (const unsigned int slabThickness : { 1u, 5u, 64u })
      {
        for (const unsigned int threads : { 1u, 4u })
        {
          auto filter = MakeMedialFilter<3>(volume, 3.0);
          filter->SameTopologyOn();
          filter->SetMaximumPoreSize(6);
          filter->SetNumberOfWorkUnits(threads);
          itk::MedialVoxelFilterAccess::SetTileSize(*filter, tileSize);
          itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, slabThickness);
          filter->Update();
          EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected)) << tileSize << ' ' << slabThickness;
        }
      }
    }
    auto filter = MakeMedialFilter<3>(volume, 3.0);
    filter->SameTopologyOn();
    filter->SetMaximumPoreSize(6);
    auto streaming = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
    streaming->SetInput(filter->GetOutput());
    streaming->SetNumberOfStreamDivisions(5);
    streaming->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(streaming->GetOutput()), expected));
  }
}

TEST(MedialVoxelSameTopology, AnAbortedUpdateLeavesNothing)
{
  const Volume volume = RandomBoxes({ { 80, 37, 41 } }, UnitSpacing, 30, 604);
  auto         filter = MakeMedialFilter<3>(volume, 3.0);
  filter->SameTopologyOn();
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 7);
  const auto tag =
    filter->AddObserver(itk::ProgressEvent(), [&filter](const itk::EventObject &) { filter->AbortGenerateDataOn(); });
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  filter->RemoveObserver(tag);
  filter->SameTopologyOff();
  filter->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), RunFilter<3>(volume, false).labels));
}

TEST(MedialVoxelSameTopology, AnImageWithoutBackgroundOrObjectGetsNoLabel)
{
  for (const double density : { 0.0, 1.0 })
  {
    const Volume volume = RandomVolume({ { 9, 8, 7 } }, UnitSpacing, density, 1);
    const auto   with = RunFilter<3>(volume, true);
    EXPECT_EQ(with.numberOfAddedCells, 0u);
    EXPECT_TRUE(AreEqual(with.labels, RunFilter<3>(volume, false).labels));
  }
}

/** A ball without a sheet keeps one cell, and a rod a line of cells. */
TEST(MedialVoxelSameTopology, PartsWithoutASheetKeepALine)
{
  const Volume rod = MakeVolume({ { 50, 16, 16 } }, UnitSpacing, [](const Index3 & v) {
    return v[0] >= 5 && v[0] < 45 && std::pow(v[1] - 7.6, 2) + std::pow(v[2] - 7.3, 2) < 22;
  });
  const auto   run = RunFilter<3>(rod, true);
  EXPECT_EQ(FindBettiNumbers(ValuesOf(rod, rod.object, 1), ValuesOf(rod, run.labels, 2)),
            (std::array<int, 3>{ { 1, 0, 0 } }));
  // A line with turns, no sheet.
  EXPECT_LE(run.numberOfAddedCells, 80u);
}

} // namespace
