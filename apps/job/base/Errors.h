// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelErrors_h
#define medialvoxelErrors_h

#include <sstream>
#include <stdexcept>
#include <string>

namespace medialvoxel
{

/** Exit status of the programs. A stop by a signal exits with 128 + the signal's number. */
enum class ExitStatus : int
{
  Done = 0,
  Failure = 1,      ///< failed for a reason outside the other classes
  Usage = 2,        ///< wrong or contradictory option
  Refused = 3,      ///< refused before the start: space, memory, permissions, existing output
  CorruptInput = 4, ///< input that is corrupt, inconsistent or not a scalar volume
  TooThin = 5,      ///< done, and there are thin places, which were to fail
  NotMeasured = 6   ///< done, and thin places were to fail, but too little was measured to know of any
};

/** \class JobError
 * \brief An error that ends a job, with its exit status. */
class JobError : public std::runtime_error
{
public:
  JobError(ExitStatus status, const std::string & message)
    : std::runtime_error(message)
    , m_Status(status)
  {}

  ExitStatus
  GetStatus() const
  {
    return m_Status;
  }

private:
  ExitStatus m_Status;
};

/** \class MemoryRefusal
 * \brief The job needs more memory than is allowed. */
class MemoryRefusal : public JobError
{
public:
  explicit MemoryRefusal(const std::string & message)
    : JobError(ExitStatus::Refused, message)
  {}
};

/** \class PieceMemoryError
 * \brief A piece of the volume needs more memory than is allowed; others may not. */
class PieceMemoryError : public MemoryRefusal
{
public:
  using MemoryRefusal::MemoryRefusal;
};

/** \class StoppedBySignal
 * \brief The job was asked to stop and has removed its unfinished files. */
class StoppedBySignal : public std::runtime_error
{
public:
  explicit StoppedBySignal(int signalNumber)
    : std::runtime_error("stopped, no output was written")
    , m_SignalNumber(signalNumber)
  {}

  /** Number of the signal, 0 when the caller's ProgressSink asked to stop. */
  int
  GetSignalNumber() const
  {
    return m_SignalNumber;
  }

private:
  int m_SignalNumber;
};

/** The parts of a message put together. */
template <typename... TParts>
std::string
JoinParts(const TParts &... parts)
{
  std::ostringstream message;
  (message << ... << parts);
  return message.str();
}

/** Throws JobError with the parts of the message put together. */
template <typename... TParts>
[[noreturn]] void
Fail(ExitStatus status, const TParts &... parts)
{
  throw JobError(status, JoinParts(parts...));
}

/** The same with MemoryRefusal. */
template <typename... TParts>
[[noreturn]] void
FailForMemory(const TParts &... parts)
{
  throw MemoryRefusal(JoinParts(parts...));
}

} // end namespace medialvoxel

#endif
