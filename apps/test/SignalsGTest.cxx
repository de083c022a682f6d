// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "AbortNotice.h"
#include "Signals.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

namespace
{
using medialvoxel::AbortNotice;
using medialvoxel::ExitStatus;
using medialvoxel::SetNameForAborts;

TEST(AbortNoticeDeathTest, AnAbortEndsWithItsLine)
{
  const auto abortWithNotice = [] {
    SetNameForAborts("program");
    const AbortNotice notice(static_cast<int>(ExitStatus::CorruptInput), "a\nfile is damaged");
    std::abort();
  };
  EXPECT_EXIT(abortWithNotice(), testing::ExitedWithCode(4), "program: a.*file is damaged");
}

TEST(AbortNoticeDeathTest, OnlyItsThreadAndItsTimeCount)
{
  const auto abortAfterNotice = [] {
    {
      const AbortNotice notice(static_cast<int>(ExitStatus::CorruptInput), "over");
    }
    std::abort();
  };
  EXPECT_EXIT(abortAfterNotice(), testing::KilledBySignal(SIGABRT), "^$");
  const auto abortElsewhere = [] {
    const AbortNotice notice(static_cast<int>(ExitStatus::CorruptInput), "of another thread");
    std::thread([] { std::abort(); }).join();
  };
  EXPECT_EXIT(abortElsewhere(), testing::KilledBySignal(SIGABRT), "^$");
}

} // namespace
