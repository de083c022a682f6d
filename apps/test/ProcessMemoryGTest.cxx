// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ProcessMemory.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <limits>

using namespace medialvoxel;

namespace
{

/** A machine with 8 GiB available. */
class Machine
{
public:
  Machine() { this->Write("proc/meminfo", "MemTotal:       16777216 kB\nMemAvailable:    8388608 kB\n"); }

  void
  Write(const std::string & name, const std::string & content) const
  {
    std::filesystem::create_directories((m_Folder / name).parent_path());
    m_Folder.Write(name, content);
  }

  std::uint64_t
  GetFree() const
  {
    return GetFreeMemory(m_Folder / "");
  }

private:
  TemporaryFolder m_Folder;
};

constexpr std::uint64_t GiB = std::uint64_t{ 1 } << 30;

} // namespace

TEST(ProcessMemory, IsWhatTheSystemHasAvailable)
{
  const Machine machine;
  EXPECT_EQ(machine.GetFree(), 8 * GiB);
}

TEST(ProcessMemory, IsUnknownWhereTheSystemDoesNotTell)
{
  const TemporaryFolder folder;
  EXPECT_EQ(GetFreeMemory(folder / ""), std::numeric_limits<std::uint64_t>::max());
}

TEST(ProcessMemory, AControlGroupMayAllowLess)
{
  const Machine machine;
  machine.Write("proc/self/cgroup", "0::/jobs/17\n");
  machine.Write("sys/fs/cgroup/jobs/memory.max", "4294967296\n");
  machine.Write("sys/fs/cgroup/jobs/memory.current", "1073741824\n");
  machine.Write("sys/fs/cgroup/jobs/17/memory.max", "max\n");
  machine.Write("sys/fs/cgroup/jobs/17/memory.current", "1073741824\n");
  EXPECT_EQ(machine.GetFree(), 3 * GiB);
}

TEST(ProcessMemory, AContainerSeesItsOwnGroupAtTheTop)
{
  const Machine machine;
  machine.Write("proc/self/cgroup", "0::/\n");
  machine.Write("sys/fs/cgroup/memory.max", "1073741824\n");
  machine.Write("sys/fs/cgroup/memory.current", "2147483648\n");
  EXPECT_EQ(machine.GetFree(), 0u);
}

TEST(ProcessMemory, ControlGroupsOfTheFirstVersionCountToo)
{
  const Machine machine;
  machine.Write("proc/self/cgroup", "5:cpu,cpuacct:/a\n4:memory:/a\n");
  machine.Write("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "3221225472\n");
  machine.Write("sys/fs/cgroup/memory/a/memory.usage_in_bytes", "1073741824\n");
  EXPECT_EQ(machine.GetFree(), 2 * GiB);
}
