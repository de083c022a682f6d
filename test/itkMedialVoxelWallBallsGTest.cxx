// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Regions whose balls are known, so that no wall is measured twice.

#include "itkMedialVoxelWallBalls.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{
using namespace MedialVoxelTest;

class MedialVoxelWallBalls : public ::testing::Test
{
protected:
  static itk::MedialVoxelLocalThickness
  GetSettings()
  {
    itk::MedialVoxelLocalThickness settings;
    settings.maximumThickness = 9.0;
    settings.walls.emplace();
    settings.walls->parameters =
      itk::MedialVoxelParameters::ForThickness(3.0, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
    return settings;
  }

  static itk::MedialVoxelBox
  Slices(const std::int64_t first, const std::int64_t end, const std::int64_t rows = 30)
  {
    return { { { 0, 0, first } }, { { 20, rows, end } } };
  }

  void
  Extract(const itk::MedialVoxelBox & region)
  {
    m_Balls.BeginRegion(region);
    m_Balls.Begin();
    m_Balls.Commit();
  }

  std::vector<itk::MedialVoxelBox>
  FindMissing(const itk::MedialVoxelBox & cells) const
  {
    return m_Balls.FindMissing(cells);
  }

  using Boxes = std::vector<itk::MedialVoxelBox>;

  itk::MedialVoxelWallBalls m_Balls{ itk::MedialVoxelGrid({ { 20, 30, 90 } }, { { 1.0, 1.0, 1.0 } }), GetSettings() };
};

TEST_F(MedialVoxelWallBalls, OfNoRegionAreMissing)
{
  EXPECT_EQ(this->FindMissing(Slices(10, 40)), Boxes{ Slices(10, 40) });
  // A ball of a radius of 4.5 voxels, around a center between voxels.
  EXPECT_EQ(m_Balls.GetMargin(), 6u);
}

TEST_F(MedialVoxelWallBalls, OfRegionsThatFollowAreKnownOnce)
{
  this->Extract(Slices(10, 40));
  EXPECT_TRUE(this->FindMissing(Slices(12, 40, 5)).empty());
  EXPECT_EQ(this->FindMissing(Slices(4, 40)), Boxes{ Slices(4, 10) });
  EXPECT_EQ(this->FindMissing(Slices(30, 46)), Boxes{ Slices(40, 46) });
  EXPECT_EQ(this->FindMissing(Slices(0, 90, 5)), (Boxes{ Slices(0, 10), Slices(40, 90) })) << "as wide as the others";
  this->Extract(Slices(35, 60));
  EXPECT_TRUE(this->FindMissing(Slices(10, 60)).empty());
  this->Extract(Slices(5, 10));
  EXPECT_TRUE(this->FindMissing(Slices(5, 60)).empty());
}

TEST_F(MedialVoxelWallBalls, OfOtherRegionsAreForgotten)
{
  this->Extract(Slices(10, 40));
  m_Balls.DropBefore(Slices(25, 50));
  EXPECT_EQ(this->FindMissing(Slices(20, 40)), Boxes{ Slices(20, 25) });
  // Apart from the region, or not as wide.
  this->Extract(Slices(41, 50));
  EXPECT_EQ(this->FindMissing(Slices(40, 50)), Boxes{ Slices(40, 41) });
  this->Extract(Slices(50, 60, 10));
  EXPECT_EQ(this->FindMissing(Slices(45, 60)), Boxes{ Slices(45, 60) });
  m_Balls.DropBefore(Slices(70, 80));
  EXPECT_EQ(this->FindMissing(Slices(50, 60, 10)), (Boxes{ Slices(50, 60, 10) }));
}

} // namespace
