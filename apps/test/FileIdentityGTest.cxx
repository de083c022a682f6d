// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "FileIdentity.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>

using namespace medialvoxel;

namespace
{

/** True when a file of one time counts as the one that a job began with at another time, in nanoseconds. */
bool
IsTakenForTheSame(std::int64_t before, std::int64_t now)
{
  const TemporaryFolder folder;
  folder.Write("in.raw", "voxels");
  FileIdentity identity = IdentifyFile(folder / "in.raw");
  identity.modified = before;
  constexpr std::int64_t perSecond = 1000000000;
  const timespec         time{ now / perSecond, now % perSecond };
  const timespec         times[2] = { time, time };
  EXPECT_EQ(utimensat(AT_FDCWD, (folder / "in.raw").c_str(), times, 0), 0);
  try
  {
    CheckUnchanged({ identity });
    return true;
  }
  catch (const JobError &)
  {
    return false;
  }
}

} // namespace

TEST(FileIdentity, TimesThatAnotherMachineSeesRounded)
{
  constexpr std::int64_t time = 1795000000123456789;
  for (const std::int64_t rounded :
       { 1795000000123456789, 1795000000123456700, 1795000000123456000, 1795000000000000000 })
  {
    EXPECT_TRUE(IsTakenForTheSame(time, rounded)) << rounded;
    EXPECT_TRUE(IsTakenForTheSame(rounded, time)) << rounded;
  }
}

TEST(FileIdentity, OtherTimes)
{
  constexpr std::int64_t time = 1795000000123456789;
  for (const std::int64_t other : { 1795000000123456790,
                                    1795000000123456788,
                                    1795000000123456600,
                                    1795000000123000000,
                                    1795000001000000000,
                                    1794999999000000000,
                                    1795000001123456789 })
  {
    EXPECT_FALSE(IsTakenForTheSame(time, other)) << other;
    EXPECT_FALSE(IsTakenForTheSame(other, time)) << other;
  }
}
