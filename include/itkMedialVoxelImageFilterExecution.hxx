// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterExecution_hxx
#define itkMedialVoxelImageFilterExecution_hxx

#include "itkMedialVoxelImageFilterBase.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace itk
{

/** One execution of the filter: the engine's client, and the place where workers meet. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelImageFilterBase<TInputImage, TOutputImage>::Execution
  : public MedialVoxelClusterClient
  , public MedialVoxelProgress
{
public:
  Execution(Self & filter, MedialVoxelClusterEngine & engine, const MedialVoxelBox & region)
    : m_Filter(filter)
    , m_Engine(engine)
    , m_Predicate(filter.GetPredicate())
    , m_Region(region)
    , m_CallingThread(std::this_thread::get_id())
  {}

  void
  Run()
  {
    const MedialVoxelPollScope scope(*this);
    this->HearAbort();
    m_Engine.Run(m_Region, *this);
  }

  const TileSums &
  GetSums() const
  {
    return m_Sums;
  }

  void
  FillObject(const MedialVoxelBox & box, MedialVoxelBits & object, MedialVoxelBits * const notANumber) override
  {
    this->Fill(box, object, notANumber, nullptr);
  }

  void
  FillObjectAndGray(const MedialVoxelBox &  box,
                    MedialVoxelBits &       object,
                    MedialVoxelBits * const notANumber,
                    MedialVoxelGray &       gray) override
  {
    this->Fill(box, object, notANumber, &gray);
  }

  void
  FillGray(const MedialVoxelBox & box, MedialVoxelGray & gray) override
  {
    for (const MedialVoxelBox & piece : CutForPull(box))
    {
      MedialVoxelPoll();
      this->Pull(piece);
      this->Copy(piece, gray);
    }
  }

  void
  ThrowIfAborted() const override
  {
    MedialVoxelPoll();
  }

  [[noreturn]] void
  ThrowAborted() const override
  {
    ProcessAborted exception(__FILE__, __LINE__);
    exception.SetDescription("Filter execution was aborted by an external request");
    throw exception;
  }

  void
  RunTiles(MedialVoxelTileSchedule & schedule) override
  {
    m_Schedule = &schedule;
    MultiThreaderBase * const multiThreader = m_Filter.GetMultiThreader();
    const SizeValueType       workers =
      std::max<SizeValueType>(1, std::min<SizeValueType>(m_Filter.GetNumberOfWorkers(), schedule.GetNumberOfTiles()));
    multiThreader->SetNumberOfWorkUnits(static_cast<ThreadIdType>(workers));
    const auto start = std::chrono::steady_clock::now();
    multiThreader->ParallelizeArray(0, workers, [this](SizeValueType) { this->Work(); }, nullptr);
    m_Sums.tileSeconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    // The next tiles may be smaller and their window larger.
    m_Workspaces.clear();
    schedule.RethrowFailure();
    this->ThrowIfAborted();
  }

  /** The part of DynamicThreadedGenerateData() that needs the execution. */
  void
  ProcessTile(const MedialVoxelBox & tile)
  {
    std::unique_ptr<Workspace> workspace = this->TakeWorkspace();
    TileSums                   sums;
    const auto                 start = std::chrono::steady_clock::now();
    const MedialVoxelBox       missing = m_Filter.ProcessTile(tile, m_Engine.GetWindow(), *this, *workspace, sums);
    sums.threadSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (missing.IsEmpty())
    {
      const MedialVoxelClusterWindow & window = m_Engine.GetWindow();
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
    m_Sums.counts += sums.counts;
    m_Sums.recomputedVoxels += sums.recomputedVoxels;
    m_Sums.distanceSeconds += sums.distanceSeconds;
    m_Sums.classificationSeconds += sums.classificationSeconds;
    m_Sums.threadSeconds += sums.threadSeconds;
    m_Workspaces.push_back(std::move(workspace));
  }

  bool
  IsAborted() const override
  {
    return m_IsAborted.load(std::memory_order_relaxed);
  }

  void
  Advance(const std::uint64_t voxels) override
  {
    m_DoneVoxels += voxels;
    this->Beat();
  }

  /** Observers are called from the thread that called Update(), as those of Python and of user interfaces must be. */
  void
  Beat() override
  {
    if (this->IsCallingThread())
    {
      m_Filter.UpdateProgress(static_cast<float>(m_DoneVoxels) / static_cast<float>(m_Region.NumberOfVoxels()));
      this->HearAbort();
    }
  }

  /** Pieces in which a box of input is pulled: whole slices, as many as fit a megabyte. */
  static std::vector<MedialVoxelBox>
  CutForPull(const MedialVoxelBox & box)
  {
    constexpr std::int64_t bytesPerPull = 1 << 20;
    const std::int64_t     bytesPerRow = box.Extent(0) * static_cast<std::int64_t>(sizeof(InputPixelType));
    MedialVoxelIndex       size{ { box.upper[0], box.upper[1], box.upper[2] } };
    if (box.Extent(2) > 1)
    {
      size[2] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow * box.Extent(1)));
    }
    else if (box.Extent(1) > 1)
    {
      size[1] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow));
    }
    return MedialVoxelCutIntoTiles(box, size);
  }

private:
  bool
  IsCallingThread() const
  {
    return std::this_thread::get_id() == m_CallingThread;
  }

  /** Only the calling thread reads the flag of ITK, which is no atomic; workers read the copy. */
  void
  HearAbort()
  {
    if (m_Filter.GetAbortGenerateData())
    {
      m_IsAborted = true;
    }
  }

  void
  Work()
  {
    const MedialVoxelPollScope scope(*this);
    ++m_NumberOfBusyWorkers;
    this->StopAllWhenFailing([this] {
      MedialVoxelBox tile;
      while (!this->IsAborted() && m_Schedule->Next(tile))
      {
        m_Filter.DynamicThreadedGenerateData(m_Filter.RegionOf(tile));
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

  template <typename TFunction>
  void
  StopAllWhenFailing(TFunction && function)
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
  WaitForWorkers()
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

  std::unique_ptr<Workspace>
  TakeWorkspace()
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
    return m_Filter.MakeWorkspace();
  }

  /** Have the pipeline produce a piece of the input. */
  void
  Pull(const MedialVoxelBox & piece)
  {
    auto * const               input = const_cast<InputImageType *>(m_Filter.GetInput());
    const InputImageRegionType region = m_Filter.RegionOf(piece);
    input->SetRequestedRegion(region);
    input->PropagateRequestedRegion();
    input->UpdateOutputData();
    if (!input->GetBufferedRegion().IsInside(region))
    {
      itkGenericExceptionMacro("The input image holds " << input->GetBufferedRegion() << " but " << region
                                                        << " is needed.");
    }
  }

  void
  Fill(const MedialVoxelBox &  box,
       MedialVoxelBits &       object,
       MedialVoxelBits * const notANumber,
       MedialVoxelGray * const gray)
  {
    for (const MedialVoxelBox & piece : CutForPull(box))
    {
      MedialVoxelPoll();
      this->Pull(piece);
      this->Pack(piece, m_Predicate, object);
      if (notANumber != nullptr)
      {
        this->Pack(piece, [](const InputPixelType value) { return value != value; }, *notANumber);
      }
      if (gray != nullptr)
      {
        this->Copy(piece, *gray);
      }
    }
  }

  void
  Copy(const MedialVoxelBox & piece, MedialVoxelGray & gray) const
  {
    m_Filter.ForEachRow(
      *m_Filter.GetInput(), piece, [&](const InputPixelType * const pixels, const MedialVoxelBox & row) {
        std::transform(pixels,
                       pixels + row.Extent(0),
                       gray.GetRow(row.lower[1], row.lower[2]) + (row.lower[0] - gray.GetBox().lower[0]),
                       [](const InputPixelType value) { return static_cast<float>(value); });
      });
  }

  template <typename TPredicate>
  void
  Pack(const MedialVoxelBox & piece, const TPredicate & predicate, MedialVoxelBits & bits) const
  {
    m_Filter.ForEachRow(
      *m_Filter.GetInput(), piece, [&](const InputPixelType * const pixels, const MedialVoxelBox & row) {
        MedialVoxelPackRow(pixels,
                           row.lower[0],
                           row.Extent(0),
                           predicate,
                           bits.GetRow(row.lower[1], row.lower[2]) - bits.GetFirstWord());
      });
  }

  Self &                                  m_Filter;
  MedialVoxelClusterEngine &              m_Engine;
  PredicateType                           m_Predicate;
  MedialVoxelBox                          m_Region;
  std::thread::id                         m_CallingThread;
  MedialVoxelTileSchedule *               m_Schedule{ nullptr };
  std::atomic<std::uint64_t>              m_DoneVoxels{ 0 };
  std::atomic<bool>                       m_IsAborted{ false };
  std::atomic<std::uint32_t>              m_NumberOfBusyWorkers{ 0 };
  std::mutex                              m_Mutex;
  std::condition_variable                 m_WorkerHasEnded;
  std::vector<std::unique_ptr<Workspace>> m_Workspaces;
  TileSums                                m_Sums;
};

} // end namespace itk

#endif
