// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelExecution.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace itk
{

namespace
{

using ClockType = std::chrono::steady_clock;

double
SecondsSince(const ClockType::time_point & start)
{
  return std::chrono::duration<double>(ClockType::now() - start).count();
}

} // namespace

MedialVoxelExecution::MedialVoxelExecution(const MedialVoxelBox &      region,
                                           const MedialVoxelTileTask & task,
                                           MedialVoxelSlabWalker &     walker,
                                           MedialVoxelObjectSource &   source,
                                           MedialVoxelEngineClient &   client,
                                           MedialVoxelWorkspacePool &  workspaces)
  : m_Region(region)
  , m_Task(task)
  , m_Walker(walker)
  , m_Source(source)
  , m_Client(client)
  , m_CallingThread(std::this_thread::get_id())
  , m_Workspaces(workspaces)
{}

MedialVoxelSums
MedialVoxelExecution::Run(const MedialVoxelBox & nextRegion)
{
  const MedialVoxelProgressScope scope(*this);
  this->CheckClient();
  m_Task.Begin();
  try
  {
    m_Walker.Run(m_Region, nextRegion, m_Source, *this);
  }
  catch (...)
  {
    m_Workspaces.KeepAtMost(0);
    throw;
  }
  if (nextRegion.IsEmpty())
  {
    m_Workspaces.KeepAtMost(0);
  }
  m_Task.Commit();
  return m_Sums;
}

void
MedialVoxelExecution::ThrowAborted() const
{
  std::rethrow_exception(m_Client.GetAbortException());
}

void
MedialVoxelExecution::RunSchedule(MedialVoxelSlabSchedule & schedule)
{
  m_Schedule = &schedule;
  if (schedule.IsDone())
  {
    return;
  }
  m_Workspaces.KeepAtMost(schedule.GetNumberOfWorkers());
  const auto start = ClockType::now();
  do
  {
    m_LacksWorkers = false;
    m_Client.RunWorkers(schedule.GetNumberOfWorkers(), [this] { this->DoWork(); });
  } while (!schedule.IsDone() && !this->IsAborted());
  m_Sums.tileSeconds += SecondsSince(start);
  if (m_Failure)
  {
    std::rethrow_exception(m_Failure);
  }
  // Other workers may have done all of a short run meanwhile.
  this->UpdateObservers();
  MedialVoxelCheckAbort();
}

void
MedialVoxelExecution::DoWork()
{
  const MedialVoxelProgressScope scope(*this);
  ++m_NumberOfBusyWorkers;
  this->AbortOnFailure([this] {
    for (Work work; this->WaitForWork(work);)
    {
      this->Do(work);
    }
  });
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    --m_NumberOfBusyWorkers;
  }
  m_HasNews.notify_all();
  if (this->IsCallingThread())
  {
    this->AbortOnFailure([this] { this->WaitForWorkers(); });
  }
}

bool
MedialVoxelExecution::WaitForWork(Work & work)
{
  const bool                   isCallingThread = this->IsCallingThread();
  const bool                   isPipeline = m_Source.GetSourceThreads() == MedialVoxelSourceThreads::Calling;
  std::unique_lock<std::mutex> lock(m_Mutex);
  while (!this->IsAborted() && !m_Schedule->IsDone())
  {
    if (m_LacksWorkers && m_Schedule->HasWork(false))
    {
      // All leave, and come back together.
      return false;
    }
    if (m_Schedule->Take(isCallingThread, work))
    {
      return true;
    }
    if (isPipeline && !isCallingThread)
    {
      // The pipeline that the calling thread asks may need this thread of a pool.
      m_LacksWorkers = true;
      return false;
    }
    this->WaitForNews(lock);
  }
  return false;
}

/** The calling thread updates observers meanwhile, unless the run is aborted: an observer may have thrown. */
void
MedialVoxelExecution::WaitForNews(std::unique_lock<std::mutex> & lock)
{
  constexpr std::chrono::milliseconds beatInterval{ 100 };
  ++m_NumberOfWaitingWorkers;
  m_HasNews.wait_for(lock, beatInterval);
  --m_NumberOfWaitingWorkers;
  if (this->IsCallingThread() && !this->IsAborted())
  {
    lock.unlock();
    this->UpdateObservers();
    lock.lock();
  }
}

/** Workers that have not begun will find no work. */
void
MedialVoxelExecution::WaitForWorkers()
{
  std::unique_lock<std::mutex> lock(m_Mutex);
  while (m_NumberOfBusyWorkers > 0)
  {
    this->WaitForNews(lock);
  }
}

void
MedialVoxelExecution::Do(const Work & work)
{
  const auto start = ClockType::now();
  if (work.phase == MedialVoxelSlabSchedule::Phase::Process)
  {
    this->ProcessTile(work);
  }
  else
  {
    m_Schedule->DoWindowWork(work, m_Source);
  }
  const double                      seconds = SecondsSince(start);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Sums.threadSeconds += seconds;
  m_Schedule->Complete(work, seconds);
  if (m_NumberOfWaitingWorkers > 0)
  {
    m_HasNews.notify_all();
  }
}

template <typename TFunction>
void
MedialVoxelExecution::AbortOnFailure(TFunction && function)
{
  try
  {
    function();
  }
  catch (...)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    if (!m_Failure)
    {
      // Store the failure before the flag: threads that end because of the flag must not overwrite it.
      m_Failure = std::current_exception();
      m_IsAborted = true;
    }
  }
}

void
MedialVoxelExecution::ProcessTile(const Work & work)
{
  const MedialVoxelBox &          tile = work.box;
  const MedialVoxelMovingWindow & window = m_Schedule->GetWindow(work);
  std::unique_ptr<Workspace>      workspace = this->TakeWorkspace(work.layout);
  MedialVoxelSums                 sums;
  const MedialVoxelBox            missing = m_Task.Process(tile, window, *this, *workspace, m_Client, sums);
  if (missing.IsEmpty())
  {
    sums.counts.notANumberVoxels = window.GetNotANumber().Count(tile);
    const auto changes = window.CountChanges(tile);
    sums.counts.filledVoxels = changes.filled;
    sums.counts.removedVoxels = changes.removed;
    this->Advance(static_cast<std::uint64_t>(tile.NumberOfVoxels()));
  }
  else
  {
    sums.counts = {};
    sums.recomputedVoxels = static_cast<std::uint64_t>(tile.NumberOfVoxels());
  }
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (!missing.IsEmpty())
  {
    m_Schedule->Defer(work, missing);
  }
  m_Sums += sums;
  m_Workspaces.Return(std::move(workspace), work.layout);
}

auto
MedialVoxelExecution::TakeWorkspace(const std::uint64_t layout) -> std::unique_ptr<Workspace>
{
  std::unique_ptr<Workspace> workspace;
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    workspace = m_Workspaces.Take(layout);
  }
  return workspace ? std::move(workspace) : m_Task.MakeWorkspace();
}

void
MedialVoxelExecution::Advance(const std::uint64_t voxels)
{
  m_DoneVoxels += voxels;
  this->UpdateObservers();
}

/** Python and user interfaces need their observers called from the thread of the run. */
void
MedialVoxelExecution::UpdateObservers()
{
  if (this->IsCallingThread())
  {
    m_Client.UpdateProgress(static_cast<float>(m_DoneVoxels) / static_cast<float>(m_Region.NumberOfVoxels()));
    this->CheckClient();
  }
}

void
MedialVoxelExecution::CheckClient()
{
  if (m_Client.IsAborted())
  {
    m_IsAborted = true;
  }
}

} // end namespace itk
