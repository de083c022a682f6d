// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBallPainter_h
#define itkMedialVoxelBallPainter_h

#include "itkMedialVoxelBallRanks.h"
#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelFeatures.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelOpenVoxels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelBallPainter
 * \brief Gives each object voxel of a tile the diameter of the largest ball inside the object that covers it.
 *
 * A ball around an object voxel has the distance to the nearest boundary voxel as its radius, but not more than a
 * maximum. It covers the voxels that are nearer than its radius. Balls are cut, not results: so a result depends on
 * voxels within twice the maximum alone.
 *
 * Balls of which all voxels are in the ball of a neighbor are left out. The others are painted from the largest to the
 * smallest, each voxel once.
 * \ingroup MedialVoxel
 */
class MedialVoxelBallPainter
{
public:
  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  private:
    friend class MedialVoxelBallPainter;

    std::vector<std::uint32_t> m_Ranks;   ///< of the balls around the voxels of the padded center box; 0 in background
    std::vector<std::uint32_t> m_Kept;    ///< places of the balls that are painted
    std::vector<std::uint32_t> m_Order;   ///< the same, the largest first
    std::vector<std::uint32_t> m_Begins;  ///< in the order, of the balls of each rank
    std::vector<std::int32_t>  m_Spans;   ///< half widths of the rows of a ball
    MedialVoxelIndex           m_Reach{}; ///< of that ball
    MedialVoxelOpenVoxels      m_Open;    ///< voxels of the tile that are not painted yet
  };

  /** Bytes of a workspace for each voxel of a center box, beside its displacements. */
  static constexpr std::uint64_t BytesPerVoxel = 3 * sizeof(std::uint32_t) + 1;

  /** \param maximumRadius  of a ball, in the units of the spacing; positive and finite */
  MedialVoxelBallPainter(const MedialVoxelGrid & grid, double maximumRadius);

  /** Voxels around a tile whose balls may reach it. */
  const MedialVoxelIndex &
  GetMargin() const
  {
    return m_Ranks.GetMargin();
  }

  /** The voxels whose balls may reach a tile. */
  MedialVoxelBox
  GetCenterBox(const MedialVoxelBox & tile) const
  {
    return tile.Expanded(m_Ranks.GetMargin()).Intersection(m_Grid.GetVoxelBox());
  }

  /** \param object    bits of the center box of the tile
   * \param features   displacements of the object voxels of the center box to their nearest boundary voxels; may be
   *                   missing beyond the maximum
   * \param diameters  of the voxels of the tile, x fastest; 0 in background */
  void
  Paint(const MedialVoxelBox &      tile,
        const MedialVoxelBits &     object,
        const MedialVoxelFeatures & features,
        Workspace &                 workspace,
        std::vector<float> &        diameters) const;

private:
  struct Tile;

  struct Neighbor
  {
    unsigned int   axes; ///< bits of the axes along which it lies
    std::ptrdiff_t step; ///< to it in the ranks
  };

  void
  RankBalls(const Tile & tile) const;

  std::vector<Neighbor>
  ListNeighbors(const MedialVoxelBox & padded) const;

  bool
  IsInBallOfNeighbor(const std::uint32_t * ball, const std::vector<Neighbor> & neighbors) const;

  bool
  IsAmongLargest(const std::uint32_t * ball, const std::vector<Neighbor> & neighbors) const;

  void
  SortBalls(const Tile & tile) const;

  void
  OrderByRank(Workspace & workspace) const;

  void
  PaintBalls(const Tile & tile) const;

  void
  FindSpans(std::uint32_t rank, Workspace & workspace) const;

  void
  PaintBall(const Tile & tile, const MedialVoxelIndex & center, float diameter) const;

  MedialVoxelGrid      m_Grid;
  MedialVoxelBallRanks m_Ranks;
};

} // end namespace itk

#endif
