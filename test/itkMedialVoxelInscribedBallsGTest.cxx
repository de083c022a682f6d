// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelInscribedBalls.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

double
LargestBallAt(const itk::MedialVoxelGrid &                       grid,
              const std::vector<itk::MedialVoxelInscribedBall> & balls,
              const itk::MedialVoxelIndex &                      cell)
{
  double largest = 0.0;
  for (const auto & ball : balls)
  {
    const double distance =
      grid.SquaredMetricLength(ball.center[0] - cell[0], ball.center[1] - cell[1], ball.center[2] - cell[2]);
    largest = distance <= ball.radius * ball.radius ? std::max(largest, ball.radius) : largest;
  }
  return largest;
}
} // namespace

TEST(MedialVoxelInscribedBalls, EachCellIsRaisedToTheLargestBallThatCoversIt)
{
  for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 0.7, 1.1, 1.3 } } })
  {
    for (const Index3 & size : { Index3{ { 150, 30, 20 } }, Index3{ { 90, 80, 1 } } })
    {
      const itk::MedialVoxelGrid                 grid(KernelIndex(size), spacing);
      std::mt19937                               generator(11);
      std::vector<itk::MedialVoxelInscribedBall> balls;
      for (int i = 0; i < 60; ++i)
      {
        const auto center = RandomBox(size, generator).lower;
        // Radii that meet distances exactly are among them.
        balls.push_back({ center, std::sqrt(static_cast<double>(1 + generator() % 60)) });
      }
      itk::MedialVoxelRankedBits cells;
      const auto                 box = MakeBox({ { 3, 2, 0 } }, { { size[0] - 2, size[1] - 1, size[2] } });
      cells.Reshape(box);
      std::vector<itk::MedialVoxelIndex> asked;
      ForEachVoxel(box, [&](const itk::MedialVoxelIndex & cell) {
        if (generator() % 3 == 0)
        {
          cells.Set(cell);
          asked.push_back(cell);
        }
      });
      cells.Rank();
      ASSERT_EQ(cells.GetNumberOfBits(), asked.size());
      // Cells without a ball of their own, with small ones, and with some that nothing raises.
      std::vector<double> own(asked.size());
      for (double & radius : own)
      {
        radius = std::sqrt(static_cast<double>(generator() % 50));
      }
      itk::MedialVoxelInscribedBalls::Workspace workspace;
      auto                                      radii = own;
      const itk::MedialVoxelInscribedBalls      cover(grid);
      cover.Survey(box, balls, workspace);
      cover.Raise(balls, cells, workspace, radii);
      std::size_t raised = 0;
      for (std::size_t i = 0; i < asked.size(); ++i)
      {
        const double largest = std::max(own[i], LargestBallAt(grid, balls, asked[i]));
        raised += largest > own[i] ? 1 : 0;
        ASSERT_EQ(radii[i], largest);
        // The survey bounds what balls can do, also after they did it.
        ASSERT_GE(itk::MedialVoxelInscribedBalls::GetLargest(asked[i], workspace),
                  LargestBallAt(grid, balls, asked[i]));
      }
      EXPECT_GT(raised, asked.size() / 20);
      EXPECT_LT(raised, asked.size());

      // The survey serves other cells in its box, too.
      itk::MedialVoxelRankedBits others;
      const auto                 part = MakeBox({ { 5, 3, 0 } }, { { size[0] / 2, size[1] / 2, size[2] } });
      others.Reshape(part);
      ForEachVoxel(part, [&](const itk::MedialVoxelIndex & cell) { others.Set(cell); });
      others.Rank();
      std::vector<double> ofOthers(others.GetNumberOfBits(), 1.5);
      cover.Raise(balls, others, workspace, ofOthers);
      ForEachVoxel(part, [&](const itk::MedialVoxelIndex & cell) {
        ASSERT_EQ(ofOthers[others.RankOf(cell)], std::max(1.5, LargestBallAt(grid, balls, cell)));
      });
    }
  }
}

TEST(MedialVoxelBallSieve, KeepsAllThatMatters)
{
  for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 0.7, 1.1, 1.3 } } })
  {
    const Index3                               size{ { 140, 40, 30 } };
    const itk::MedialVoxelGrid                 grid(KernelIndex(size), spacing);
    std::mt19937                               generator(5);
    std::vector<itk::MedialVoxelInscribedBall> balls;
    for (int i = 0; i < 400; ++i)
    {
      // The larger ones to one side.
      const auto center = RandomBox(size, generator).lower;
      balls.push_back({ center, center[0] < 40 ? 6.0 + static_cast<double>(i % 3) : 2.0 });
    }
    itk::MedialVoxelRankedBits         cells;
    std::vector<itk::MedialVoxelIndex> asked;
    cells.Reshape(grid.GetVoxelBox());
    ForEachVoxel(grid.GetVoxelBox(), [&](const itk::MedialVoxelIndex & cell) {
      if (generator() % 5 == 0)
      {
        cells.Set(cell);
        asked.push_back(cell);
      }
    });
    cells.Rank();
    const std::vector<double>                  own(asked.size(), 2.5);
    itk::MedialVoxelBallSieve::Workspace       workspace;
    itk::MedialVoxelBits                       open;
    std::vector<itk::MedialVoxelInscribedBall> kept;
    const itk::MedialVoxelBallSieve            sieve(grid);
    sieve.Survey(grid.GetVoxelBox(), balls, workspace);
    sieve.Sieve(cells, own, balls, workspace, kept, open);
    std::size_t numberOfOpenCells = 0;
    for (const itk::MedialVoxelIndex & cell : asked)
    {
      const double largest = LargestBallAt(grid, balls, cell);
      if (largest > 2.5)
      {
        ASSERT_TRUE(open.Test(cell));
        ASSERT_EQ(LargestBallAt(grid, kept, cell), largest);
      }
      numberOfOpenCells += open.Test(cell) ? 1 : 0;
    }
    EXPECT_LT(numberOfOpenCells, asked.size() / 2);
    EXPECT_LT(kept.size(), balls.size() / 2);
  }
}
