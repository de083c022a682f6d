// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelLocalThreshold.h"
#include "itkMedialVoxelReachingVoxels.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

std::vector<Volume>
Volumes()
{
  const Vector3       unequal{ { 0.7, 1.1, 1.3 } };
  std::vector<Volume> volumes;
  volumes.push_back(RandomBoxes({ { 150, 40, 36 } }, UnitSpacing, 30, 811));
  volumes.push_back(RandomBoxes({ { 90, 40, 30 } }, unequal, 25, 812));
  volumes.push_back(RandomVolume({ { 70, 30, 30 } }, UnitSpacing, 0.97, 813));
  volumes.push_back(RandomBoxes({ { 100, 90, 1 } }, unequal, 20, 814));
  volumes.push_back(Complement(Volume({ { 40, 30, 20 } }, UnitSpacing)));
  return volumes;
}
} // namespace

TEST(MedialVoxelReachingVoxels, KeepTheCornersOfAllCellsWhoseBallsReach)
{
  std::size_t reaching = 0;
  std::size_t leftOut = 0;
  std::size_t smaller = 0;
  for (const Volume & volume : Volumes())
  {
    const itk::MedialVoxelGrid grid = GridOf(volume);
    const auto                 image = grid.GetVoxelBox();
    const auto                 object = ObjectBits(volume, image);
    const auto                 sites = SiteBits(BoundarySites(volume), image);
    itk::MedialVoxelFeatures   features;
    {
      itk::MedialVoxelFeatureTransform::Workspace workspace;
      EXPECT_TRUE(
        itk::MedialVoxelFeatureTransform(grid).Compute({ &object, &sites }, image, workspace, features).IsEmpty());
    }
    const auto parameters =
      itk::MedialVoxelParameters::ForWalls(0.5, 40.0, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
    const itk::MedialVoxelLocalThreshold threshold(grid, parameters);
    std::mt19937                         generator(3);
    for (int trial = 0; trial < 4; ++trial)
    {
      const auto cells = RandomBox(volume.size, generator).Intersection(grid.GetCellBox());
      const auto voxels = cells.Expanded({ { 14, 14, 14 } }).Intersection(image);
      itk::MedialVoxelReachingVoxels::Workspace workspace;
      itk::MedialVoxelReachingVoxels(grid).Find(object, cells, voxels, workspace);
      const auto isKept = [&](const itk::MedialVoxelIndex & voxel) {
        return !voxels.Contains(voxel) ||
               (workspace.box.Contains(voxel) && (!object.Test(voxel) || workspace.asked.Test(voxel)));
      };
      ForEachVoxel(voxels.Intersection(grid.GetCellBox()), [&](const itk::MedialVoxelIndex & cell) {
        const double radius = threshold.FindRadius(features, cell);
        // The nearest of the cells.
        itk::MedialVoxelIndex way{};
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          way[axis] = std::clamp(cell[axis], cells.lower[axis], cells.upper[axis] - 1) - cell[axis];
        }
        if (cells.IsEmpty() || grid.SquaredMetricLength(way[0], way[1], way[2]) > radius * radius || radius == 0.0)
        {
          return;
        }
        ++reaching;
        const auto unit = grid.GetUnitMargin();
        ForEachVoxel({ cell, { { cell[0] + unit[0] + 1, cell[1] + unit[1] + 1, cell[2] + unit[2] + 1 } } },
                     [&](const itk::MedialVoxelIndex & corner) { ASSERT_TRUE(isKept(corner)); });
      });
      ForEachVoxel(voxels, [&](const itk::MedialVoxelIndex & voxel) {
        ASSERT_LE(workspace.asked.Test(voxel), object.Test(voxel));
        ASSERT_LE(workspace.reaching.Test(voxel), workspace.asked.Test(voxel));
        ASSERT_LE(workspace.asked.Test(voxel), workspace.box.Contains(voxel));
        smaller += !workspace.box.Contains(voxel) ? 1 : 0;
        leftOut += object.Test(voxel) && !workspace.asked.Test(voxel) ? 1 : 0;
      });
    }
  }
  EXPECT_GT(reaching, 1000u);
  EXPECT_GT(leftOut, 1000u);
  EXPECT_GT(smaller, 1000u);
}
