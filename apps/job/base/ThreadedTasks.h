// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelThreadedTasks_h
#define medialvoxelThreadedTasks_h

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace medialvoxel
{

/** Calls task(number) for the numbers below \a count, in all threads of the plan or in so many at most. Each thread
 * takes the next number when it is free, since some tasks take much longer than others. \throw the last error of a task
 */
inline void
RunInThreads(const std::size_t                        count,
             const std::function<void(std::size_t)> & task,
             const std::size_t                        mostThreads = std::size_t{ 1 } << 16)
{
  std::exception_ptr error;
  std::mutex         mutex;
  std::size_t        taken = 0;
  const auto         takeTasks = [&](itk::SizeValueType) {
    for (;;)
    {
      std::unique_lock<std::mutex> lock(mutex);
      if (error || taken == count)
      {
        return;
      }
      const std::size_t number = taken++;
      lock.unlock();
      try
      {
        task(number);
      }
      catch (...)
      {
        lock.lock();
        error = std::current_exception();
      }
    }
  };
  const auto        threader = itk::MultiThreaderBase::New();
  const std::size_t threads = std::min({ count, mostThreads, std::size_t{ threader->GetNumberOfWorkUnits() } });
  if (threads > 1)
  {
    threader->ParallelizeArray(0, threads, takeTasks, nullptr);
  }
  else
  {
    takeTasks(0);
  }
  if (error)
  {
    std::rethrow_exception(error);
  }
}

} // end namespace medialvoxel

#endif
