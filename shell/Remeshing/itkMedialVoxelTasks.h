// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTasks_h
#define itkMedialVoxelTasks_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace itk
{

/** Calls task(number, check) for all numbers below a count, in any order and at the same time. Tasks call check()
 * often, which may throw to stop. */
using MedialVoxelTask = std::function<void(std::size_t number, const std::function<void()> & check)>;
using MedialVoxelRunTasks = std::function<void(std::size_t count, const MedialVoxelTask & task)>;

/** One after the other. */
inline void
MedialVoxelRunInOrder(const std::size_t count, const MedialVoxelTask & task)
{
  for (std::size_t number = 0; number < count; ++number)
  {
    task(number, [] {});
  }
}

/** Calls function(number) for all numbers below a count of at most 2^32, for a block of them in each task. */
template <typename TFunction>
void
MedialVoxelForEach(const MedialVoxelRunTasks & runTasks, const std::size_t count, const TFunction & function)
{
  constexpr std::size_t block = 128;
  runTasks((count + block - 1) / block, [&](const std::size_t task, const std::function<void()> & check) {
    check();
    for (std::size_t number = task * block; number < std::min(count, (task + 1) * block); ++number)
    {
      function(static_cast<std::uint32_t>(number));
    }
  });
}

} // end namespace itk

#endif
