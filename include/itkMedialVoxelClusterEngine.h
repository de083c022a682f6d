// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelClusterEngine_h
#define itkMedialVoxelClusterEngine_h

#include "itkMedialVoxelClusterWindow.h"
#include "itkMedialVoxelTileSchedule.h"

#include <vector>

namespace itk
{

/** \brief The slowest axis along which \a box has more than one voxel, and slabs are cut; 0 when there is none.
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT unsigned int
MedialVoxelSlowestAxis(const MedialVoxelBox & box);

/** \class MedialVoxelClusterClient
 * \brief What the engine needs from its user: object bits, and threads.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelClusterClient : public MedialVoxelObjectSource
{
public:
  /** Process all tiles of \a schedule with any number of threads; tiles that need more are deferred. Throws to stop. */
  virtual void
  RunTiles(MedialVoxelTileSchedule & schedule) = 0;
};

/** \class MedialVoxelClusterEngine
 * \brief Walks a region slab by slab, each with a window that is certain to hold what its tiles depend on.
 *
 * A slab is tried with the window that sufficed so far. Tiles that turn out to depend on more are deferred and say how
 * much more, and only they are run again. What a tile computes depends on the image alone, so neither the slabs nor the
 * tiles nor the threads can change a result.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelClusterEngine
{
public:
  /** \struct Settings
   * \brief What is kept and how the work is cut; the cut has no influence on results.
   * \ingroup MedialVoxel
   */
  struct Settings
  {
    std::vector<MedialVoxelBoundary> boundaries;
    bool                             keepsNotANumber{ false };

    /** Voxels around a tile that are known from the start. */
    MedialVoxelIndex halo{ { 8, 8, 8 } };

    /** Voxels around the indices of a region, upwards, that belong to them. */
    MedialVoxelIndex upperMargin{ { 0, 0, 0 } };

    /** Edge of the tiles; 0 chooses. */
    std::int64_t tileSize{ 0 };

    /** Extent of the slabs along the slowest axis; 0 chooses. */
    std::int64_t slabThickness{ 0 };
  };

  MedialVoxelClusterEngine(const MedialVoxelGrid & grid, Settings settings);

  /** Boxes of object voxels that the first slab of \a region starts with and the window does not hold. */
  std::vector<MedialVoxelBox>
  GetMissingObjectBoxes(const MedialVoxelBox & region) const;

  /** Process all of \a region; the window of the last slab is kept for the next call. */
  void
  Run(const MedialVoxelBox & region, MedialVoxelClusterClient & client);

  /** The window of the slab that is being processed. */
  const MedialVoxelClusterWindow &
  GetWindow() const
  {
    return m_Window;
  }

private:
  MedialVoxelIndex
  ChooseTileSize() const;

  /** The slab of \a region that begins at \a position along the slowest axis. */
  MedialVoxelBox
  GetSlab(const MedialVoxelBox & region, std::int64_t position) const;

  void
  RunSlab(const MedialVoxelBox & slab, MedialVoxelClusterClient & client);

  MedialVoxelBox
  GetSitesBox(const MedialVoxelBox & slab) const;

  MedialVoxelGrid          m_Grid;
  Settings                 m_Settings;
  MedialVoxelIndex         m_Halo;
  MedialVoxelClusterWindow m_Window;
};

} // end namespace itk

#endif
