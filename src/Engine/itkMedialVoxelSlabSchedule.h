// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSlabSchedule_h
#define itkMedialVoxelSlabSchedule_h

#include "itkMedialVoxelSlabPlan.h"
#include "itkMedialVoxelTileBalance.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <optional>
#include <vector>

namespace itk
{

/** \class MedialVoxelSlabSchedule
 * \brief The work on a region, handed out piece by piece to any number of threads.
 *
 * A slab goes through phases: the parts of its window are filled and get their boundary, then its tiles are processed.
 * Work of a phase may be done in any order and at the same time. While one slab has its tiles, the window of the next
 * one is prepared, and its tiles begin as soon as the first slab has no more of them to hand out. Tiles that depend on
 * more than their window holds are deferred with the sites they need; they follow as a slab of their own.
 *
 * It knows neither threads nor clocks. One thread at a time may call it, except for DoWindowWork().
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSlabSchedule
{
public:
  using Windows = std::array<MedialVoxelMovingWindow, 2>;

  /** Size of a tile and of the sites around a slab, on which the memory of a worker depends. */
  using Layout = std::array<MedialVoxelIndex, 2>;

  /** The windows that one region leaves for the next one. */
  struct State
  {
    Windows                 windows;
    MedialVoxelMovingWindow old;                  ///< that a window is copied from which cannot stay in place
    MedialVoxelIndex        halo;                 ///< that the next slab begins with
    MedialVoxelTileBalance  balance{};            ///< of tiles that were done
    Layout                  lastLayout{};         ///< of the last slab
    std::uint64_t           numberOfLayouts{ 0 }; ///< that followed each other
  };

  /** The phases of a slab, in order. */
  enum class Phase : std::uint8_t
  {
    Fill,                  ///< know the object bits of a part of the window
    ChangeSmallComponents, ///< of all of the window
    Mark,                  ///< the boundary in a part of the window
    Process                ///< a tile
  };

  /** Work for one thread. */
  struct Work
  {
    Phase          phase{ Phase::Fill };
    MedialVoxelBox box;
    std::uint64_t  slab{ 0 };   ///< number of the slab, from 1 on
    std::size_t    window{ 0 }; ///< of the slab
    std::uint64_t  layout{ 0 }; ///< changes when tiles or windows have another size than before
  };

  /** \a plan and \a state outlive the schedule. */
  MedialVoxelSlabSchedule(const MedialVoxelSlabPlan & plan, State & state, const MedialVoxelObjectSource & source);

  /** Set the work: process \a region, and prepare a window for the first slab of \a nextRegion meanwhile. */
  void
  Begin(const MedialVoxelBox & region, const MedialVoxelBox & nextRegion);

  /** Threads that find work at the same time, at most. */
  unsigned int
  GetNumberOfWorkers() const
  {
    return m_NumberOfWorkers;
  }

  /** Take work that can be done now; false when there is none. */
  bool
  Take(bool isCallingThread, Work & work);

  /** Whether there is work that can be taken. */
  bool
  HasWork(bool isCallingThread) const;

  /** Do work that is not a tile, with \a source for the voxels. */
  void
  DoWindowWork(const Work & work, MedialVoxelObjectSource & source);

  /** The window of a slab whose tiles are processed. */
  const MedialVoxelMovingWindow &
  GetWindow(const Work & work) const
  {
    return m_State.windows[work.window];
  }

  /** Defer a tile until the sites in \a needed are known; Complete() follows all the same. */
  void
  Defer(const Work & work, const MedialVoxelBox & needed);

  /** Call when work is done, with the time it took. */
  void
  Complete(const Work & work, double seconds);

  bool
  IsDone() const
  {
    return m_Slabs.empty() && m_Pending.empty();
  }

  void
  CheckThatAllIsDone() const;

private:
  using Cut = MedialVoxelSlabPlan::Cut;

  /** A slab with its window. */
  struct Slab
  {
    MedialVoxelBox              box;
    Cut                         cut;
    MedialVoxelBox              sites;
    MedialVoxelBox              largestSites; // as large as sites of the same region can be
    std::vector<MedialVoxelBox> parts;        // that are to be processed
    std::vector<MedialVoxelBox> tiles;        // of the parts, until they wait
    std::size_t                 numberOfTiles{ 0 };
    bool                        wasDeferred{ false };
    std::uint64_t               number{ 0 };
    std::uint64_t               layout{ 0 };
    std::size_t                 window{ 0 };
    Phase                       phase{ Phase::Fill };
    std::deque<MedialVoxelBox>  waiting; // work of the phase
    std::size_t                 numberOfTaken{ 0 };
    std::vector<MedialVoxelBox> deferred;
    MedialVoxelBox              needed;
  };

  /** Slabs to come: parts of a region from a position on, or tiles that were deferred. */
  struct Pending
  {
    MedialVoxelBox              region;
    std::vector<MedialVoxelBox> parts;
    std::int64_t                position;
    std::optional<Slab>         deferred;
  };

  /** Begin slabs as long as there is a window for one. */
  void
  BeginSlabs();

  bool
  IsPreparing() const;

  /** The slab that comes next; none when all have begun. */
  std::optional<Slab>
  FindNext();

  /** The slab of the tiles that were deferred; none when it has to be cut finer. */
  std::optional<Slab>
  GrowDeferred(Pending & pending) const;

  Slab
  MakeSlab(const MedialVoxelBox & region, const std::vector<MedialVoxelBox> & parts, std::int64_t position) const;

  /** Count that the next slab has begun. */
  void
  DropNext(const Slab & slab);

  /** Give a window to \a slab; false when there is no memory for it before another slab ends. */
  bool
  MoveWindow(Slab & slab);

  /** Begin to move a window for \a slab; false when the memory does not suffice. */
  bool
  TryWindow(Slab & slab, std::size_t number, bool copies);

  /** Begin to copy a window to a new one, by all threads; false when the memory does not suffice. */
  bool
  TryNewWindow(Slab & slab, std::size_t number);

  /** Whether windows of so many bytes fit the memory together with the workers of all slabs. */
  bool
  IsWithinLimit(const Slab & slab, std::uint64_t bytesOfWindows) const;

  bool
  ReadsAhead() const
  {
    return m_Plan.GetSettings().readsAhead && m_NumberOfWorkers > 1;
  }

  std::uint64_t
  BytesOfWorkers(const Slab & slab) const;

  std::uint64_t
  FindLayout(const Slab & slab);

  /** Go on to the first phase from \a phase on that has work, or to the end of the last one. */
  void
  EnterPhase(Slab & slab, Phase phase);

  void
  EnterNextPhase(Slab & slab);

  bool
  SortsTiles(std::size_t number) const;

  void
  EndIfDone(std::list<Slab>::iterator slab);

  void
  RenewSlabs();

  bool
  MayTake(const Slab & slab, bool isCallingThread) const;

  bool
  HasTiles() const;

  std::list<Slab>::iterator
  FindSlab(std::uint64_t number);

  const MedialVoxelSlabPlan & m_Plan;
  State &                     m_State;
  MedialVoxelSourceThreads    m_Threads;
  std::int64_t                m_RowsReadTogether;
  unsigned int                m_NumberOfWorkers{ 1 };
  std::vector<Pending>        m_Pending; // the last one comes next
  MedialVoxelBox              m_NextRegion;
  std::list<Slab>             m_Slabs; // in the order in which they began, at most one for each window
  std::uint64_t               m_NumberOfSlabs{ 0 };
};

/** \brief The window that holds most of \a input.
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT std::size_t
MedialVoxelFindNearestWindow(const MedialVoxelSlabSchedule::Windows & windows, const MedialVoxelBox & input);

} // end namespace itk

#endif
