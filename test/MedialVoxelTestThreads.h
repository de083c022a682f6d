// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MedialVoxelTestThreads_h
#define MedialVoxelTestThreads_h

#include <functional>
#include <thread>
#include <vector>

namespace MedialVoxelTest
{

/** Runs the work in the calling thread, and in as many others as make the number. */
inline void
RunInThreads(const unsigned int number, const std::function<void()> & work)
{
  std::vector<std::thread> threads;
  for (unsigned int i = 1; i < number; ++i)
  {
    threads.emplace_back(work);
  }
  work();
  for (std::thread & thread : threads)
  {
    thread.join();
  }
}

} // end namespace MedialVoxelTest

#endif
