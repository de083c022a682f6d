// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSlabSchedule.h"

#include "itkMedialVoxelMemoryShortage.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

namespace itk
{

namespace
{

/** With more tiles in a slab, its longest ones do not matter at its end. */
constexpr std::size_t MostSortedTiles = 4096;

/** Parts of a window for each worker, so that no worker waits long for the last part of another one. */
constexpr std::int64_t PartsPerWorker = 4;

/** From so many workers on, all of them copy a growing window; fewer gain less than its memory costs. */
constexpr unsigned int ManyWorkers = 4;

bool
IsLarger(const MedialVoxelIndex & a, const MedialVoxelIndex & b)
{
  return a[0] > b[0] || a[1] > b[1] || a[2] > b[2];
}

std::int64_t
CountShared(const MedialVoxelMovingWindow & window, const MedialVoxelBox & input)
{
  return window.GetObject().GetBox().Intersection(input).NumberOfVoxels();
}

} // namespace

std::size_t
MedialVoxelFindNearestWindow(const MedialVoxelSlabSchedule::Windows & windows, const MedialVoxelBox & input)
{
  return CountShared(windows[1], input) > CountShared(windows[0], input) ? 1 : 0;
}

MedialVoxelSlabSchedule::MedialVoxelSlabSchedule(const MedialVoxelSlabPlan &     plan,
                                                 State &                         state,
                                                 const MedialVoxelObjectSource & source)
  : m_Plan(plan)
  , m_State(state)
  , m_Threads(source.GetSourceThreads())
  , m_RowsReadTogether(source.GetRowsReadTogether())
{}

void
MedialVoxelSlabSchedule::Begin(const MedialVoxelBox & region, const MedialVoxelBox & nextRegion)
{
  m_NumberOfWorkers = m_Plan.CountWorkers(region, m_State.halo);
  m_NextRegion = nextRegion;
  m_Pending.push_back({ region, { region }, region.lower[m_Plan.GetSlowestAxis()], std::nullopt });
  this->BeginSlabs();
}

bool
MedialVoxelSlabSchedule::Take(const bool isCallingThread, Work & work)
{
  this->RenewSlabs();
  const auto canTake = [&](const Slab & slab, const bool isPrepared) {
    return (slab.phase == Phase::Process) == isPrepared && !slab.waiting.empty() &&
           this->MayTake(slab, isCallingThread);
  };
  // Windows first, as nobody waits for a tile.
  for (const bool isPrepared : { false, true })
  {
    for (Slab & slab : m_Slabs)
    {
      if (canTake(slab, isPrepared))
      {
        work = { slab.phase, slab.waiting.front(), slab.number, slab.window, slab.layout };
        slab.waiting.pop_front();
        ++slab.numberOfTaken;
        return true;
      }
    }
  }
  return false;
}

bool
MedialVoxelSlabSchedule::HasWork(const bool isCallingThread) const
{
  return std::any_of(m_Slabs.begin(), m_Slabs.end(), [&](const Slab & slab) {
    return !slab.waiting.empty() && this->MayTake(slab, isCallingThread);
  });
}

/** While there are tiles, half of the threads do not read voxels. */
bool
MedialVoxelSlabSchedule::MayTake(const Slab & slab, const bool isCallingThread) const
{
  if (slab.phase != Phase::Fill)
  {
    return true;
  }
  switch (m_Threads)
  {
    case MedialVoxelSourceThreads::Calling:
      return isCallingThread;
    case MedialVoxelSourceThreads::OneAtATime:
      return slab.numberOfTaken == 0;
    default:
      return slab.numberOfTaken < (m_NumberOfWorkers + 1) / 2 || !this->HasTiles();
  }
}

bool
MedialVoxelSlabSchedule::HasTiles() const
{
  return std::any_of(m_Slabs.begin(), m_Slabs.end(), [](const Slab & slab) {
    return slab.phase == Phase::Process && !slab.waiting.empty();
  });
}

/** Prepare slabs again whose windows are too small now that the halo has grown. */
void
MedialVoxelSlabSchedule::RenewSlabs()
{
  const auto isOutdated = [this](const Slab & slab) {
    return slab.phase == Phase::Process && slab.numberOfTaken == 0 && slab.waiting.size() == slab.numberOfTiles &&
           IsLarger(m_State.halo, slab.cut.halo) && !slab.wasDeferred &&
           IsLarger(m_Plan.ChooseCut(slab.box, m_State.halo).halo, slab.cut.halo);
  };
  const auto found = std::find_if(m_Slabs.begin(), m_Slabs.end(), isOutdated);
  if (found != m_Slabs.end())
  {
    m_Pending.push_back(
      { found->box, std::move(found->parts), found->box.lower[m_Plan.GetSlowestAxis()], std::nullopt });
    m_Slabs.erase(found);
    this->BeginSlabs();
  }
}

void
MedialVoxelSlabSchedule::DoWindowWork(const Work & work, MedialVoxelObjectSource & source)
{
  MedialVoxelMovingWindow & window = m_State.windows[work.window];
  switch (work.phase)
  {
    case Phase::Fill:
      window.Fill(work.box, source);
      break;
    case Phase::ChangeSmallComponents:
      window.ChangeSmallComponents();
      break;
    default:
      window.Mark(work.box);
  }
}

void
MedialVoxelSlabSchedule::Defer(const Work & work, const MedialVoxelBox & needed)
{
  Slab & slab = *this->FindSlab(work.slab);
  slab.deferred.push_back(work.box);
  slab.needed = slab.needed.Union(needed);
  m_State.halo = m_Plan.WidenHalo(m_State.halo, slab.box, slab.sites.Union(slab.needed));
}

void
MedialVoxelSlabSchedule::Complete(const Work & work, const double seconds)
{
  const auto slab = this->FindSlab(work.slab);
  const bool wasDeferred = !slab->deferred.empty() && slab->deferred.back() == work.box;
  if (work.phase == Phase::Process && !wasDeferred && this->SortsTiles(slab->numberOfTiles))
  {
    m_State.balance.Record(work.box, m_Plan.GetSlowestAxis(), seconds);
  }
  --slab->numberOfTaken;
  if (!slab->waiting.empty() || slab->numberOfTaken > 0)
  {
    return;
  }
  this->EnterNextPhase(*slab);
  this->EndIfDone(slab);
  this->BeginSlabs();
}

void
MedialVoxelSlabSchedule::CheckThatAllIsDone() const
{
  if (!this->IsDone())
  {
    throw std::logic_error("MedialVoxelSlabSchedule: work was left");
  }
}

void
MedialVoxelSlabSchedule::BeginSlabs()
{
  const std::size_t most = this->ReadsAhead() ? m_State.windows.size() : 1;
  while (m_Slabs.size() < most && !this->IsPreparing())
  {
    std::optional<Slab> slab = this->FindNext();
    if (!slab || !this->MoveWindow(*slab))
    {
      return;
    }
    this->DropNext(*slab);
    slab->number = ++m_NumberOfSlabs;
    slab->layout = this->FindLayout(*slab);
    m_Slabs.push_back(std::move(*slab));
    const auto begun = std::prev(m_Slabs.end());
    this->EnterPhase(*begun, Phase::Fill);
    this->EndIfDone(begun);
  }
}

/** One window at a time copies from the other one. */
bool
MedialVoxelSlabSchedule::IsPreparing() const
{
  return std::any_of(m_Slabs.begin(), m_Slabs.end(), [](const Slab & slab) { return slab.phase != Phase::Process; });
}

auto
MedialVoxelSlabSchedule::FindNext() -> std::optional<Slab>
{
  while (!m_Pending.empty())
  {
    Pending & next = m_Pending.back();
    if (next.deferred)
    {
      std::optional<Slab> grown = this->GrowDeferred(next);
      if (grown)
      {
        return grown;
      }
    }
    Slab slab = this->MakeSlab(next.region, next.parts, next.position);
    if (!slab.tiles.empty())
    {
      return slab;
    }
    this->DropNext(slab);
  }
  // Of use only while there are tiles to wait for.
  if (m_NextRegion.IsEmpty() || m_Slabs.empty())
  {
    return {};
  }
  Slab slab = this->MakeSlab(m_NextRegion, {}, m_NextRegion.lower[m_Plan.GetSlowestAxis()]);
  return slab;
}

auto
MedialVoxelSlabSchedule::MakeSlab(const MedialVoxelBox &              region,
                                  const std::vector<MedialVoxelBox> & parts,
                                  const std::int64_t                  position) const -> Slab
{
  Slab slab;
  if (region.IsEmpty())
  {
    return slab;
  }
  slab.cut = m_Plan.ChooseCut(region, m_State.halo);
  slab.box = m_Plan.GetSlab(region, position, slab.cut.slabThickness);
  slab.sites = m_Plan.GetSitesBox(slab.box, slab.cut.halo);
  // Slabs at the ends of the region and of the image have less around them than others.
  slab.largestSites = m_Plan.LargestSitesBox(region, slab.cut);
  for (const MedialVoxelBox & part : parts)
  {
    slab.parts.push_back(part.Intersection(slab.box));
  }
  slab.tiles = MedialVoxelSlabPlan::CutTiles(slab.parts, slab.cut);
  return slab;
}

auto
MedialVoxelSlabSchedule::GrowDeferred(Pending & pending) const -> std::optional<Slab>
{
  const Slab &        slab = *pending.deferred;
  const std::uint64_t bytes = m_Plan.GetBytes(slab.sites, slab.cut);
  if (m_Plan.IsWithinLimit(bytes))
  {
    return slab;
  }
  if (!IsLarger(m_Plan.ChooseCut(slab.box, m_State.halo).halo, slab.cut.halo))
  {
    throw MedialVoxelMemoryShortage(bytes, m_Plan.GetSettings().memoryLimit);
  }
  pending = { slab.box, slab.tiles, slab.box.lower[m_Plan.GetSlowestAxis()], std::nullopt };
  return {};
}

void
MedialVoxelSlabSchedule::DropNext(const Slab & slab)
{
  if (m_Pending.empty())
  {
    m_NextRegion = {};
    return;
  }
  const unsigned int axis = m_Plan.GetSlowestAxis();
  Pending &          next = m_Pending.back();
  next.position = slab.box.upper[axis];
  if (next.deferred || next.position >= next.region.upper[axis])
  {
    m_Pending.pop_back();
  }
}

bool
MedialVoxelSlabSchedule::MoveWindow(Slab & slab)
{
  Windows &            windows = m_State.windows;
  const MedialVoxelBox input = windows[0].GetInputBox(slab.sites);
  const std::size_t    nearest = MedialVoxelFindNearestWindow(windows, input);
  const std::size_t    free = m_Slabs.empty() ? 1 - nearest : 1 - m_Slabs.front().window;
  const bool           isInPlace = windows[nearest].GetObject().GetBox() == input;
  // All threads copy and clear; one thread moves the bits that are kept in place.
  if (this->ReadsAhead() && !isInPlace && free != nearest && this->TryWindow(slab, free, true))
  {
    return true;
  }
  slab.window = m_Slabs.empty() ? nearest : free;
  const bool hasNothing = CountShared(windows[slab.window], input) == 0;
  const bool isKept = hasNothing || windows[slab.window].GetObject().GetBox() == input;
  if (m_NumberOfWorkers >= ManyWorkers && !isKept && this->TryNewWindow(slab, slab.window))
  {
    return true;
  }
  if (this->TryWindow(slab, slab.window, hasNothing))
  {
    return true;
  }
  if (!m_Slabs.empty())
  {
    return false;
  }
  windows[1 - slab.window].Clear();
  if (!this->TryWindow(slab, slab.window, hasNothing))
  {
    windows[slab.window].Clear();
    windows[slab.window].BeginMove(slab.sites, slab.largestSites, nullptr);
  }
  return true;
}

/** The window copies the bits of the other one, or keeps its own. */
bool
MedialVoxelSlabSchedule::TryWindow(Slab & slab, const std::size_t number, const bool copies)
{
  MedialVoxelMovingWindow & window = m_State.windows[number];
  MedialVoxelMovingWindow & other = m_State.windows[1 - number];
  const std::uint64_t       moved = copies ? window.GetBytesToFrame(slab.sites, slab.largestSites)
                                           : window.GetBytesToReframe(slab.sites, slab.largestSites);
  if (!this->IsWithinLimit(slab, moved + other.GetReservedBytes()))
  {
    return false;
  }
  slab.window = number;
  window.BeginMove(slab.sites, slab.largestSites, copies ? &other : nullptr);
  return true;
}

bool
MedialVoxelSlabSchedule::TryNewWindow(Slab & slab, const std::size_t number)
{
  Windows &           windows = m_State.windows;
  const std::uint64_t moved = m_State.old.GetBytesToFrame(slab.sites, slab.largestSites);
  if (!this->IsWithinLimit(slab, moved + windows[0].GetReservedBytes() + windows[1].GetReservedBytes()))
  {
    return false;
  }
  slab.window = number;
  std::swap(windows[number], m_State.old);
  windows[number].BeginMove(slab.sites, slab.largestSites, &m_State.old);
  return true;
}

bool
MedialVoxelSlabSchedule::IsWithinLimit(const Slab & slab, const std::uint64_t bytesOfWindows) const
{
  std::uint64_t workers = this->BytesOfWorkers(slab);
  for (const Slab & running : m_Slabs)
  {
    workers = std::max(workers, this->BytesOfWorkers(running));
  }
  return m_Plan.IsWithinLimit(bytesOfWindows + workers);
}

/** Workspaces stay as large as one slab of the region made them. */
std::uint64_t
MedialVoxelSlabSchedule::BytesOfWorkers(const Slab & slab) const
{
  return std::max(m_Plan.BytesOfWorkers(slab.sites, slab.cut), m_Plan.BytesOfWorkers(slab.largestSites, slab.cut));
}

std::uint64_t
MedialVoxelSlabSchedule::FindLayout(const Slab & slab)
{
  Layout layout{ slab.cut.tileSize, {} };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    layout[1][axis] = std::max(slab.largestSites.Extent(axis), slab.sites.Extent(axis));
  }
  if (layout != m_State.lastLayout)
  {
    m_State.lastLayout = layout;
    ++m_State.numberOfLayouts;
  }
  return m_State.numberOfLayouts;
}

void
MedialVoxelSlabSchedule::EnterNextPhase(Slab & slab)
{
  if (slab.phase != Phase::Process)
  {
    this->EnterPhase(slab, static_cast<Phase>(static_cast<unsigned int>(slab.phase) + 1));
  }
}

void
MedialVoxelSlabSchedule::EnterPhase(Slab & slab, const Phase phase)
{
  slab.phase = phase;
  const MedialVoxelMovingWindow & window = m_State.windows[slab.window];
  const std::int64_t              parts = PartsPerWorker * m_NumberOfWorkers;
  std::vector<MedialVoxelBox>     boxes;
  switch (phase)
  {
    case Phase::Fill:
      boxes = m_Threads == MedialVoxelSourceThreads::Several ? window.CutToFill(parts, m_RowsReadTogether)
                                                             : window.CutToFill(1, 1);
      break;
    case Phase::ChangeSmallComponents:
      boxes.resize(window.ChangesSmallComponents() ? 1 : 0);
      break;
    case Phase::Mark:
      boxes = window.CutToMark(parts);
      break;
    case Phase::Process:
      m_State.old.Clear();
      boxes = std::exchange(slab.tiles, {});
      if (this->SortsTiles(boxes.size()))
      {
        boxes = m_State.balance.Balance(
          boxes, { m_Plan.GetSlowestAxis(), m_NumberOfWorkers, slab.wasDeferred, m_Pending.empty() });
      }
      slab.numberOfTiles = boxes.size();
  }
  slab.waiting.assign(boxes.begin(), boxes.end());
  if (slab.waiting.empty())
  {
    this->EnterNextPhase(slab);
  }
}

bool
MedialVoxelSlabSchedule::SortsTiles(const std::size_t number) const
{
  return m_NumberOfWorkers > 1 && number <= MostSortedTiles;
}

void
MedialVoxelSlabSchedule::EndIfDone(const std::list<Slab>::iterator slab)
{
  if (slab->phase != Phase::Process || !slab->waiting.empty() || slab->numberOfTaken > 0)
  {
    return;
  }
  Slab ended = std::move(*slab);
  m_Slabs.erase(slab);
  if (ended.deferred.empty())
  {
    return;
  }
  if (ended.sites.Contains(ended.needed))
  {
    throw std::logic_error("MedialVoxelSlabSchedule: a tile was deferred although its window holds what it needs");
  }
  ended.sites = ended.sites.Union(std::exchange(ended.needed, {}));
  ended.tiles = std::exchange(ended.deferred, {});
  ended.wasDeferred = true;
  m_Pending.push_back({ ended.box, {}, 0, std::move(ended) });
}

std::list<MedialVoxelSlabSchedule::Slab>::iterator
MedialVoxelSlabSchedule::FindSlab(const std::uint64_t number)
{
  const auto slab = std::find_if(
    m_Slabs.begin(), m_Slabs.end(), [number](const Slab & candidate) { return candidate.number == number; });
  assert(slab != m_Slabs.end());
  return slab;
}

} // end namespace itk
