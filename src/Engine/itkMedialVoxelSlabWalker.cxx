// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSlabWalker.h"

#include <algorithm>

namespace itk
{

MedialVoxelScheduleRunner::~MedialVoxelScheduleRunner() = default;

MedialVoxelSlabWalker::MedialVoxelSlabWalker(const MedialVoxelGrid & grid, const Settings & settings)
  : m_Plan(grid, settings)
  , m_State{ { m_Plan.MakeWindow(), m_Plan.MakeWindow() }, m_Plan.MakeWindow(), settings.halo }
{}

std::uint64_t
MedialVoxelSlabWalker::GetBytes(const MedialVoxelBox & region) const
{
  const auto           cut = m_Plan.ChooseCut(region, m_State.halo);
  const MedialVoxelBox sites = m_Plan.LargestSitesBox(region, cut);
  const std::uint64_t  bytes = m_Plan.GetBytes(sites, cut);
  const bool           isOneSlab = cut.slabThickness >= region.Extent(m_Plan.GetSlowestAxis());
  const auto &         settings = m_Plan.GetSettings();
  const std::uint64_t  withSecond = bytes + m_Plan.GetBytes(sites);
  const bool           readsAhead = settings.readsAhead && settings.numberOfWorkers > 1 && !isOneSlab;
  return readsAhead && m_Plan.IsWithinLimit(withSecond) ? withSecond : bytes;
}

std::int64_t
MedialVoxelSlabWalker::GetSlabThickness(const MedialVoxelBox & region) const
{
  return m_Plan.ChooseCut(region, m_State.halo).slabThickness;
}

std::vector<MedialVoxelBox>
MedialVoxelSlabWalker::GetMissingObjectBoxes(const MedialVoxelBox & region) const
{
  const auto           cut = m_Plan.ChooseCut(region, m_State.halo);
  const MedialVoxelBox slab = m_Plan.GetSlab(region, region.lower[m_Plan.GetSlowestAxis()], cut.slabThickness);
  const MedialVoxelBox input = m_State.windows[0].GetInputBox(m_Plan.GetSitesBox(slab, cut.halo));
  const auto           missing = [&input](const MedialVoxelMovingWindow & window) {
    return MedialVoxelSubtractBox(input, window.GetObject().GetBox());
  };
  const std::size_t best = MedialVoxelFindNearestWindow(m_State.windows, input);
  return missing(m_State.windows[best]);
}

void
MedialVoxelSlabWalker::Run(const MedialVoxelBox &      region,
                           const MedialVoxelBox &      nextRegion,
                           MedialVoxelObjectSource &   source,
                           MedialVoxelScheduleRunner & runner)
{
  try
  {
    MedialVoxelSlabSchedule schedule(m_Plan, m_State, source);
    schedule.Begin(region, nextRegion);
    runner.RunSchedule(schedule);
    schedule.CheckThatAllIsDone();
  }
  catch (...)
  {
    // After an unfinished move, the content of a window is unknown.
    for (MedialVoxelMovingWindow & window : m_State.windows)
    {
      window.Clear();
    }
    m_State.old.Clear();
    throw;
  }
}

std::uint64_t
MedialVoxelSlabWalker::GetReservedBytes() const
{
  return m_State.windows[0].GetReservedBytes() + m_State.windows[1].GetReservedBytes() + m_State.old.GetReservedBytes();
}

} // end namespace itk
