// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSlabPlan_h
#define itkMedialVoxelSlabPlan_h

#include "itkMedialVoxelMovingWindow.h"
#include "itkMedialVoxelParameters.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \brief Cut \a region into tiles of \a tileSize; cuts lie at multiples of the tile size in the image.
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT std::vector<MedialVoxelBox>
                   MedialVoxelCutIntoTiles(const MedialVoxelBox & region, const MedialVoxelIndex & tileSize);

/** \brief The slowest axis along which \a box has more than one voxel, and slabs are cut; 0 when there is none.
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT unsigned int
MedialVoxelSlowestAxis(const MedialVoxelBox & box);

/** \class MedialVoxelSlabPlan
 * \brief The division of a region into slabs and tiles, and its memory.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSlabPlan
{
public:
  /** \struct Settings
   * \brief The kept bits, and the cut of the work, which has no influence on results.
   * \ingroup MedialVoxel
   */
  struct Settings
  {
    std::vector<MedialVoxelBoundary> boundaries; ///< that tiles search; none: they search nothing
    bool                             keepsNotANumber{ false };
    bool                             keepsGray{ false }; ///< the values of the voxels in the window

    /** Voxels of the largest components of the object and of the background that change sides; 0 for none. */
    std::uint64_t maximumPoreSize{ 0 };

    /** Voxels around a tile that are known from the start. */
    MedialVoxelIndex halo{ { 8, 8, 8 } };

    /** Voxels beyond the upper end of a region that belong to its indices. */
    MedialVoxelIndex upperMargin{ { 0, 0, 0 } };

    /** Voxels around a tile, within the halo, that are worked on together with it. */
    MedialVoxelIndex tileMargin{ { 0, 0, 0 } };

    /** Edge of the tiles; 0 chooses. */
    std::int64_t tileSize{ 0 };

    /** Preferred edge of the tiles along y and z, if memory allows it, for tasks that repeat much work around each
     * tile; 0 for others. */
    std::int64_t preferredTileEdge{ 0 };

    /** Only lengths are searched, for which tiles are of whole rows. */
    bool findsLengthsOnly{ false };

    /** Extent of the slabs along the slowest axis; 0 chooses. */
    std::int64_t slabThickness{ 0 };

    /** Limit in bytes on windows and workspaces; 0 is without limit. Slabs become thinner and tiles smaller to keep
     * it. */
    std::uint64_t memoryLimit{ 0 };

    /** Workers at the same time. */
    unsigned int numberOfWorkers{ 1 };

    /** Prepare a second window for the next slab while this one is processed, if there are several workers and enough
     * memory. */
    bool readsAhead{ true };

    /** Bytes of a worker, beside the distance transform: for each voxel of a tile, and for the tile as a whole. */
    std::uint64_t bytesPerVoxel{ 0 };
    std::uint64_t bytesPerWorker{ 0 };

    /** For the classification, and for the nearest points of the object's border too if wanted. */
    static Settings
    ForClassification(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters, bool withObjectBoundary);

    /** For the nearest points of one boundary. */
    static Settings
    ForDistances(MedialVoxelBoundary boundary);

    /** For the distances to one boundary, without its points. */
    static Settings
    ForLengths(MedialVoxelBoundary boundary);
  };

  /** How the work is cut: tiles, slabs of tiles, and the halo around a slab. */
  struct Cut
  {
    MedialVoxelIndex tileSize;
    std::int64_t     slabThickness;
    MedialVoxelIndex halo;
  };

  MedialVoxelSlabPlan(const MedialVoxelGrid & grid, Settings settings);

  const Settings &
  GetSettings() const
  {
    return m_Settings;
  }

  unsigned int
  GetSlowestAxis() const
  {
    return m_SlowestAxis;
  }

  /** An empty window, made by the settings. */
  MedialVoxelMovingWindow
  MakeWindow() const;

  /** The coarsest cut of \a region that fits the memory with \a halo or a smaller halo; throws when there is none. */
  Cut
  ChooseCut(const MedialVoxelBox & region, const MedialVoxelIndex & halo) const;

  /** Workers that find work at the same time, at most one for each tile. */
  unsigned int
  CountWorkers(const MedialVoxelBox & region, const MedialVoxelIndex & halo) const;

  /** The slab of \a region that begins at \a position along the slowest axis. */
  MedialVoxelBox
  GetSlab(const MedialVoxelBox & region, std::int64_t position, std::int64_t thickness) const;

  static std::vector<MedialVoxelBox>
  CutTiles(const std::vector<MedialVoxelBox> & parts, const Cut & cut);

  MedialVoxelBox
  GetSitesBox(const MedialVoxelBox & slab, const MedialVoxelIndex & halo) const;

  /** As large as the box of sites of any slab of \a region. */
  MedialVoxelBox
  LargestSitesBox(const MedialVoxelBox & region, const Cut & cut) const;

  /** The larger of \a halo and the halo of \a slab in \a sites: the next slab probably needs it too. */
  MedialVoxelIndex
  WidenHalo(MedialVoxelIndex halo, const MedialVoxelBox & slab, const MedialVoxelBox & sites) const;

  /** Bytes of a window on \a sites. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & sites) const
  {
    return m_Window.GetBytes(sites);
  }

  /** Bytes of all workers for tiles in a window on \a sites. */
  std::uint64_t
  BytesOfWorkers(const MedialVoxelBox & sites, const Cut & cut) const;

  /** Bytes of a window and all workers. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & sites, const Cut & cut) const
  {
    return this->GetBytes(sites) + this->BytesOfWorkers(sites, cut);
  }

  bool
  IsWithinLimit(const std::uint64_t bytes) const
  {
    return m_Settings.memoryLimit == 0 || bytes <= m_Settings.memoryLimit;
  }

private:
  /** The cut that \a region is processed with as long as memory does not matter. */
  Cut
  PreferredCut(const MedialVoxelBox & region, const MedialVoxelIndex & halo) const;

  /** Make tiles smaller or slabs thinner; false when they cannot be. */
  bool
  MakeFiner(Cut & cut) const;

  MedialVoxelGrid         m_Grid;
  unsigned int            m_SlowestAxis;
  Settings                m_Settings;
  MedialVoxelMovingWindow m_Window; // empty; for the sizes of windows
};

} // end namespace itk

#endif
