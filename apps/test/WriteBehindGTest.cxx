// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "WriteBehind.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <vector>

using medialvoxel::WriteBehind;

TEST(WriteBehind, WritesEachOnceAndInOrder)
{
  for (const bool isBehind : { false, true })
  {
    std::vector<int> written;
    WriteBehind      writer(isBehind);
    for (int piece = 0; piece < 100; ++piece)
    {
      writer.Submit([&written, piece] { written.push_back(piece); });
    }
    writer.Wait();
    ASSERT_EQ(written.size(), 100u);
    for (int piece = 0; piece < 100; ++piece)
    {
      EXPECT_EQ(written[piece], piece);
    }
    EXPECT_GT(writer.GetSeconds(), 0.0);
  }
}

TEST(WriteBehind, LetsTheNextPieceBeComputedMeanwhile)
{
  WriteBehind        writer(true);
  std::promise<void> computed;
  std::atomic<bool>  isWritten{ false };
  writer.Submit([&] {
    computed.get_future().wait();
    isWritten = true;
  });
  EXPECT_FALSE(isWritten);
  computed.set_value();
  writer.Wait();
  EXPECT_TRUE(isWritten);
}

TEST(WriteBehind, ReturnsWhenTheOneBeforeHasEnded)
{
  std::atomic<int> underWay{ 0 };
  std::atomic<int> done{ 0 };
  WriteBehind      writer(true);
  for (int piece = 0; piece < 50; ++piece)
  {
    writer.Submit([&] {
      EXPECT_EQ(++underWay, 1);
      --underWay;
      ++done;
    });
    EXPECT_GE(done, piece);
  }
}

TEST(WriteBehind, IsOverWhenItIsDestroyed)
{
  bool isWritten = false;
  {
    WriteBehind writer(true);
    writer.Submit([&] { isWritten = true; });
  }
  EXPECT_TRUE(isWritten);
}

TEST(WriteBehind, TellsOfAFailureOnce)
{
  const auto  fail = [] { throw std::runtime_error("the disk is full"); };
  bool        isWritten = false;
  WriteBehind writer(true);
  writer.Submit(fail);
  EXPECT_THROW(writer.Submit([&] { isWritten = true; }), std::runtime_error);
  EXPECT_FALSE(isWritten);
  writer.Wait();
  writer.Submit(fail);
  EXPECT_THROW(writer.Wait(), std::runtime_error);
  writer.Submit([&] { isWritten = true; });
  writer.Wait();
  EXPECT_TRUE(isWritten);
  EXPECT_THROW(WriteBehind(false).Submit(fail), std::runtime_error);
}

TEST(WriteBehind, AFailureThatNobodyAskedForIsForgotten)
{
  WriteBehind writer(true);
  writer.Submit([] { throw std::runtime_error("the disk is full"); });
}
