// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrayThickness_h
#define itkMedialVoxelGrayThickness_h

#include "itkMedialVoxelGrayBoundary.h"
#include "itkMedialVoxelThickness.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelGrayThickness
 * \brief Thickness of a wall at a medial cell, measured on the gray values that the object was cut from.
 *
 * Each boundary point of the cell's corners is moved by MedialVoxelGrayBoundary to where the values cross the
 * threshold. Their means of both sides, of MedialVoxelThickness, and the mean direction of the gradients tell where the
 * line through the center of the cell meets both surfaces. The thickness is the way between the surfaces along this
 * direction, each being looked for once more around there. Where a side has no crossing within two voxels, the
 * measurement on the object is kept; rims are found on the object.
 *
 * Walls do not reach the value of their material when they are thinner than about three times the blur, nor gaps that
 * of the background: the threshold cuts such walls too thin and such gaps too narrow. doc/explanation/accuracy.md has
 * the errors.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrayThickness
{
public:
  /** Of the boundary points of the corners, in their order. */
  using Crossings = std::array<MedialVoxelGrayBoundary::Crossing, 8>;

  /** Object are the voxels from \a lower to \a upper, of which one may be infinite. */
  MedialVoxelGrayThickness(const MedialVoxelGrid & grid, double lower, double upper);

  /** The voxels whose values are read around the boundary points. */
  MedialVoxelBox
  GetReadBox(const MedialVoxelWallPoints & points) const;

  /** Where the values cross the threshold next to the boundary points; not next to those that are halfway between both
   * sides.
   *
   * \param gray  values of GetReadBox(points) */
  Crossings
  FindCrossings(const MedialVoxelGray & gray, const MedialVoxelWallPoints & points) const;

  /** Replaces the thickness and the area of a wall that was measured on the object. */
  void
  Refine(const MedialVoxelGray &       gray,
         const MedialVoxelWallPoints & points,
         const Crossings &             crossings,
         MedialVoxelWall &             wall) const;

  /** What moves the points. */
  const MedialVoxelGrayBoundary &
  GetBoundary() const
  {
    return m_Boundary;
  }

private:
  using PositionType = MedialVoxelGrayBoundary::PositionType;

  /** Direction from the boundary points nearer to a to those nearer to b, in the units of the spacing. */
  PositionType
  GetDirection(const MedialVoxelWallPoints & points) const;

  /** The voxels around the boundary points, whether or not the image has them. */
  static MedialVoxelBox
  GetBoxAround(const MedialVoxelWallPoints & points);

  MedialVoxelGrid         m_Grid;
  MedialVoxelGrayBoundary m_Boundary;
  double                  m_CellVolume{ 1.0 }; // along the active axes
  double                  m_Smallest;          // of MedialVoxelThickness
};

} // end namespace itk

#endif
