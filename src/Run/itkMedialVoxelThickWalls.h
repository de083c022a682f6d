// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelThickWalls_h
#define itkMedialVoxelThickWalls_h

#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelObjectSource.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace itk
{

/** \class MedialVoxelThickWalls
 * \brief Finds the thickness of the walls of an object by a coarse look.
 *
 * One coarse voxel stands for a block of voxels, and is object where most of the block is. Blocks have 4
 * voxels along each axis longer than 1. In images of more than 1 gigavoxel they have 8, then 16.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelThickWalls : private MedialVoxelObjectSource
{
public:
  using RunWorkersFunction = std::function<void(unsigned int, const std::function<void()> &)>;

  /** \param grid    of the image
   * \param maximum thickness of walls that need nothing, in the units of the spacing */
  MedialVoxelThickWalls(const MedialVoxelGrid & grid, double maximum);

  /** Voxels of a block along an axis. */
  std::int64_t
  GetStep() const
  {
    return m_Step;
  }

  /** Look at a box of the image that consists of whole blocks. Several threads may look at different boxes. */
  void
  Add(const MedialVoxelBits & object, const MedialVoxelBox & box);

  /** The thickness that 99 % of the walls do not exceed, where walls thicker than the maximum are a quarter of all
   * walls or more by area, and a fifth of the object or more by volume. Walls thicker than twice the maximum do not
   * count: they would cost too much. Call it once all blocks are there.
   * \param checkAbort called now and then by the calling thread; may throw to abort
   * \param runWorkers runs a function so many times, in the calling thread and in others; results do not depend on it */
  std::optional<double>
  FindNeededMaximum(const std::function<void()> & checkAbort, const RunWorkersFunction & runWorkers);

private:
  MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return MedialVoxelSourceThreads::Several;
  }

  void
  Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets) override;

  MedialVoxelIndex m_Block{};
  std::int64_t     m_Step{ 0 };
  double           m_Maximum;
  MedialVoxelBox   m_Image;
  MedialVoxelGrid  m_Grid;   // of the coarse voxels
  MedialVoxelBits  m_Object; // of them
};

} // end namespace itk

#endif
