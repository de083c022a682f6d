// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImportance_h
#define itkMedialVoxelImportance_h

#include "itkMedialVoxelBlockSeparation.h"
#include "itkMedialVoxelBoundaryDistances.h"
#include "itkMedialVoxelBoundaryGraph.h"
#include "itkMedialVoxelCellPairs.h"
#include "itkMedialVoxelLocalThreshold.h"
#include "itkMedialVoxelPairSeparation.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelPathSearch.h"
#include "itkMedialVoxelProgress.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelImportance
 * \brief Finds the geodesic distance of the pair of each cell, up to a cap: the measure that thresholds are compared
 * with.
 *
 * The importance of a cell is the length of the shortest path on the boundary between the two points that decide the
 * cell (Reniers, van Wijk and Telea 2008). The cells at or above pi / 2 times a thickness are the medial cells for this
 * thickness. Trivial cells, whose points are the same or neighbors, have the importance 0.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelImportance
{
public:
  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  private:
    friend class MedialVoxelImportance;

    std::vector<MedialVoxelSeparationQuery> m_Queries; // of the cells that no bound decides
    MedialVoxelBlockSeparation::Workspace   m_Blocks;
    MedialVoxelPairSeparation::Workspace    m_Separation;
    MedialVoxelPathSearch::Workspace        m_Search;
    MedialVoxelBoundaryGraph                m_Graph;
    MedialVoxelBoundaryDistances            m_Distances;
    MedialVoxelLocalThreshold::Workspace    m_Threshold;
  };

  /** Memory of a workspace for each voxel of a tile when an eighth of the cells wait. */
  static constexpr std::uint64_t BytesPerVoxel = sizeof(MedialVoxelSeparationQuery) / 8;

  /** The same for thresholds, with them. */
  static constexpr std::uint64_t ThresholdBytesPerVoxel = sizeof(float) + sizeof(double) / 8;

  /** Longer distances have the cap as importance: pi / 2 times the largest thickness of the parameters. */
  MedialVoxelImportance(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** Find the importance of the cells of a tile.
   *
   * \param window      object bits, and the background border as sites
   * \param features    displacements of all corners of the tile
   * \param progress    asked for an abort, after which the result is incomplete
   * \param importance  replaced, x fastest, in physical units; 0 where no corner is object
   * \return an empty box, or the box of sites that must be known */
  MedialVoxelBox
  Compute(const MedialVoxelWindow &   window,
          const MedialVoxelBox &      tile,
          const MedialVoxelFeatures & features,
          const MedialVoxelProgress & progress,
          Workspace &                 workspace,
          std::vector<float> &        importance) const;

  /** Find the thresholds of the cells that have an importance. The medial ones have an importance of at least their
   * threshold, all others a lower one: a threshold that rounding would make equal to it is the next larger number.
   *
   * \param balls       all that cover one of the cells, for the automatic thickness
   * \param features    as for Compute()
   * \param labels      of the cells of the tile, x fastest
   * \param importance  of Compute()
   * \param thresholds  replaced, x fastest, in physical units; 0 where the importance is 0 */
  void
  FindThresholds(const std::vector<MedialVoxelInscribedBall> & balls,
                 const MedialVoxelFeatures &                   features,
                 const MedialVoxelBox &                        tile,
                 const std::vector<std::uint8_t> &             labels,
                 const std::vector<float> &                    importance,
                 Workspace &                                   workspace,
                 std::vector<float> &                          thresholds) const;

private:
  void
  AddCells(const MedialVoxelFeatures & features,
           const MedialVoxelBox &      tile,
           MedialVoxelCells &          cells,
           Workspace &                 workspace,
           std::vector<float> &        importance) const;

  double
  FindLength(const MedialVoxelBits & boundary, const MedialVoxelSeparationQuery & query, Workspace & workspace) const;

  MedialVoxelGrid            m_Grid;
  MedialVoxelParameters      m_Parameters;
  MedialVoxelLocalThreshold  m_Threshold;
  double                     m_Cap;
  MedialVoxelCellPairs       m_Pairs;
  MedialVoxelBlockSeparation m_Blocks;
  MedialVoxelPairSeparation  m_Separation;
  MedialVoxelPathSearch      m_Search;
};

} // end namespace itk

#endif
