// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOrderedWork_h
#define medialvoxelOrderedWork_h

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** \class OrderedWork
 * \brief Makes results in threads, and takes them in their order in the thread that asks for them.
 *
 * Two results for each thread are held at most. */
template <typename TResult>
class OrderedWork
{
public:
  /** Throws when the work is to end; for any thread. */
  using Check = std::function<void()>;
  using Make = std::function<TResult(std::uint64_t number, const Check & check)>;
  using Take = std::function<void(std::uint64_t number, TResult && result)>;

  /** \param check called ten times a second by this thread; may throw to stop
   * \throw the first error of \a make, \a take or \a check */
  static void
  Run(std::uint64_t count, unsigned int threads, const Make & make, const Take & take, const Check & check)
  {
    OrderedWork              work(count, threads, make);
    std::vector<std::thread> workers;
    for (std::uint64_t number = 0; number < std::min<std::uint64_t>(threads, count); ++number)
    {
      workers.emplace_back([&work] { work.Work(); });
    }
    std::exception_ptr error;
    try
    {
      work.TakeAll(take, check);
    }
    catch (...)
    {
      error = std::current_exception();
    }
    work.End();
    for (std::thread & worker : workers)
    {
      worker.join();
    }
    if (error)
    {
      std::rethrow_exception(error);
    }
  }

private:
  struct Ended
  {};

  OrderedWork(std::uint64_t count, unsigned int threads, const Make & make)
    : m_Count(count)
    , m_MostAhead(2 * std::uint64_t{ threads })
    , m_Make(make)
  {}

  void
  Work()
  {
    std::unique_lock<std::mutex> lock(m_Mutex);
    for (;;)
    {
      m_Changed.wait(lock, [this] { return m_IsEnded || m_Started == m_Count || m_Started < m_Taken + m_MostAhead; });
      if (m_IsEnded || m_Started == m_Count)
      {
        return;
      }
      const std::uint64_t number = m_Started++;
      lock.unlock();
      try
      {
        TResult result = m_Make(number, [this] {
          if (m_IsEnded)
          {
            throw Ended{};
          }
        });
        lock.lock();
        m_Results.emplace(number, std::move(result));
      }
      catch (...)
      {
        if (!lock.owns_lock())
        {
          lock.lock();
        }
        m_Error = m_Error ? m_Error : std::current_exception();
        m_Changed.notify_all();
        return;
      }
      m_Changed.notify_all();
    }
  }

  void
  TakeAll(const Take & take, const Check & check)
  {
    while (m_Taken < m_Count)
    {
      std::unique_lock<std::mutex> lock(m_Mutex);
      m_Changed.wait_for(
        lock, std::chrono::milliseconds(100), [this] { return m_Error || m_Results.count(m_Taken) > 0; });
      if (m_Error)
      {
        std::rethrow_exception(m_Error);
      }
      const auto found = m_Results.find(m_Taken);
      if (found == m_Results.end())
      {
        lock.unlock();
        check();
        continue;
      }
      TResult result = std::move(found->second);
      m_Results.erase(found);
      lock.unlock();
      take(m_Taken, std::move(result));
      check();
      lock.lock();
      ++m_Taken;
      m_Changed.notify_all();
    }
  }

  void
  End()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_IsEnded = true;
    m_Changed.notify_all();
  }

  const std::uint64_t              m_Count;
  const std::uint64_t              m_MostAhead;
  const Make &                     m_Make;
  std::mutex                       m_Mutex;
  std::condition_variable          m_Changed;
  std::map<std::uint64_t, TResult> m_Results;
  std::uint64_t                    m_Started{ 0 };
  std::uint64_t                    m_Taken{ 0 };
  std::exception_ptr               m_Error;
  std::atomic<bool>                m_IsEnded{ false };
};

} // end namespace medialvoxel

#endif
