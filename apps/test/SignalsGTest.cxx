// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "AbortNotice.h"
#include "Signals.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <thread>

namespace
{
using medialvoxel::AbortNotice;
using medialvoxel::ExitStatus;
using medialvoxel::SetNameForAborts;

#ifdef _WIN32
const auto Aborted = testing::ExitedWithCode(3);
#else
const auto Aborted = testing::KilledBySignal(SIGABRT);
#endif

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
  EXPECT_EXIT(abortAfterNotice(), Aborted, "^$");
  const auto abortElsewhere = [] {
    const AbortNotice notice(static_cast<int>(ExitStatus::CorruptInput), "of another thread");
    std::thread([] { std::abort(); }).join();
  };
  EXPECT_EXIT(abortElsewhere(), Aborted, "^$");
}

} // namespace
