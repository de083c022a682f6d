// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "WriteBehind.h"

#include "StopListener.h"

#include <chrono>
#include <utility>

namespace medialvoxel
{

WriteBehind::WriteBehind(bool isBehind)
{
  if (isBehind)
  {
    m_Thread = std::thread([this] { this->Work(); });
  }
}

WriteBehind::~WriteBehind()
{
  if (!m_Thread.joinable())
  {
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_IsEnding = true;
  }
  m_Changed.notify_all();
  m_Thread.join();
}

void
WriteBehind::Submit(WriteFunction write)
{
  if (!m_Thread.joinable())
  {
    this->WriteNow(write);
    return;
  }
  {
    std::unique_lock<std::mutex> lock(m_Mutex);
    this->WaitForIdle(lock);
    m_Write = std::move(write);
  }
  m_Changed.notify_all();
}

void
WriteBehind::Wait()
{
  std::unique_lock<std::mutex> lock(m_Mutex);
  this->WaitForIdle(lock);
}

void
WriteBehind::WaitForIdle(std::unique_lock<std::mutex> & lock)
{
  constexpr std::chrono::milliseconds beatInterval{ 100 };
  while (!m_Changed.wait_for(lock, beatInterval, [this] { return !m_Write; }))
  {
    itk::MedialVoxelCheckAbort();
  }
  if (m_Failure)
  {
    std::rethrow_exception(std::exchange(m_Failure, nullptr));
  }
}

void
WriteBehind::Work()
{
  const StopListener           listener;
  std::unique_lock<std::mutex> lock(m_Mutex);
  for (;;)
  {
    m_Changed.wait(lock, [this] { return m_Write || m_IsEnding; });
    if (!m_Write)
    {
      return;
    }
    lock.unlock();
    std::exception_ptr failure;
    try
    {
      this->WriteNow(m_Write);
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    lock.lock();
    m_Failure = failure;
    m_Write = nullptr;
    m_Changed.notify_all();
  }
}

void
WriteBehind::WriteNow(const WriteFunction & write)
{
  const auto start = std::chrono::steady_clock::now();
  write();
  m_Seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // end namespace medialvoxel
