// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelDualCell_h
#define itkMedialVoxelDualCell_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** Displacement in voxels. */
using MedialVoxelDisplacement = std::array<std::int64_t, 3>;

/** \class MedialVoxelDualCell
 * \brief Geometry of the dual cell of a grid: corners, diagonals, and the measures of a pair of boundary points.
 *
 * A cell is the center of 2^A voxels, where A is the number of active axes. Bit i of a corner's number says that the
 * corner is the upper one along the i-th active axis; diagonal k joins the corners k and 2^A - 1 - k.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelDualCell
{
public:
  explicit MedialVoxelDualCell(const MedialVoxelGrid & grid);

  unsigned int
  GetNumberOfCorners() const
  {
    return m_NumberOfCorners;
  }

  unsigned int
  GetNumberOfDiagonals() const
  {
    return m_NumberOfCorners / 2;
  }

  /** Offset of a corner from the lowest one. */
  const MedialVoxelDisplacement &
  GetCorner(unsigned int corner) const
  {
    return m_Corners[corner];
  }

  unsigned int
  GetOppositeCorner(unsigned int corner) const
  {
    return m_NumberOfCorners - 1 - corner;
  }

  /** Signed squared cosine of the angle at the cell's center between the two boundary points of a diagonal.
   *
   * dot |dot| / ((A.A)(C.C)) with A = N(vi) - p and C = N(vj) - p; smaller means a wider angle. The paper measures the
   * angle between the distance vectors of the two voxels (Sec. 3.3); at the center it exists for every cell. */
  double
  CosineKey(unsigned int                    diagonal,
            const MedialVoxelDisplacement & displacement,
            const MedialVoxelDisplacement & oppositeDisplacement) const;

  /** True when the two points are equal or joined by an edge shorter than \a epsilon (Fig. 5 of the paper). */
  bool
  IsTrivial(const MedialVoxelDisplacement & difference, double epsilon) const;

  /** Length of the shortest path between two points in the complete voxel grid, in physical units. */
  double
  FreeSpaceLength(const MedialVoxelDisplacement & difference) const;

  /** d theta of Eq. 2 with the smaller norm d of the two displacements and the angle theta between them, in physical
   * units; 0, which bounds nothing, when either displacement is zero. */
  double
  PseudoGeodesicDistance(const MedialVoxelDisplacement & a, const MedialVoxelDisplacement & b) const;

private:
  MedialVoxelGrid                        m_Grid;
  unsigned int                           m_NumberOfCorners{ 1 };
  std::array<MedialVoxelDisplacement, 8> m_Corners{};
};

/** Number of edges of each class on a path; index 1..7 is the mask of the axes that the edge changes. */
using MedialVoxelEdgeCounts = std::array<std::int64_t, 8>;

/** \brief Length of a path: the sum over the edge classes, in mask order, of count times edge length.
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT double
MedialVoxelPathLength(const MedialVoxelGrid & grid, const MedialVoxelEdgeCounts & counts);

} // end namespace itk

#endif
