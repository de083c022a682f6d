// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelInscribedBalls_h
#define itkMedialVoxelInscribedBalls_h

#include "itkMedialVoxelRankedBits.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \struct MedialVoxelInscribedBall
 * \brief A ball between opposite walls, around the center of a cell.
 * \ingroup MedialVoxel
 */
struct MedialVoxelInscribedBall
{
  MedialVoxelIndex center; ///< index of the cell
  double           radius; ///< in metric units, positive
};

/** \class MedialVoxelInscribedBalls
 * \brief Finds the largest of many balls that covers each cell.
 *
 * A ball covers the cells whose centers are not farther from its own than the radius, by squared metric lengths:
 * MedialVoxelGrid::SquaredMetricLength() <= radius * radius. What is found is a maximum, so that it does not depend on
 * an order of the balls.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelInscribedBalls
{
public:
  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    MedialVoxelBits                        uncovered;
    std::vector<MedialVoxelBits::WordType> rows; // a bit for each row that has uncovered cells, y fastest
  };

  explicit MedialVoxelInscribedBalls(const MedialVoxelGrid & grid);

  /** Radius of the largest ball that covers each cell of \a cells, 0 where none does.
   *
   * \param balls  left in another order
   * \param cells  bits by index of the cell, ranked
   * \param radii  in metric units, in the order x, y, z of the bits that are set */
  void
  Cover(std::vector<MedialVoxelInscribedBall> & balls,
        const MedialVoxelRankedBits &           cells,
        Workspace &                             workspace,
        std::vector<double> &                   radii) const;

private:
  /** The shape of a ball: of its cells in a row at (dy, dz), dx is from -reach to reach. */
  struct Shape
  {
    MedialVoxelIndex          margin;  // of the ball
    std::vector<std::int64_t> reaches; // y fastest; -1 where a row has no cell
    std::vector<std::int64_t> widths;  // of each slice: the largest dy
  };

  void
  FindShape(double squaredRadius, Shape & shape) const;

  MedialVoxelGrid m_Grid;
};

} // end namespace itk

#endif
