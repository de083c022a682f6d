// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBallSieve_h
#define itkMedialVoxelBallSieve_h

#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelRankedBits.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <array>
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

/** \class MedialVoxelBallSieve
 * \brief Removes most balls that raise the radius of no cell, and cells that no ball raises.
 *
 * It works by blocks of cells. In walls of one thickness no other ball is larger than a cell's own ball, and most balls
 * are smaller than the own balls of all cells that they reach.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBallSieve
{
public:
  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    MedialVoxelBox                   box;    // of the blocks
    std::vector<std::vector<double>> layers; // of values of blocks, by the blocks that balls reach; 0: of the survey
    std::vector<double>              copy;
  };

  explicit MedialVoxelBallSieve(const MedialVoxelGrid & grid);

  /** Finds the largest balls around the cells of \a box. */
  void
  Survey(const MedialVoxelBox & box, const std::vector<MedialVoxelInscribedBall> & balls, Workspace & workspace) const;

  /** At least the radius of the largest ball of the survey that covers \a cell, which is in its box; 0 for no ball. */
  static double
  GetLargest(const MedialVoxelIndex & cell, const Workspace & workspace);

  /** Keeps balls and cells that may matter, in their order.
   *
   * \param cells  bits by index of the cell, ranked, in the box of the survey
   * \param radii  of the cells, in metric units, in the order x, y, z of the bits that are set
   * \param all    the balls of the survey
   * \param balls  replaced by balls that may be larger than the radius of a cell which they cover
   * \param open   replaced by the cells that a larger ball may cover */
  void
  Sieve(const MedialVoxelRankedBits &                 cells,
        const std::vector<double> &                   radii,
        const std::vector<MedialVoxelInscribedBall> & all,
        Workspace &                                   workspace,
        std::vector<MedialVoxelInscribedBall> &       balls,
        MedialVoxelBits &                             open) const;

private:
  /** Blocks around that of its center in which a ball may have cells. */
  std::size_t
  ReachOf(double radius) const;

  double                     m_BlockLength; // along the axis where it is shortest
  std::array<std::size_t, 3> m_MostReach;   // blocks that reach over the whole image
};

} // end namespace itk

#endif
