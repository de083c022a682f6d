// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSlabWalker_h
#define itkMedialVoxelSlabWalker_h

#include "itkMedialVoxelSlabSchedule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelScheduleRunner
 * \brief Threads that do the work of a schedule.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelScheduleRunner
{
public:
  virtual ~MedialVoxelScheduleRunner();

  /** Do all work of \a schedule with any number of threads. Throws to abort. */
  virtual void
  RunSchedule(MedialVoxelSlabSchedule & schedule) = 0;
};

/** \class MedialVoxelSlabWalker
 * \brief Walks a region slab by slab, each with a window of all voxels that its tiles depend on.
 *
 * Two windows take turns: while tiles are processed in one, the other is prepared for the next slab, also for the first
 * one of the next region. Results of a tile depend on the image alone, so neither slabs nor tiles nor threads can
 * change them.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSlabWalker
{
public:
  using Settings = MedialVoxelSlabPlan::Settings;

  MedialVoxelSlabWalker(const MedialVoxelGrid & grid, const Settings & settings);

  /** Bytes that the windows and all workers take while no tile of \a region depends on more than the halo. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & region) const;

  /** Extent along the slowest axis of the slabs that \a region is cut into now. */
  std::int64_t
  GetSlabThickness(const MedialVoxelBox & region) const;

  /** Boxes of object voxels that the first slab of \a region starts with and that no window holds. */
  std::vector<MedialVoxelBox>
  GetMissingObjectBoxes(const MedialVoxelBox & region) const;

  /** Process all of \a region, and prepare a window for \a nextRegion, which may be empty; windows are kept for the
   * next call.
   * \throw MedialVoxelMemoryShortage when a slab of one voxel needs more than the memory limit. */
  void
  Run(const MedialVoxelBox &      region,
      const MedialVoxelBox &      nextRegion,
      MedialVoxelObjectSource &   source,
      MedialVoxelScheduleRunner & runner);

  /** Memory that the windows have now. */
  std::uint64_t
  GetReservedBytes() const;

private:
  MedialVoxelSlabPlan            m_Plan;
  MedialVoxelSlabSchedule::State m_State;
};

} // end namespace itk

#endif
