// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWriteBehind_h
#define medialvoxelWriteBehind_h

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace medialvoxel
{

/** \class WriteBehind
 * \brief Writes in a thread of its own, so that the next piece is computed in the meantime.
 *
 * One write is under way at a time: Submit() returns when the one before has ended. */
class WriteBehind
{
public:
  using WriteFunction = std::function<void()>;

  /** \param isBehind false: Submit() writes before it returns, and there is no thread */
  explicit WriteBehind(bool isBehind);

  /** Waits for the write that is under way. */
  ~WriteBehind();

  WriteBehind(const WriteBehind &) = delete;
  WriteBehind &
  operator=(const WriteBehind &) = delete;

  /** Starts \a write, whose data must stay until the next call returns. Throws the error of an earlier write. */
  void
  Submit(WriteFunction write);

  /** Waits for the last write. Throws its error. */
  void
  Wait();

  /** Time that the writes took; to be asked when nothing is under way. */
  double
  GetSeconds() const
  {
    return m_Seconds;
  }

private:
  void
  Work();

  void
  WriteNow(const WriteFunction & write);

  void
  WaitForIdle(std::unique_lock<std::mutex> & lock);

  double                  m_Seconds{ 0.0 };
  std::mutex              m_Mutex;
  std::condition_variable m_Changed;
  WriteFunction           m_Write; ///< under way, or empty
  std::exception_ptr      m_Failure;
  bool                    m_IsEnding{ false };
  std::thread             m_Thread; ///< the last member, as it uses the others
};

} // end namespace medialvoxel

#endif
