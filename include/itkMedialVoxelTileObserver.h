// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileObserver_h
#define itkMedialVoxelTileObserver_h

#include "itkMedialVoxelClassifier.h"
#include "itkMedialVoxelTileWalls.h"

#include "MedialVoxelExport.h"

#include <vector>

namespace itk
{

/** \struct MedialVoxelClassifiedTile
 * \brief All that is known of a tile whose cells are decided.
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

  /** For more searches on the boundary with the threshold of the classification: begun for this tile. */
  MedialVoxelBoundedGeodesic::Workspace & geodesic;

  /** To be asked for an abort by an observer that takes long; what it observed is then discarded. */
  const MedialVoxelProgress & progress;

  const MedialVoxelGray & gray; ///< values around the tile; empty unless the filter measures on them
};

/** \class MedialVoxelTileObserver
 * \brief Sees each tile while its data are at hand, so that statistics need no second pass.
 *
 * An execution tells Begin(), then Observe() for every tile with an object, in any order and from several threads at
 * a time, and at last Commit(). What was observed since Begin() counts only with Commit(): an execution that fails is
 * begun again with other regions. An observer that needs to know more sites takes nothing and says which; it gets the
 * tile again when they are known.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileObserver
{
public:
  virtual ~MedialVoxelTileObserver();

  virtual void
  Begin() = 0;

  /** The cells of a row whose walls are to be measured, of which the medial ones are. More are when the filter needs
   * them for an output. Called from several threads at a time; default none. */
  virtual MedialVoxelBits::WordType
  SelectCells(const MedialVoxelCellRow & row) const;

  /** \return an empty box, or the box of sites that must be known to observe \a tile, which was not. */
  virtual MedialVoxelBox
  Observe(const MedialVoxelClassifiedTile & tile) = 0;

  virtual void
  Commit() = 0;
};

} // end namespace itk

#endif
