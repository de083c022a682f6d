// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestThreads.h"

#include "itkMedialVoxelThickWalls.h"

#include "itkStreamingImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>

using namespace MedialVoxelTest;

namespace
{

using Grid = itk::MedialVoxelGrid;
using Index = itk::MedialVoxelIndex;
using IsObject = std::function<bool(const Index &)>;
using RunWorkers = itk::MedialVoxelThickWalls::RunWorkersFunction;

void
RunOneByOne(const unsigned int number, const std::function<void()> & work)
{
  for (unsigned int i = 0; i < number; ++i)
  {
    work();
  }
}

/** Looks at an object in boxes of so many rows. */
std::optional<double>
FindNeededMaximum(
  const Grid &                  grid,
  const double                  maximum,
  const IsObject &              isObject,
  const std::int64_t            rows = 32,
  const std::function<void()> & checkAbort = [] {},
  const RunWorkers &            runWorkers = RunOneByOne)
{
  const itk::MedialVoxelBox  image = grid.GetVoxelBox();
  itk::MedialVoxelBits       object(image);
  itk::MedialVoxelThickWalls walls(grid, maximum);
  for (std::int64_t z = 0; z < image.upper[2]; ++z)
  {
    for (std::int64_t y = 0; y < image.upper[1]; ++y)
    {
      for (std::int64_t x = 0; x < image.upper[0]; ++x)
      {
        isObject({ { x, y, z } }) ? object.Set({ { x, y, z } }) : void();
      }
    }
  }
  for (itk::MedialVoxelBox box = image; box.lower[1] < image.upper[1]; box.lower[1] = box.upper[1])
  {
    box.upper[1] = std::min(box.lower[1] + rows, image.upper[1]);
    walls.Add(object, box);
  }
  return walls.FindNeededMaximum(checkAbort, runWorkers);
}

/** The volume of a hollow box whose walls all have one thickness. */
Volume
MakeHollowBox(const int edge, const int wall)
{
  return MakeVolume({ { edge, edge, edge } }, UnitSpacing, [=](const Index3 & v) {
    const auto isInside = [&v, edge](const int margin) {
      return std::all_of(v.begin(), v.end(), [&](const int at) { return at >= margin && at < edge - margin; });
    };
    return isInside(4) && !isInside(4 + wall);
  });
}

} // namespace

TEST(MedialVoxelThickWalls, PlatesNeedTheirThickness)
{
  for (const double spacing : { 1.0, 0.3 })
  {
    const Grid grid({ { 61, 70, 66 } }, { { spacing, spacing, spacing } });
    for (int first = 5; first < 9; ++first)
    {
      for (const int thickness : { 4, 10, 14, 16, 20, 23, 26, 29, 31, 40, 50 })
      {
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          SCOPED_TRACE(testing::Message() << thickness << " from " << first << " along " << axis);
          const auto found = FindNeededMaximum(
            grid, 16 * spacing, [&](const Index & v) { return v[axis] >= first && v[axis] < first + thickness; });
          // Blocks of 4 voxels tell walls of up to 22 from those of 16 only where their faces suit.
          if (thickness <= 16 || thickness >= 40)
          {
            EXPECT_FALSE(found);
          }
          else if (thickness > 22)
          {
            ASSERT_TRUE(found);
            EXPECT_GE(*found, thickness * spacing);
            EXPECT_LE(*found, std::min(thickness + 8, 32) * spacing + 1e-9);
          }
        }
      }
    }
  }
}

TEST(MedialVoxelThickWalls, CountFromAQuarterOn)
{
  const Grid grid({ { 96, 96, 64 } }, { { 1.0, 1.0, 1.0 } });
  // A thin plate over all, and a thick one over a part of it.
  const auto withThick = [&](const int width) {
    return FindNeededMaximum(grid, 16.0, [width](const Index & v) {
      return (v[2] >= 4 && v[2] < 16) || (v[0] < width && v[2] >= 28 && v[2] < 52);
    });
  };
  EXPECT_FALSE(withThick(0));
  EXPECT_FALSE(withThick(8));
  // A third of the object, and less than a quarter of the walls.
  EXPECT_FALSE(withThick(36));
  EXPECT_TRUE(withThick(48));
  EXPECT_TRUE(withThick(96));
}

TEST(MedialVoxelThickWalls, DependOnNothingElse)
{
  const Grid     grid({ { 130, 75, 61 } }, { { 1.0, 1.0, 2.0 } });
  const IsObject isObject = [](const Index & v) {
    return (v[0] > 20 && v[0] < 45) || (v[1] > 30 && v[1] < 52 && (v[0] + v[2]) % 17 != 0);
  };
  const auto found = FindNeededMaximum(grid, 16.0, isObject, 75);
  ASSERT_TRUE(found);
  for (const std::int64_t rows : { 4, 8, 32, 64 })
  {
    EXPECT_EQ(FindNeededMaximum(grid, 16.0, isObject, rows), found) << rows;
    EXPECT_EQ(FindNeededMaximum(grid, 16.0, isObject, rows, [] {}, RunInThreads), found) << rows;
  }
}

TEST(MedialVoxelThickWalls, ImagesOfAnySize)
{
  const IsObject wall = [](const Index & v) { return v[0] >= 8 && v[0] < 32; };
  EXPECT_TRUE(FindNeededMaximum(Grid({ { 50, 60, 1 } }, { { 1.0, 1.0, 1.0 } }), 16.0, wall));
  EXPECT_TRUE(FindNeededMaximum(Grid({ { 50, 1, 60 } }, { { 1.0, 1.0, 1.0 } }), 16.0, wall));
  for (const Index & size : { Index{ { 50, 1, 1 } }, Index{ { 1, 1, 1 } }, Index{ { 3, 2, 2 } }, Index{ { 5, 3, 9 } } })
  {
    EXPECT_FALSE(FindNeededMaximum(Grid(size, { { 1.0, 1.0, 1.0 } }), 16.0, wall));
    EXPECT_FALSE(FindNeededMaximum(Grid(size, { { 1.0, 1.0, 1.0 } }), 16.0, [](const Index &) { return false; }));
    EXPECT_FALSE(FindNeededMaximum(Grid(size, { { 1.0, 1.0, 1.0 } }), 16.0, [](const Index &) { return true; }));
  }
}

TEST(MedialVoxelThickWalls, HearAnAbort)
{
  const Grid grid({ { 96, 96, 64 } }, { { 1.0, 1.0, 1.0 } });
  const auto wall = [](const Index & v) { return v[2] >= 8 && v[2] < 32; };
  const auto abort = [] { throw std::domain_error("enough"); };
  EXPECT_THROW(FindNeededMaximum(grid, 16.0, wall, 32, abort), std::domain_error);
}

TEST(MedialVoxelThickWalls, RaiseTheDefaultOfTheFilter)
{
  const Volume volume = MakeHollowBox(72, 22);
  const auto   makeFilter = [&] {
    auto filter = MakeMedialFilter<3>(volume, 3.0);
    filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
    return filter;
  };
  auto filter = makeFilter();
  EXPECT_EQ(filter->GetRaisedMaximumThickness(), 0.0);
  filter->UpdateLargestPossibleRegion();
  const double raised = filter->GetRaisedMaximumThickness();
  EXPECT_GE(raised, 22.0);
  const auto labels = PixelsOf(filter->GetOutput());

  auto given = makeFilter();
  given->SetMaximumThickness(raised);
  given->UpdateLargestPossibleRegion();
  EXPECT_EQ(PixelsOf(given->GetOutput()), labels);
  EXPECT_EQ(given->GetRaisedMaximumThickness(), 0.0);

  auto kept = makeFilter();
  kept->SetMaximumThickness(16.0);
  kept->UpdateLargestPossibleRegion();
  EXPECT_NE(PixelsOf(kept->GetOutput()), labels);

  auto streamed = makeFilter();
  auto streamer = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
  streamed->SetNumberOfWorkUnits(3);
  streamer->SetInput(streamed->GetOutput());
  streamer->SetNumberOfStreamDivisions(5);
  streamer->Update();
  EXPECT_EQ(PixelsOf(streamer->GetOutput()), labels);
  EXPECT_EQ(streamed->GetCounts().candidateCells, filter->GetCounts().candidateCells);

  filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Fixed);
  filter->UpdateLargestPossibleRegion();
  EXPECT_EQ(filter->GetRaisedMaximumThickness(), 0.0);
}
