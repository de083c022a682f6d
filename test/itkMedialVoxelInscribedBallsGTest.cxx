// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelInscribedBalls.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;
} // namespace

TEST(MedialVoxelInscribedBalls, EachCellGetsTheLargestBallThatCoversIt)
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
      itk::MedialVoxelRankedBits         cells;
      const auto                         box = MakeBox({ { 3, 2, 0 } }, { { size[0] - 2, size[1] - 1, size[2] } });
      itk::MedialVoxelBits &             bits = cells.Reshape(box);
      std::vector<itk::MedialVoxelIndex> asked;
      ForEachVoxel(box, [&](const itk::MedialVoxelIndex & cell) {
        if (generator() % 3 == 0)
        {
          bits.Set(cell);
          asked.push_back(cell);
        }
      });
      cells.Rank();
      ASSERT_EQ(cells.GetNumberOfBits(), asked.size());
      itk::MedialVoxelInscribedBalls::Workspace workspace;
      std::vector<double>                       radii;
      itk::MedialVoxelInscribedBalls(grid).Cover(balls, cells, workspace, radii);
      std::size_t covered = 0;
      for (std::size_t i = 0; i < asked.size(); ++i)
      {
        double largest = 0.0;
        for (const auto & ball : balls)
        {
          const double distance = grid.SquaredMetricLength(
            ball.center[0] - asked[i][0], ball.center[1] - asked[i][1], ball.center[2] - asked[i][2]);
          largest = distance <= ball.radius * ball.radius ? std::max(largest, ball.radius) : largest;
        }
        covered += largest > 0.0 ? 1 : 0;
        ASSERT_EQ(radii[i], largest);
      }
      EXPECT_GT(covered, asked.size() / 20);
      EXPECT_LT(covered, asked.size());
    }
  }
}
