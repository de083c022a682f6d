// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelExecution.h"

#include <algorithm>
#include <chrono>
#include <exception>
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
                                           const unsigned int          numberOfWorkers,
                                           const MedialVoxelTileTask & task,
                                           MedialVoxelSlabWalker &     walker,
                                           MedialVoxelEngineClient &   client)
  : m_Region(region)
  , m_NumberOfWorkers(numberOfWorkers)
  , m_Task(task)
  , m_Walker(walker)
  , m_Client(client)
  , m_CallingThread(std::this_thread::get_id())
{}

MedialVoxelSums
MedialVoxelExecution::Run()
{
  const MedialVoxelPollScope scope(*this);
  this->HearAbort();
  m_Task.Begin();
  m_Walker.Run(m_Region, *this);
  m_Task.Commit();
  return m_Sums;
}

void
MedialVoxelExecution::FillObject(const MedialVoxelBox &  box,
                                 MedialVoxelBits &       object,
                                 MedialVoxelBits * const notANumber)
{
  m_Client.FillObject(box, object, notANumber);
}

void
MedialVoxelExecution::FillObjectAndGray(const MedialVoxelBox &  box,
                                        MedialVoxelBits &       object,
                                        MedialVoxelBits * const notANumber,
                                        MedialVoxelGray &       gray)
{
  m_Client.FillObjectAndGray(box, object, notANumber, gray);
}

void
MedialVoxelExecution::FillGray(const MedialVoxelBox & box, MedialVoxelGray & gray)
{
  m_Client.FillGray(box, gray);
}

void
MedialVoxelExecution::ThrowIfAborted() const
{
  MedialVoxelPoll();
}

void
MedialVoxelExecution::ThrowAborted() const
{
  std::rethrow_exception(m_Client.GetAbortException());
}

void
MedialVoxelExecution::RunTiles(MedialVoxelTileSchedule & schedule)
{
  m_Schedule = &schedule;
  const std::size_t workers =
    std::max<std::size_t>(1, std::min<std::size_t>(m_NumberOfWorkers, schedule.GetNumberOfTiles()));
  const auto start = ClockType::now();
  m_Client.RunWorkers(static_cast<unsigned int>(workers), [this] { this->Work(); });
  m_Sums.tileSeconds += SecondsSince(start);
  // The next tiles may be smaller and their window larger.
  m_Workspaces.clear();
  schedule.RethrowFailure();
  this->ThrowIfAborted();
}

void
MedialVoxelExecution::Work()
{
  const MedialVoxelPollScope scope(*this);
  ++m_NumberOfBusyWorkers;
  this->StopAllWhenFailing([this] {
    MedialVoxelBox tile;
    while (!this->IsAborted() && m_Schedule->Next(tile))
    {
      m_Client.RunTile(tile);
    }
  });
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    --m_NumberOfBusyWorkers;
  }
  m_WorkerHasEnded.notify_all();
  if (this->IsCallingThread())
  {
    this->StopAllWhenFailing([this] { this->WaitForWorkers(); });
  }
}

void
MedialVoxelExecution::ProcessTile(const MedialVoxelBox & tile)
{
  std::unique_ptr<Workspace>      workspace = this->TakeWorkspace();
  const MedialVoxelMovingWindow & window = m_Walker.GetWindow();
  MedialVoxelSums                 sums;
  const auto                      start = ClockType::now();
  const MedialVoxelBox            missing = m_Task.Process(tile, window, *this, *workspace, m_Client, sums);
  sums.threadSeconds = SecondsSince(start);
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
    m_Schedule->Defer(tile, missing);
  }
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Sums += sums;
  m_Workspaces.push_back(std::move(workspace));
}

auto
MedialVoxelExecution::TakeWorkspace() -> std::unique_ptr<Workspace>
{
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    if (!m_Workspaces.empty())
    {
      std::unique_ptr<Workspace> workspace = std::move(m_Workspaces.back());
      m_Workspaces.pop_back();
      return workspace;
    }
  }
  return m_Task.MakeWorkspace();
}

void
MedialVoxelExecution::Advance(const std::uint64_t voxels)
{
  m_DoneVoxels += voxels;
  this->Beat();
}

/** Observers of the client are called from the thread of the run, as those of Python and of user interfaces must be. */
void
MedialVoxelExecution::Beat()
{
  if (this->IsCallingThread())
  {
    m_Client.UpdateProgress(static_cast<float>(m_DoneVoxels) / static_cast<float>(m_Region.NumberOfVoxels()));
    this->HearAbort();
  }
}

void
MedialVoxelExecution::HearAbort()
{
  if (m_Client.IsAbortRequested())
  {
    m_IsAborted = true;
  }
}

template <typename TFunction>
void
MedialVoxelExecution::StopAllWhenFailing(TFunction && function)
{
  try
  {
    function();
  }
  catch (...)
  {
    // In this order, as those that stop for it are no failure of their own.
    m_Schedule->Fail(std::current_exception());
    m_IsAborted = true;
  }
}

/** The calling thread beats while others have tiles; those that have not begun yet will find none. */
void
MedialVoxelExecution::WaitForWorkers()
{
  constexpr std::chrono::milliseconds beatInterval{ 100 };
  const auto                          areAllIdle = [this] { return m_NumberOfBusyWorkers == 0; };
  std::unique_lock<std::mutex>        lock(m_Mutex);
  while (!m_WorkerHasEnded.wait_for(lock, beatInterval, areAllIdle))
  {
    lock.unlock();
    this->Beat();
    lock.lock();
  }
}

} // end namespace itk
