// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileSchedule_h
#define itkMedialVoxelTileSchedule_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <vector>

namespace itk
{

/** \brief Cut \a region into tiles of \a tileSize; cuts lie at multiples of the tile size in the image.
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT std::vector<MedialVoxelBox>
                   MedialVoxelCutIntoTiles(const MedialVoxelBox & region, const MedialVoxelIndex & tileSize);

/** \class MedialVoxelTileSchedule
 * \brief Tiles that any number of threads take one by one, so that the work balances by itself.
 *
 * A tile that needs a larger window is deferred; the first exception of a worker stops the others and is kept for the
 * calling thread.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileSchedule
{
public:
  explicit MedialVoxelTileSchedule(std::vector<MedialVoxelBox> tiles);

  std::size_t
  GetNumberOfTiles() const
  {
    return m_Tiles.size();
  }

  /** Take the next tile; false when none is left or the schedule was stopped. */
  bool
  Next(MedialVoxelBox & tile);

  /** Put \a tile off until the sites in \a needed are known. */
  void
  Defer(const MedialVoxelBox & tile, const MedialVoxelBox & needed);

  /** Hand out no more tiles. */
  void
  Stop();

  /** Keep an exception for RethrowFailure() and stop. */
  void
  Fail(std::exception_ptr failure);

  /** Throw the first exception that was kept, if any. */
  void
  RethrowFailure() const;

  const std::vector<MedialVoxelBox> &
  GetDeferredTiles() const
  {
    return m_DeferredTiles;
  }

  /** Box that holds all that the deferred tiles need. */
  const MedialVoxelBox &
  GetNeededBox() const
  {
    return m_NeededBox;
  }

private:
  std::vector<MedialVoxelBox> m_Tiles;
  std::atomic<std::size_t>    m_Next{ 0 };
  std::atomic<bool>           m_IsStopped{ false };
  std::mutex                  m_Mutex;
  std::vector<MedialVoxelBox> m_DeferredTiles;
  MedialVoxelBox              m_NeededBox;
  std::exception_ptr          m_Failure;
};

} // end namespace itk

#endif
