// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ProcessMemory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <sys/resource.h>
#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t Unknown = std::numeric_limits<std::uint64_t>::max();

/** The bytes of the line of a table in KiB that begins with \a name; nothing when there is none. */
std::optional<std::uint64_t>
ReadKibibytes(const std::filesystem::path & file, const std::string & name)
{
  std::ifstream information(file);
  std::string   line;
  while (std::getline(information, line))
  {
    std::istringstream parts(line);
    std::string        word;
    std::uint64_t      number = 0;
    if (parts >> word >> number && word == name)
    {
      return number * 1024;
    }
  }
  return std::nullopt;
}

std::uint64_t
GetAvailableOnSystem(const std::filesystem::path & root)
{
  return ReadKibibytes(root / "proc/meminfo", "MemAvailable:").value_or(Unknown);
}

/** The number in a file; nothing when there is none, as in "max". */
std::optional<std::uint64_t>
ReadNumber(const std::filesystem::path & file)
{
  std::ifstream stream(file);
  std::uint64_t number = 0;
  return stream >> number ? std::optional<std::uint64_t>(number) : std::nullopt;
}

/** Rest of the limit of one control group. */
std::uint64_t
GetRest(const std::filesystem::path & group, const char * limitName, const char * usageName)
{
  const auto limit = ReadNumber(group / limitName);
  const auto usage = ReadNumber(group / usageName);
  return limit && usage ? *limit - std::min(*limit, *usage) : Unknown;
}

/** Smallest rest of a control group and its parents; a container hides the outer ones. */
std::uint64_t
GetRestOfGroups(const std::filesystem::path & top, const std::string & name, const char * limit, const char * usage)
{
  std::uint64_t         rest = GetRest(top, limit, usage);
  std::filesystem::path group = top;
  for (const std::filesystem::path & part : std::filesystem::path(name).relative_path())
  {
    group /= part;
    rest = std::min(rest, GetRest(group, limit, usage));
  }
  return rest;
}

std::uint64_t
GetAvailableInGroups(const std::filesystem::path & root)
{
  const std::filesystem::path top = root / "sys/fs/cgroup";
  std::ifstream               groups(root / "proc/self/cgroup");
  std::uint64_t               rest = Unknown;
  std::string                 line;
  while (std::getline(groups, line))
  {
    // Number, controllers and name between colons; version 2 has no controllers.
    const auto first = line.find(':');
    const auto second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos)
    {
      continue;
    }
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string name = line.substr(second + 1);
    if (controllers == ",,")
    {
      rest = std::min(rest, GetRestOfGroups(top, name, "memory.max", "memory.current"));
    }
    else if (controllers.find(",memory,") != std::string::npos)
    {
      rest = std::min(rest, GetRestOfGroups(top / "memory", name, "memory.limit_in_bytes", "memory.usage_in_bytes"));
    }
  }
  return rest;
}

/** \param resource of a type that differs between systems
 * \param usageName of the line of /proc/self/status that counts towards the limit */
template <typename TResource>
std::uint64_t
GetRestOfLimit(TResource resource, const std::string & usageName)
{
  rlimit limit = {};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
  {
    return Unknown;
  }
  const std::uint64_t usage = ReadKibibytes("/proc/self/status", usageName).value_or(0);
  return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, usage);
}

} // namespace

std::uint64_t
GetRestOfLimits()
{
  return std::min(GetRestOfLimit(RLIMIT_AS, "VmSize:"), GetRestOfLimit(RLIMIT_DATA, "VmData:"));
}

std::uint64_t
GetFreeMemory(const std::filesystem::path & root)
{
  return std::min({ GetAvailableOnSystem(root), GetAvailableInGroups(root), GetRestOfLimits() });
}

std::uint64_t
GetPeakMemory()
{
  return ReadKibibytes("/proc/self/status", "VmHWM:").value_or(0);
}

void
GiveLargeBlocksBack()
{
#ifdef M_MMAP_THRESHOLD
  constexpr int largeBlock = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, largeBlock);
#endif
}

} // end namespace medialvoxel
