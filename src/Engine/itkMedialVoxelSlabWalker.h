// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSlabWalker_h
#define itkMedialVoxelSlabWalker_h

#include "itkMedialVoxelMemoryError.h"
#include "itkMedialVoxelMovingWindow.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelTileSchedule.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \brief The slowest axis along which \a box has more than one voxel, and slabs are cut; 0 when there is none.
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT unsigned int
MedialVoxelSlowestAxis(const MedialVoxelBox & box);

/** \class MedialVoxelTileRunner
 * \brief What a walker needs: object bits, and threads that process tiles.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileRunner : public MedialVoxelObjectSource
{
public:
  /** Process all tiles of \a schedule with any number of threads; tiles that need more are deferred. Throws to stop. */
  virtual void
  RunTiles(MedialVoxelTileSchedule & schedule) = 0;
};

/** \class MedialVoxelSlabWalker
 * \brief Walks a region slab by slab, each with a window that is certain to hold what its tiles depend on.
 *
 * A slab is tried with the window that sufficed so far. Tiles that turn out to depend on more are deferred and say how
 * much more, and only they are run again. What a tile computes depends on the image alone, so neither the slabs nor the
 * tiles nor the threads can change a result.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSlabWalker
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
    bool                             keepsGray{ false }; ///< the values of the voxels in the window

    /** Voxels of the largest components of the object and of the background that change sides; 0 for none. */
    std::uint64_t maximumPoreSize{ 0 };

    /** Voxels around a tile that are known from the start. */
    MedialVoxelIndex halo{ { 8, 8, 8 } };

    /** Voxels around the indices of a region, upwards, that belong to them. */
    MedialVoxelIndex upperMargin{ { 0, 0, 0 } };

    /** Voxels around a tile, within the halo, that are worked on together with it. */
    MedialVoxelIndex tileMargin{ { 0, 0, 0 } };

    /** Edge of the tiles; 0 chooses. */
    std::int64_t tileSize{ 0 };

    /** Extent of the slabs along the slowest axis; 0 chooses. */
    std::int64_t slabThickness{ 0 };

    /** Bytes that the window and the workspaces of all workers may take; 0 is without limit. Slabs become thinner, and
     * tiles smaller, to keep it. */
    std::uint64_t memoryLimit{ 0 };

    /** Workers that process tiles at the same time. */
    unsigned int numberOfWorkers{ 1 };

    /** Bytes of a worker, beside those of the distance transform: for each voxel of a tile, and for all of it. */
    std::uint64_t workerBytesPerVoxel{ 0 };
    std::uint64_t workerBytes{ 0 };

    /** For the classification, and for the nearest points of the object's border too if wanted. */
    static Settings
    ForClassification(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters, bool withObjectBoundary);

    /** For the nearest points of one boundary. */
    static Settings
    ForDistances(MedialVoxelBoundary boundary);
  };

  MedialVoxelSlabWalker(const MedialVoxelGrid & grid, Settings settings);

  /** Bytes that the window and all workers take while no tile of \a region depends on more than the halo. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & region) const;

  /** Extent along the slowest axis of the slabs that \a region is cut into now. */
  std::int64_t
  GetSlabThickness(const MedialVoxelBox & region) const
  {
    return this->ChooseCut(region).slabThickness;
  }

  /** Boxes of object voxels that the first slab of \a region starts with and the window does not hold. */
  std::vector<MedialVoxelBox>
  GetMissingObjectBoxes(const MedialVoxelBox & region) const;

  /** Process all of \a region; the window of the last slab is kept for the next call.
   * \throw MedialVoxelMemoryError when the memory limit does not hold what a slab of one voxel depends on. */
  void
  Run(const MedialVoxelBox & region, MedialVoxelTileRunner & client);

  /** The window of the slab that is being processed. */
  const MedialVoxelMovingWindow &
  GetWindow() const
  {
    return m_Window;
  }

private:
  /** How the work is cut: tiles, slabs of tiles, and what is known around a slab. */
  struct Cut
  {
    MedialVoxelIndex tileSize;
    std::int64_t     slabThickness;
    MedialVoxelIndex halo;
  };

  /** The cut that \a region is processed with as long as memory does not matter. */
  Cut
  PreferredCut(const MedialVoxelBox & region, const MedialVoxelIndex & halo) const;

  /** Make tiles smaller or slabs thinner; false when they cannot be. */
  bool
  MakeFiner(Cut & cut) const;

  /** The coarsest cut that fits the memory; throws when there is none. */
  Cut
  ChooseCut(const MedialVoxelBox & region) const;

  /** The slab of \a region that begins at \a position along the slowest axis. */
  MedialVoxelBox
  GetSlab(const MedialVoxelBox & region, std::int64_t position, std::int64_t thickness) const;

  /** Process \a parts of \a region, slab by slab. */
  void
  RunSlabs(const MedialVoxelBox & region, const std::vector<MedialVoxelBox> & parts, MedialVoxelTileRunner & client);

  /** Process \a tiles of \a slab with a window that grows; what outgrows the memory is cut into thinner slabs. */
  void
  RunTiles(const MedialVoxelBox &      slab,
           const Cut &                 cut,
           std::vector<MedialVoxelBox> tiles,
           MedialVoxelTileRunner &     client);

  /** Move the window for \a slab, without what it held when the memory does not suffice for both. */
  void
  MoveWindow(const MedialVoxelBox &  sites,
             const MedialVoxelBox &  slab,
             const Cut &             cut,
             MedialVoxelTileRunner & client);

  /** The halo of \a slab in \a sites and that of earlier slabs, as what one needed the next one probably needs too. */
  MedialVoxelIndex
  HaloOf(const MedialVoxelBox & slab, const MedialVoxelBox & sites) const;

  MedialVoxelBox
  GetSitesBox(const MedialVoxelBox & slab, const MedialVoxelIndex & halo) const;

  /** As large as the box of sites of any slab of \a region. */
  MedialVoxelBox
  LargestSitesBox(const MedialVoxelBox & region, const Cut & cut) const;

  /** Bytes of all workers for tiles in a window on \a sites. */
  std::uint64_t
  BytesOfWorkers(const MedialVoxelBox & sites, const Cut & cut) const;

  std::uint64_t
  BytesOf(const MedialVoxelBox & sites, const Cut & cut) const
  {
    return m_Window.GetBytes(sites) + this->BytesOfWorkers(sites, cut);
  }

  bool
  Fits(const MedialVoxelBox & sites, const Cut & cut) const
  {
    return m_Settings.memoryLimit == 0 || this->BytesOf(sites, cut) <= m_Settings.memoryLimit;
  }

  MedialVoxelGrid         m_Grid;
  unsigned int            m_SlowestAxis;
  Settings                m_Settings;
  MedialVoxelIndex        m_Halo;
  MedialVoxelMovingWindow m_Window;
};

} // end namespace itk

#endif
