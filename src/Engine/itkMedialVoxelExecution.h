// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelExecution_h
#define itkMedialVoxelExecution_h

#include "itkMedialVoxelSlabWalker.h"
#include "itkMedialVoxelTileTask.h"
#include "itkMedialVoxelWorkspacePool.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

namespace itk
{

/** \class MedialVoxelExecution
 * \brief One run over a region: the workers of a schedule, and the progress that they report to.
 * \ingroup MedialVoxel
 */
class MedialVoxelExecution
  : public MedialVoxelScheduleRunner
  , public MedialVoxelProgress
{
public:
  /** Only the thread that calls this reports progress to the client. \a workspaces outlive the run; they are kept for
   * the next region, if there is one. */
  MedialVoxelExecution(const MedialVoxelBox &      region,
                       const MedialVoxelTileTask & task,
                       MedialVoxelSlabWalker &     walker,
                       MedialVoxelObjectSource &   source,
                       MedialVoxelEngineClient &   client,
                       MedialVoxelWorkspacePool &  workspaces);

  /** Process the region; the window of \a nextRegion is prepared meanwhile. */
  MedialVoxelSums
  Run(const MedialVoxelBox & nextRegion);

  void
  RunSchedule(MedialVoxelSlabSchedule & schedule) override;

  bool
  IsAborted() const override
  {
    return m_IsAborted.load(std::memory_order_relaxed);
  }

  void
  Advance(std::uint64_t voxels) override;

  void
  UpdateObservers() override;

  [[noreturn]] void
  ThrowAborted() const override;

private:
  using Work = MedialVoxelSlabSchedule::Work;
  using Workspace = MedialVoxelTileTask::Workspace;

  bool
  IsCallingThread() const
  {
    return std::this_thread::get_id() == m_CallingThread;
  }

  /** Only the calling thread may ask the client for an abort; workers read its copy. */
  void
  CheckClient();

  /** The loop of each worker: take work until all is done. */
  void
  DoWork();

  /** Wait until there is work to take; false when there is none for this thread, or the run is aborted. */
  bool
  WaitForWork(Work & work);

  void
  WaitForNews(std::unique_lock<std::mutex> & lock);

  void
  WaitForWorkers();

  void
  Do(const Work & work);

  template <typename TFunction>
  void
  AbortOnFailure(TFunction && function);

  /** The client takes the result, unless the tile depends on more than the window holds. */
  void
  ProcessTile(const Work & work);

  std::unique_ptr<Workspace>
  TakeWorkspace(std::uint64_t layout);

  MedialVoxelBox              m_Region;
  const MedialVoxelTileTask & m_Task;
  MedialVoxelSlabWalker &     m_Walker;
  MedialVoxelObjectSource &   m_Source;
  MedialVoxelEngineClient &   m_Client;
  std::thread::id             m_CallingThread;
  std::atomic<std::uint64_t>  m_DoneVoxels{ 0 };
  std::atomic<bool>           m_IsAborted{ false };
  std::atomic<std::uint32_t>  m_NumberOfBusyWorkers{ 0 };
  std::mutex                  m_Mutex; // of the members below
  std::condition_variable     m_HasNews;
  bool                        m_LacksWorkers{ false }; // some have left for lack of work
  std::size_t                 m_NumberOfWaitingWorkers{ 0 };
  MedialVoxelSlabSchedule *   m_Schedule{ nullptr };
  std::exception_ptr          m_Failure;
  MedialVoxelWorkspacePool &  m_Workspaces;
  MedialVoxelSums             m_Sums;
};

} // end namespace itk

#endif
