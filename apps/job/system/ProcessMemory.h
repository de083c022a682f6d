// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProcessMemory_h
#define medialvoxelProcessMemory_h

#include <cstdint>
#include <filesystem>

namespace medialvoxel
{

/** Bytes that the limits of the process (ulimit -v and -d) leave it. The largest number without limits. */
std::uint64_t
GetRestOfLimits();

/** Bytes that the process can still take without swapping: the system's available memory, or less when the process
 * runs in a control group (a container, a batch job) with a limit, or has limits of its own. The largest number when
 * the system does not report it.
 *
 * \param root folder with proc and sys/fs/cgroup, for tests */
std::uint64_t
GetFreeMemory(const std::filesystem::path & root = "/");

/** Peak of the memory that the process kept resident; 0 where the system does not tell. */
std::uint64_t
GetPeakMemory();

/** Lets large blocks leave the process when they are freed, so that the peak is the one that was planned. */
void
GiveLargeBlocksBack();

} // end namespace medialvoxel

#endif
