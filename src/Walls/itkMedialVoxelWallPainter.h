// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallPainter_h
#define itkMedialVoxelWallPainter_h

#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelOpenVoxels.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelWallPainter
 * \brief Gives each object voxel of a tile the thickness of the wall whose ball is the largest that covers it.
 *
 * The ball of a wall lies around a dual cell, and covers the voxels that are nearer to its center than its radius:
 * ((x sx)^2 + (y sy)^2) + (z sz)^2 < r^2 in double and metric units. Balls are painted from the largest to the
 * smallest, equal ones from the thickest wall to the thinnest, each voxel once.
 * \ingroup MedialVoxel
 */
class MedialVoxelWallPainter
{
public:
  struct Ball
  {
    std::array<std::int32_t, 3> cell; ///< as the index of its lowest corner
    float                       thickness;
    double                      radius; ///< in units of the metric, at most the maximum
  };

  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    std::vector<Ball>     balls; ///< of all cells whose balls may reach the tile, in any order
    MedialVoxelOpenVoxels open;
  };

  /** Bytes of a workspace for each voxel of a tile and the margin around it when an eighth of the cells are medial. */
  static constexpr std::uint64_t BytesPerVoxel = sizeof(Ball) / 8 + 1;

  /** \param maximumRadius  of a ball, in the units of the spacing; positive and finite */
  MedialVoxelWallPainter(const MedialVoxelGrid & grid, double maximumRadius);

  /** Cells around a tile whose balls may reach it. */
  const MedialVoxelIndex &
  GetMargin() const
  {
    return m_Margin;
  }

  /** The cells whose balls may reach a tile. */
  MedialVoxelBox
  GetCellBox(const MedialVoxelBox & tile) const
  {
    return tile.Expanded(m_Margin).Intersection(m_Grid.GetVoxelBox());
  }

  /** \param object     bits of the tile
   * \param workspace  its balls are sorted
   * \param thickness  of the voxels of the tile, x fastest; 0 in background, NaN at object voxels that no ball covers
   */
  void
  Paint(const MedialVoxelBox &  tile,
        const MedialVoxelBits & object,
        Workspace &             workspace,
        std::vector<float> &    thickness) const;

private:
  void
  PaintBall(const Ball & ball, MedialVoxelOpenVoxels & open) const;

  /** Square of the distance of two places whose indices differ so much. */
  double
  SquareOf(double x, double y, double z) const;

  MedialVoxelGrid              m_Grid;
  MedialVoxelIndex             m_Margin;
  MedialVoxelGrid::SpacingType m_Center{}; // of a cell, from its lowest corner in voxels
};

} // end namespace itk

#endif
