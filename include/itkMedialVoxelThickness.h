// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelThickness_h
#define itkMedialVoxelThickness_h

#include "itkMedialVoxelBits.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \struct MedialVoxelWallPoints
 * \brief What is known of the wall at a medial cell: the nearest boundary points of its corners, and the pair that
 * decided it.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelWallPoints
{
  std::array<MedialVoxelIndex, 8> corners{};            ///< the first \a numberOfCorners count
  unsigned int                    numberOfCorners{ 0 }; ///< 2, 4 or 8
  MedialVoxelIndex                a{};                  ///< N(vi) of the chosen diagonal
  MedialVoxelIndex                b{};                  ///< N(vj), not equal to \a a
};

/** \struct MedialVoxelWall
 * \brief What is measured of the wall at a medial cell.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelWall
{
  float         thickness{ 0.0f }; ///< in the units of the grid's spacing, not negative
  float         area{ 0.0f };      ///< of the mid-surface that the cell stands for, in squared units; in 2-D a length
  std::uint32_t axis{ 0 };         ///< the axis that the way through the wall is longest along
};

/** \class MedialVoxelThickness
 * \brief Thickness of a wall at a medial cell, measured on the binary object.
 *
 * The boundary points of the corners are split into two sides, by which of a and b they are nearer to in voxels;
 * points halfway belong to neither. The thickness is the distance of the means of both sides, less the way from the
 * boundary voxels' centers to the faces of the wall. That way follows from the share of object voxels among the 3^D
 * voxels around each point: a plane across the direction of the wall that cuts off this share. Walls parallel to an
 * axis are measured exactly; walls at other angles of 2 voxels or more with a mean error of less than 0.2 voxels, but
 * for those at 45 degrees to two axes, whose layers of 0.71 voxels hide up to 0.36.
 *
 * Outside the image, where nothing is known, the outermost voxels are continued.
 *
 * A plane with the unit normal n passes through (|nx| sx + |ny| sy + |nz| sz) / (sx sy sz) cells of the size s for each
 * unit of its area. The inverse, with the direction from one side to the other as the normal, is the area that a cell
 * stands for. The areas of a wall parallel to an axis add up exactly; those of other walls to 1.1 times the area at 2
 * voxels of thickness, where boundary points tell little of the direction, and to less than 1.05 times at 6 and more.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelThickness
{
public:
  explicit MedialVoxelThickness(const MedialVoxelGrid & grid);

  /** \param object  bits of all voxels that are neighbors of the boundary points and in the image */
  MedialVoxelWall
  Measure(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall) const;

  /** Object voxels among the 3^D voxels around \a point. */
  int
  CountObjectAround(const MedialVoxelBits & object, const MedialVoxelIndex & point) const;

private:
  int
  CountAtFaceOfImage(const MedialVoxelBits & object, const MedialVoxelIndex & point) const;

  MedialVoxelGrid m_Grid;
  int             m_BlockVoxels{ 1 };  // 3^D
  double          m_CellVolume{ 1.0 }; // along the active axes
};

} // end namespace itk

#endif
