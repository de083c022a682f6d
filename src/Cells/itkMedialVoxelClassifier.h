// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelClassifier_h
#define itkMedialVoxelClassifier_h

#include "itkMedialVoxelCellPairs.h"
#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelJointClassifier.h"
#include "itkMedialVoxelPairDecision.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelReachingVoxels.h"
#include "itkMedialVoxelThickness.h"
#include "itkMedialVoxelTileLabels.h"

#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

namespace itk
{

/** \class MedialVoxelClassifier
 * \brief Labels the dual cells of one tile from the nearest boundary points of its voxels.
 *
 * Each candidate cell is decided by the first phase that can (Michikawa and Suzuki, Sec. 3.3): trivial pairs, the bound
 * of the parameters, the geodesic search. With an automatic thickness each cell has a threshold of its own, see
 * MedialVoxelLocalThreshold. Cells with own or long thresholds are decided together, others one after the other.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelClassifier
{
public:
  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    MedialVoxelPairDecision::Workspace    geodesic;
    MedialVoxelJointClassifier::Workspace joint;
    MedialVoxelReachingVoxels::Workspace  reaching;
    MedialVoxelBox                        cells; // that get a threshold

    /** With keepsRows: the rows of the last tile that have candidates. */
    bool                            keepsRows{ false };
    std::vector<MedialVoxelCellRow> rows;
  };

  MedialVoxelClassifier(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** Corners of the cells of \a tile. */
  MedialVoxelBox
  GetCornerBox(const MedialVoxelBox & tile) const;

  /** Voxels whose features the labels of \a tile depend on. */
  MedialVoxelBox
  GetVoxelBox(const MedialVoxelBox & tile) const;

  /** The window with the voxels of GetVoxelBox() that need a displacement, which the workspace keeps until the next
   * tile. With an automatic thickness, voxels around \a tile matter only where balls reach it. Other windows need all.
   *
   * \param window       object bits of GetVoxelBox()
   * \param looksAround  the cells beside \a tile need their thresholds, too */
  MedialVoxelWindow
  FindAsked(const MedialVoxelWindow & window,
            const MedialVoxelBox &    tile,
            bool                      looksAround,
            Workspace &               workspace) const;

  /** Voxels that get displacements: GetVoxelBox(), or the part of it that a window of FindAsked() needs. */
  MedialVoxelBox
  GetFeatureBox(const MedialVoxelWindow & window, const MedialVoxelBox & tile, const Workspace & workspace) const
  {
    return window.asked == nullptr ? this->GetVoxelBox(tile) : workspace.reaching.box;
  }

  /** Object voxels whose cells are looked at, of a window of FindAsked() or one that asks for all. */
  static const MedialVoxelBits &
  GetReachingVoxels(const MedialVoxelWindow & window, const Workspace & workspace)
  {
    return window.asked == nullptr ? *window.object : workspace.reaching.reaching;
  }

  /** Labels of \a tile, x fastest.
   *
   * \param window     object bits, and the background border as sites
   * \param tile       indices to label; the last index of an active axis has no cell and gets 0
   * \param features   displacements for GetFeatureBox(), as far as the window asks for them
   * \param progress   asked for an abort before each cell that is not trivial, after which labels and counts are
   * incomplete
   * \param labels     MedialVoxelLabel values, resized to the tile
   * \param counts     cells of each phase, added to the numbers that it holds
   * \return an empty box when all cells are decided, otherwise the box of sites that must be known to decide them */
  MedialVoxelBox
  Classify(const MedialVoxelWindow &   window,
           const MedialVoxelBox &      tile,
           const MedialVoxelFeatures & features,
           const MedialVoxelProgress & progress,
           Workspace &                 workspace,
           std::vector<std::uint8_t> & labels,
           MedialVoxelCounts &         counts) const;

  /** The boundary points that decide \a cell, from the features of a tile that it is in.
   * \return false when there is no pair or it is trivial, as at cells that are not medial */
  bool
  GetWallPoints(const MedialVoxelFeatures & features,
                const MedialVoxelIndex &    cell,
                MedialVoxelWallPoints &     wall) const;

  /** Cells of a row from \a first on, for GetWallPoints() of the cells in \a asked (bit 0 is the first one), whose
   * displacements it prefetches. */
  MedialVoxelCells
  FindCells(const MedialVoxelFeatures &     features,
            const MedialVoxelIndex &        first,
            const MedialVoxelBits::WordType asked) const
  {
    return m_Pairs.CellsFrom(features, first, asked);
  }

  /** The boundary points at the cell \a x after the first one of \a cells, which its \a diagonal decides. */
  void
  GetWallPoints(const MedialVoxelFeatures & features,
                const MedialVoxelCells &    cells,
                int                         x,
                unsigned int                diagonal,
                MedialVoxelWallPoints &     wall) const;

  /** Whether cells of a tile are decided together: each threshold depends on the cells around, or searches are long. */
  static bool
  DecidesTogether(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** The decisions of the last tile, of a classifier that decides together. */
  const MedialVoxelJointClassifier &
  GetJoint() const
  {
    assert(m_Joint);
    return *m_Joint;
  }

  /** The thresholds of cells; only with an automatic thickness. */
  const MedialVoxelLocalThreshold &
  GetThreshold() const
  {
    assert(m_Joint);
    return m_Joint->GetThreshold();
  }

  /** Bytes of a workspace, beside GetBytesPerVoxel(). */
  static std::uint64_t
  GetBytes(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** Bytes of a workspace for each voxel of a tile and of the margin around it. */
  static std::uint64_t
  GetBytesPerVoxel(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

private:
  /** The cells that get a threshold; observers may look at cells beside a tile, too. */
  MedialVoxelBox
  GetCells(const MedialVoxelBox & tile, bool looksAround) const;

  bool
  IsAutomatic() const
  {
    return m_Parameters.mode == MedialVoxelThicknessMode::Automatic;
  }

  /** Decide one cell after the other. */
  MedialVoxelBox
  ClassifyEach(const MedialVoxelTileInput &         input,
               MedialVoxelPairDecision::Workspace & workspace,
               MedialVoxelTileLabels &              labels) const;

  bool
  ClassifyCells(const MedialVoxelTileInput &         input,
                MedialVoxelCells &                   cells,
                MedialVoxelPairDecision::Workspace & workspace,
                MedialVoxelTileLabels &              labels,
                MedialVoxelBox &                     missing) const;

  MedialVoxelGrid                           m_Grid;
  MedialVoxelParameters                     m_Parameters;
  MedialVoxelCellPairs                      m_Pairs;
  MedialVoxelReachingVoxels                 m_Reaching;
  MedialVoxelPairDecision                   m_Decision;
  std::optional<MedialVoxelJointClassifier> m_Joint; // for cells that are decided together
};

} // end namespace itk

#endif
