// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelExecution_h
#define itkMedialVoxelExecution_h

#include "itkMedialVoxelSlabWalker.h"
#include "itkMedialVoxelTileTask.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace itk
{

/** \class MedialVoxelExecution
 * \brief One run over a region: the place where workers meet, and the progress that they report to.
 * \ingroup MedialVoxel
 */
class MedialVoxelExecution
  : public MedialVoxelTileRunner
  , public MedialVoxelProgress
{
public:
  /** The thread that calls this is the only one in which the client hears of progress. */
  MedialVoxelExecution(const MedialVoxelBox &      region,
                       unsigned int                numberOfWorkers,
                       const MedialVoxelTileTask & task,
                       MedialVoxelSlabWalker &     walker,
                       MedialVoxelEngineClient &   client);

  MedialVoxelSums
  Run();

  void
  ProcessTile(const MedialVoxelBox & tile);

  void
  FillObject(const MedialVoxelBox & box, MedialVoxelBits & object, MedialVoxelBits * notANumber) override;

  void
  FillObjectAndGray(const MedialVoxelBox & box,
                    MedialVoxelBits &      object,
                    MedialVoxelBits *      notANumber,
                    MedialVoxelGray &      gray) override;

  void
  FillGray(const MedialVoxelBox & box, MedialVoxelGray & gray) override;

  void
  ThrowIfAborted() const override;

  void
  RunTiles(MedialVoxelTileSchedule & schedule) override;

  bool
  IsAborted() const override
  {
    return m_IsAborted.load(std::memory_order_relaxed);
  }

  void
  Advance(std::uint64_t voxels) override;

  void
  Beat() override;

  [[noreturn]] void
  ThrowAborted() const override;

private:
  using Workspace = MedialVoxelTileTask::Workspace;

  bool
  IsCallingThread() const
  {
    return std::this_thread::get_id() == m_CallingThread;
  }

  /** Workers read a copy of what only the calling thread may ask the client. */
  void
  HearAbort();

  /** What each worker does: process tiles until there are no more. */
  void
  Work();

  template <typename TFunction>
  void
  StopAllWhenFailing(TFunction && function);

  void
  WaitForWorkers();

  std::unique_ptr<Workspace>
  TakeWorkspace();

  MedialVoxelBox                          m_Region;
  unsigned int                            m_NumberOfWorkers;
  const MedialVoxelTileTask &             m_Task;
  MedialVoxelSlabWalker &                 m_Walker;
  MedialVoxelEngineClient &               m_Client;
  std::thread::id                         m_CallingThread;
  MedialVoxelTileSchedule *               m_Schedule{ nullptr };
  std::atomic<std::uint64_t>              m_DoneVoxels{ 0 };
  std::atomic<bool>                       m_IsAborted{ false };
  std::atomic<std::uint32_t>              m_NumberOfBusyWorkers{ 0 };
  std::mutex                              m_Mutex;
  std::condition_variable                 m_WorkerHasEnded;
  std::vector<std::unique_ptr<Workspace>> m_Workspaces;
  MedialVoxelSums                         m_Sums;
};

} // end namespace itk

#endif
