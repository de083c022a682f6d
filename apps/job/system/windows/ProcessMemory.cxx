// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ProcessMemory.h"

#include "WindowsError.h"

#include <algorithm>
#include <limits>
#include <psapi.h>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t Unknown = std::numeric_limits<std::uint64_t>::max();

PROCESS_MEMORY_COUNTERS
GetCounters()
{
  PROCESS_MEMORY_COUNTERS counters = {};
  GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof(counters));
  return counters;
}

} // namespace

std::uint64_t
GetRestOfLimits()
{
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION job = {};
  if (QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &job, sizeof(job), nullptr) == 0)
  {
    return Unknown;
  }
  const DWORD   flags = job.BasicLimitInformation.LimitFlags;
  std::uint64_t limit = Unknown;
  if ((flags & JOB_OBJECT_LIMIT_PROCESS_MEMORY) != 0)
  {
    limit = job.ProcessMemoryLimit;
  }
  if ((flags & JOB_OBJECT_LIMIT_JOB_MEMORY) != 0)
  {
    limit = std::min<std::uint64_t>(limit, job.JobMemoryLimit);
  }
  return limit == Unknown ? Unknown : limit - std::min<std::uint64_t>(limit, GetCounters().PagefileUsage);
}

std::uint64_t
GetFreeMemory(const std::filesystem::path &)
{
  MEMORYSTATUSEX memory = {};
  memory.dwLength = sizeof(memory);
  const bool isKnown = GlobalMemoryStatusEx(&memory) != 0;
  // What is committed counts, whether or not it was touched.
  const std::uint64_t free = isKnown ? std::min(memory.ullAvailPhys, memory.ullAvailPageFile) : Unknown;
  return std::min(free, GetRestOfLimits());
}

std::uint64_t
GetPeakMemory()
{
  return GetCounters().PeakWorkingSetSize;
}

void
GiveLargeBlocksBack()
{}

} // end namespace medialvoxel
