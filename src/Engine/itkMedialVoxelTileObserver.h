// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileObserver_h
#define itkMedialVoxelTileObserver_h

#include "itkMedialVoxelClassifier.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelTileWalls.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{

/** \struct MedialVoxelClassifiedTile
 * \brief The data of a tile whose cells are decided.
 * \ingroup MedialVoxel
 */
struct MedialVoxelClassifiedTile
{
  const MedialVoxelBox &                  box;
  const MedialVoxelWindow &               window;     ///< object bits and boundary around the tile
  const MedialVoxelFeatures &             features;   ///< displacements to the nearest boundary points
  const MedialVoxelClassifier &           classifier; ///< finds the pair of a cell again
  const std::vector<MedialVoxelCellRow> & rows;       ///< the cells with an object corner, by rows
  const std::vector<MedialVoxelWall> &    walls;      ///< at the measured cells of the rows, in their order

  /** Cells of the classifier, and its memory for more searches on the boundary around this tile. */
  MedialVoxelClassifier::Workspace & classification;

  /** An observer that takes long checks it for an abort; its observations are then discarded. */
  const MedialVoxelProgress & progress;

  const MedialVoxelGray & gray; ///< values around the tile; empty unless the filter measures on them

  MedialVoxelGrayThickness::Workspace & fits; ///< memory to measure on them

  const std::vector<float> * importance{ nullptr }; ///< of the cells of the box; null unless it is found
};

/** \class MedialVoxelTileObserver
 * \brief Sees each tile while its data are at hand, so that statistics need no second pass.
 *
 * A run calls Begin(), then Observe() once for every tile with an object, in any order and from several threads at a
 * time, and at last Commit(). Observations since Begin() count only with Commit(): a run that fails is begun again with
 * other regions. Examine() comes before Observe(): it returns further sites that the observer needs, and no observer
 * observes the tile until all have them.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileObserver
{
public:
  /** Memory of one worker, in which an observer keeps results from Examine() to Observe(). */
  struct Workspace
  {
    virtual ~Workspace();
  };

  virtual ~MedialVoxelTileObserver();

  /** Bytes of a worker's workspace for each voxel of a tile; they count for the memory limit. */
  virtual std::uint64_t
  GetBytesPerVoxel() const = 0;

  /** A workspace, which is null by default. */
  virtual std::unique_ptr<Workspace>
  MakeWorkspace() const;

  /** Walls are measured on these gray values, which tiles then have. Called before the first tile of a run; does
   * nothing by default. */
  virtual void
  MeasureOnGrayValues(const MedialVoxelSheetExtraction::GrayRange & range);

  /** True when the observer looks at the thresholds of cells beside a tile; default false. */
  virtual bool
  LooksAround() const;

  virtual void
  Begin() = 0;

  /** The cells of a row whose walls are to be measured; only medial ones are. Others are measured as well when the run
   * needs them. Called from several threads at a time; default none. */
  virtual MedialVoxelBits::WordType
  SelectCells(const MedialVoxelCellRow & row) const;

  /** Called before Observe(), and again for the same or a smaller tile when it was not empty: \return the box of sites
   * that must be known to observe \a tile, by default an empty one. */
  virtual MedialVoxelBox
  Examine(const MedialVoxelClassifiedTile & tile, Workspace * workspace) const;

  virtual void
  Observe(const MedialVoxelClassifiedTile & tile, Workspace * workspace) = 0;

  virtual void
  Commit() = 0;
};

} // end namespace itk

#endif
