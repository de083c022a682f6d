// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTaskRunner_h
#define medialvoxelTaskRunner_h

#include "OrderedWork.h"

#include "itkMedialVoxelTasks.h"

namespace medialvoxel
{

/** Runs tasks in threads. \param check called ten times a second; may throw to stop */
inline itk::MedialVoxelRunTasks
MakeTaskRunner(const unsigned int threads, std::function<void()> check)
{
  return [threads, check = std::move(check)](const std::size_t count, const itk::MedialVoxelTask & task) {
    struct Nothing
    {};
    OrderedWork<Nothing>::Run(
      count,
      threads,
      [&task](const std::uint64_t number, const std::function<void()> & checkTask) {
        task(number, checkTask);
        return Nothing{};
      },
      [](std::uint64_t, Nothing &&) {},
      check);
  };
}

} // end namespace medialvoxel

#endif
