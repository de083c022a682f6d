// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceCrossings_h
#define itkMedialVoxelSurfaceCrossings_h

#include "itkMedialVoxelLocalThreshold.h"
#include "itkMedialVoxelPairDecision.h"
#include "itkMedialVoxelPairSeparation.h"
#include "itkMedialVoxelSurfaceTopology.h"
#include "itkMedialVoxelTileObserver.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelSurfaceCrossings
 * \brief Finds the voxel edges that the medial surface crosses, for the cells of a tile.
 *
 * An edge of the voxel grid between neighbors v and w of which at least one is object is crossed when N(v) and N(w)
 * are at least epsilon apart along the boundary, with epsilon the largest one of the cells around the edge; where N is
 * not known there is no crossing.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceCrossings
{
public:
  using EdgeMask = MedialVoxelSurfaceTopology::EdgeMask;

  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  public:
    /** Crossed edges of a cell of the last tile, which the image has. */
    EdgeMask
    GetCrossedEdges(const MedialVoxelIndex & cell) const
    {
      return m_Masks[this->OffsetOf(cell)];
    }

    /** The same, once: the next tile need not clear the taken bits. */
    EdgeMask
    TakeCrossedEdges(const MedialVoxelIndex & cell)
    {
      return std::exchange(m_Masks[this->OffsetOf(cell)], EdgeMask{ 0 });
    }

    /** All crossed edges have been taken. */
    void
    Finish()
    {
      m_HasMasks = false;
    }

  private:
    friend class MedialVoxelSurfaceCrossings;

    /** The edge of a query. */
    struct Edge
    {
      MedialVoxelIndex voxel;
      unsigned int     axis;
    };

    void
    ClearMasks();

    std::size_t
    OffsetOf(const MedialVoxelIndex & cell) const
    {
      return m_Cells.OffsetOf(cell);
    }

    MedialVoxelBox        m_Cells;
    std::vector<EdgeMask> m_Masks; // at least as many
    bool                  m_HasMasks{ false };

    /** Where edges are decided together: edges that their cells and a flood leave open, and thresholds of cells. */
    MedialVoxelLocalThreshold::Workspace    m_Threshold;
    std::vector<Edge>                       m_Edges;
    std::vector<MedialVoxelSeparationQuery> m_Queries;
    std::vector<MedialVoxelSeparationQuery> m_QueryOfSplit;
    std::vector<MedialVoxelIndex>           m_ThresholdCells; // that get a threshold
    std::vector<double>                     m_ReachedRadii;   // of which all queries reach the thresholds
  };

  /** \param grid        the image in the units in which its cells are classified
   *  \param parameters  of the classification; whatever the bound, the geodesic distance defines the crossings
   */
  MedialVoxelSurfaceCrossings(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** Find the crossed edges of the cells of \a tile; incomplete after an abort.
   *
   * \return an empty box when all edges are decided, otherwise the box of sites that must be known to decide them */
  MedialVoxelBox
  Find(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const;

  /** How the face of a cell of the last tile in a direction is split, whose four edges are crossed. Voxels across from
   * each other are of one side when their boundary points are less than epsilon apart, the largest one of both cells:
   * then the face is split around the others. When both pairs are, the one whose points are nearer to each other
   * counts, and that of the first voxel when they are as near.
   *
   * \param missing  grows by the box of sites that must be known to decide it */
  MedialVoxelSurfaceTopology::Split
  FindSplit(const MedialVoxelClassifiedTile & tile,
            const MedialVoxelIndex &          cell,
            unsigned int                      direction,
            Workspace &                       workspace,
            MedialVoxelBox &                  missing) const;

  /** Bytes of a workspace for each voxel of a tile when an eighth of them are near a surface. */
  static std::uint64_t
  GetBytesPerVoxel(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

private:
  /** A row of voxels, and the axis of the edges that begin there. */
  struct Row
  {
    unsigned int axis;
    std::int64_t y;
    std::int64_t z;
  };

  /** \param voxels  the corners of the cells of the tile */
  void
  FindInRow(const MedialVoxelClassifiedTile & tile,
            const MedialVoxelBox &            voxels,
            const Row &                       row,
            Workspace &                       workspace,
            MedialVoxelBox &                  missing) const;

  void
  TakeEdges(const MedialVoxelClassifiedTile & tile,
            const Workspace::Edge &           first,
            MedialVoxelBits::WordType         edges,
            std::int64_t                      number,
            Workspace &                       workspace,
            MedialVoxelBox &                  missing) const;

  void
  DecideFixed(const MedialVoxelClassifiedTile & tile,
              const Workspace::Edge &           edge,
              const MedialVoxelPair &           pair,
              Workspace &                       workspace,
              MedialVoxelBox &                  missing) const;

  void
  AddEdge(const MedialVoxelClassifiedTile & tile,
          const Workspace::Edge &           edge,
          const MedialVoxelPair &           pair,
          Workspace &                       workspace) const;

  MedialVoxelBox
  DecideTogether(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const;

  void
  FindRadii(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const;

  void
  RaiseByBounds(Workspace & workspace) const;

  void
  SeparateByLimits(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const;

  void
  FindThresholdsOfSplits(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const;

  bool
  DecideAtOnce(MedialVoxelSeparationQuery & query, Workspace & workspace) const;

  struct Face;

  enum class Answer : std::uint8_t
  {
    Near,
    Apart,
    Unknown
  };

  static MedialVoxelPair
  PairAcross(const MedialVoxelFeatures & features, const Face & face, unsigned int uneven);

  Answer
  DecideByLimits(const MedialVoxelClassifiedTile & tile, const Face & face, unsigned int uneven) const;

  bool
  AreApart(const MedialVoxelClassifiedTile & tile,
           const Face &                      face,
           const MedialVoxelPair &           pair,
           Workspace &                       workspace,
           MedialVoxelBox &                  missing) const;

  static void
  Mark(const Workspace::Edge & edge, Workspace & workspace);

  double
  EpsilonOf(const MedialVoxelIndex & cell, const Workspace & workspace) const;

  bool
  IsAutomatic() const
  {
    return m_Parameters.mode == MedialVoxelThicknessMode::Automatic;
  }

  MedialVoxelGrid           m_Grid;
  MedialVoxelParameters     m_Parameters;
  MedialVoxelBox            m_CellBox;
  bool                      m_DecidesTogether;
  MedialVoxelDualCell       m_Cell;
  MedialVoxelPairDecision   m_Decision;
  MedialVoxelLocalThreshold m_Threshold;
  MedialVoxelBitFlood       m_Flood;
  MedialVoxelPairSeparation m_Separation;
};

} // end namespace itk

#endif
