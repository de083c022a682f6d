// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobClock_h
#define medialvoxelJobClock_h

#include <chrono>

namespace medialvoxel
{

using JobClock = std::chrono::steady_clock;

inline double
SecondsSince(JobClock::time_point start)
{
  return std::chrono::duration<double>(JobClock::now() - start).count();
}

} // end namespace medialvoxel

#endif
