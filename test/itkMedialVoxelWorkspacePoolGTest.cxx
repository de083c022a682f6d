// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelWorkspacePool.h"

#include <gtest/gtest.h>

namespace
{
/** Counts those that are alive. */
struct CountedWorkspace : public itk::MedialVoxelTileTask::Workspace
{
  explicit CountedWorkspace(int & alive)
    : m_Alive(alive)
  {
    ++m_Alive;
  }
  ~CountedWorkspace() override { --m_Alive; }

  int & m_Alive;
};
} // namespace

TEST(MedialVoxelWorkspacePool, KeepsThoseOfTheLatestLayout)
{
  int                           alive = 0;
  itk::MedialVoxelWorkspacePool pool;
  EXPECT_EQ(pool.Take(1), nullptr);
  auto         first = std::make_unique<CountedWorkspace>(alive);
  const auto * address = first.get();
  pool.Return(std::move(first), 1);
  EXPECT_EQ(alive, 1);

  // Tiles of the next layout begin while one of this layout still runs.
  auto again = pool.Take(1);
  EXPECT_EQ(again.get(), address);
  EXPECT_EQ(pool.Take(1), nullptr);
  EXPECT_EQ(pool.Take(2), nullptr);
  pool.Return(std::move(again), 1);
  EXPECT_EQ(alive, 0);
  EXPECT_EQ(pool.Take(1), nullptr);

  pool.Return(std::make_unique<CountedWorkspace>(alive), 2);
  EXPECT_EQ(pool.Take(1), nullptr);
  EXPECT_EQ(alive, 1);
  EXPECT_EQ(pool.Take(3), nullptr);
  EXPECT_EQ(alive, 0);
}

TEST(MedialVoxelWorkspacePool, FreesWhatIsTooMany)
{
  int                           alive = 0;
  itk::MedialVoxelWorkspacePool pool;
  EXPECT_EQ(pool.Take(1), nullptr);
  for (int i = 0; i < 3; ++i)
  {
    pool.Return(std::make_unique<CountedWorkspace>(alive), 1);
  }
  pool.KeepAtMost(5);
  EXPECT_EQ(alive, 3);
  pool.KeepAtMost(2);
  EXPECT_EQ(alive, 2);
  EXPECT_NE(pool.Take(1), nullptr);
  pool.KeepAtMost(0);
  EXPECT_EQ(alive, 0);
}
