// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrayThickness_h
#define itkMedialVoxelGrayThickness_h

#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelThickness.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelGrayThickness
 * \brief Thickness of a wall at a medial cell, measured on the gray values that the object was cut from.
 *
 * Each boundary point of the cell's corners is moved along the gradient of the values, taken half a voxel towards the
 * wall, to where the values cross the threshold that keeps it out of the object; values between voxels are trilinear.
 * The thickness is the distance of the means of both sides, of MedialVoxelThickness, along the mean direction of the
 * gradients. Where a side has no crossing within two voxels, the measurement on the object is kept.
 *
 * Walls of 3 voxels or more with values blurred by half a voxel to one voxel, and a threshold in the middle of both
 * materials, are measured with a mean error of less than 0.06 voxels, whatever their direction. Thinner walls do not
 * reach the value of their material, so that the threshold cuts them too thin.
 *
 * Outside the image, where nothing is known, the outermost voxels are continued.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrayThickness
{
public:
  /** Voxels around a boundary point whose values are read. */
  static constexpr std::int64_t Reach = 3;

  /** Object are the voxels from \a lower to \a upper, of which one may be infinite. */
  MedialVoxelGrayThickness(const MedialVoxelGrid & grid, double lower, double upper);

  /** The voxels whose values are read around the boundary points. */
  MedialVoxelBox
  GetReadBox(const MedialVoxelWallPoints & points) const;

  /** Replaces the thickness and the area of a wall that was measured on the object.
   *
   * \param gray  values of GetReadBox(points) */
  void
  Refine(const MedialVoxelGray & gray, const MedialVoxelWallPoints & points, MedialVoxelWall & wall) const;

private:
  using PositionType = std::array<double, 3>;

  /** Values relative to the threshold that separates a boundary point from the object. */
  struct Field;

  /** Sums over one side of a wall. */
  struct Side;

  /** Direction from the boundary points nearer to a to those nearer to b, in the units of the spacing. */
  PositionType
  GetDirection(const MedialVoxelWallPoints & points) const;

  /** A vector of voxels along a physical direction, the largest component of which is 1. */
  PositionType
  ToVoxels(const PositionType & direction) const;

  void
  AddCrossings(const MedialVoxelGray &  gray,
               const MedialVoxelIndex & point,
               const PositionType &     inwards,
               Side &                   side) const;

  void
  GetTangents(const PositionType & gradient, PositionType (&tangents)[2]) const;

  MedialVoxelGrid m_Grid;
  double          m_Lower;
  double          m_Upper;
  double          m_CellVolume{ 1.0 }; // along the active axes
};

} // end namespace itk

#endif
