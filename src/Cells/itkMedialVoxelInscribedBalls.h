// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelInscribedBalls_h
#define itkMedialVoxelInscribedBalls_h

#include "itkMedialVoxelBallSieve.h"
#include "itkMedialVoxelRankedBits.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelInscribedBalls
 * \brief Finds the largest of many balls that covers each cell.
 *
 * A ball covers the cells whose centers are not farther from its own than the radius, by squared metric lengths:
 * MedialVoxelGrid::SquaredMetricLength() <= radius * radius. The result is a maximum, so it does not depend on the
 * order of the balls.
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
    MedialVoxelBallSieve::Workspace        sieve;
    std::vector<MedialVoxelInscribedBall>  balls; // that may raise a cell
    MedialVoxelBits                        open;  // cells that no ball covers yet
    std::vector<MedialVoxelBits::WordType> rows;  // bits of the parts of rows that have open cells
  };

  explicit MedialVoxelInscribedBalls(const MedialVoxelGrid & grid);

  /** Find the largest balls around the cells of \a box, for GetLargest() and Raise(). */
  void
  Survey(const MedialVoxelBox & box, const std::vector<MedialVoxelInscribedBall> & balls, Workspace & workspace) const
  {
    m_Sieve.Survey(box, balls, workspace.sieve);
  }

  /** At least the radius of the largest ball that covers a cell of the survey. */
  static double
  GetLargest(const MedialVoxelIndex & cell, const Workspace & workspace)
  {
    return MedialVoxelBallSieve::GetLargest(cell, workspace.sieve);
  }

  /** Raise the radius of each cell to the radius of the largest ball that covers it, after a survey.
   *
   * \param balls  balls of the survey
   * \param cells  bits by index of the cell, ranked, in the box of the survey
   * \param radii  of the cells, in metric units, in the order x, y, z of the bits that are set; 0 where a cell has none
   */
  void
  Raise(const std::vector<MedialVoxelInscribedBall> & balls,
        const MedialVoxelRankedBits &                 cells,
        Workspace &                                   workspace,
        std::vector<double> &                         radii) const;

private:
  class Sweep;

  /** The shape of a ball: of its cells in a row at (dy, dz), dx is from -reach to reach. */
  struct Shape
  {
    MedialVoxelIndex          margin;  // of the ball
    std::vector<std::int64_t> reaches; // y fastest; -1 where a row has no cell
    std::vector<std::int64_t> widths;  // of each slice: the largest dy
  };

  void
  FindShape(double squaredRadius, Shape & shape) const;

  MedialVoxelGrid      m_Grid;
  MedialVoxelBallSieve m_Sieve;
};

} // end namespace itk

#endif
