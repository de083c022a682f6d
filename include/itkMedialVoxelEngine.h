// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelEngine_h
#define itkMedialVoxelEngine_h

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelMemoryShortage.h"
#include "itkMedialVoxelObjectSource.h"
#include "itkMedialVoxelSums.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{

/** \class MedialVoxelEngine
 * \brief Carries out a task on an image, region by region, with a client that knows the image and the threads.
 *
 * It walks a region slab by slab. Each slab has a window of object bits that holds all its tiles depend on. Workers
 * process the tiles and prepare the window of the next slab meanwhile. Results do not depend on regions, slabs, tiles
 * or threads. Windows of a region are kept for the next one, so shared input is read once.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelEngine
{
public:
  /** \a grid has the size of the image, and its spacing in the units of the task. */
  MedialVoxelEngine(const MedialVoxelGrid & grid, const MedialVoxelEngineSettings & settings);
  ~MedialVoxelEngine();

  MedialVoxelEngine(const MedialVoxelEngine &) = delete;
  MedialVoxelEngine &
  operator=(const MedialVoxelEngine &) = delete;

  /** Bytes of the windows and all workers while no tile of \a region depends on more than the halo. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & region) const;

  /** Extent along the slowest axis of the slabs that \a region is cut into now. */
  std::int64_t
  GetSlabThickness(const MedialVoxelBox & region) const;

  /** Boxes of object voxels that the first slab of \a region needs and the window lacks. */
  std::vector<MedialVoxelBox>
  GetMissingObjectBoxes(const MedialVoxelBox & region) const;

  /** Whether \a region reaches the end of the image along its slowest axis, so that no region can follow. */
  bool
  IsLast(const MedialVoxelBox & region) const;

  /** Process all of \a region. Results up to an exception do not count. When the next region is known, its voxels are
   * read while this one is processed.
   * \throw MedialVoxelMemoryShortage when a slab of one voxel needs more than the memory limit. */
  MedialVoxelSums
  Run(const MedialVoxelBox &    region,
      MedialVoxelObjectSource & source,
      MedialVoxelEngineClient & client,
      const MedialVoxelBox &    nextRegion = {});

private:
  class Implementation;

  std::unique_ptr<Implementation> m_Implementation;
};

} // end namespace itk

#endif
