// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobLocks_h
#define medialvoxelJobLocks_h

#include "SystemFile.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

namespace medialvoxel
{

/** \class JobLocks
 * \brief Divides the work among the processes of a job: one byte of a file for each task that is done once.
 *
 * The system returns a lock when its process ends, however it ends, so clocks and times do not matter. Where the
 * file system has no locks everyone gets them: then two processes may do the same work and write the same bytes. */
class JobLocks
{
public:
  /** Things that are no clusters. */
  static constexpr std::uint64_t Planning = std::uint64_t{ 1 } << 40;
  static constexpr std::uint64_t Finalizing = Planning + 1;

  /** \class Lock
   * \brief Is held until it ends. */
  class Lock
  {
  public:
    /** \param file null: nothing is to be given back */
    Lock(SystemFile * file, std::uint64_t thing)
      : m_File(file)
      , m_Thing(thing)
    {}
    ~Lock();
    Lock(Lock && other) noexcept
      : m_File(std::exchange(other.m_File, nullptr))
      , m_Thing(other.m_Thing)
    {}
    Lock &
    operator=(Lock &&) = delete;

  private:
    SystemFile *  m_File;
    std::uint64_t m_Thing;
  };

  /** Opens the file, which is created when it is not there. \throw JobError Failure */
  explicit JobLocks(const std::filesystem::path & fileName);
  JobLocks(const JobLocks &) = delete;
  JobLocks &
  operator=(const JobLocks &) = delete;

  /** Nothing when another process has it. Must not outlive this object.
   * \throw JobError Failure when it is not known whether another has it */
  std::optional<Lock>
  TryLock(std::uint64_t thing);

private:
  std::filesystem::path m_FileName;
  SystemFile            m_File;
};

/** True when a process has it; false when none has or the file is not there. */
bool
IsLocked(const std::filesystem::path & fileName, std::uint64_t thing);

} // end namespace medialvoxel

#endif
