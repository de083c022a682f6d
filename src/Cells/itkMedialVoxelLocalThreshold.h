// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLocalThreshold_h
#define itkMedialVoxelLocalThreshold_h

#include "itkMedialVoxelCellPairs.h"
#include "itkMedialVoxelInscribedBalls.h"
#include "itkMedialVoxelParameters.h"

#include <algorithm>
#include <vector>

namespace itk
{

/** \class MedialVoxelLocalThreshold
 * \brief The threshold of each cell, from the thickness of the wall that it is in.
 *
 * A cell whose pair (N(vi), N(vj)) is neither equal nor adjacent is the center p of an inscribed ball with the radius
 * d(p) = (|N(vi) - p| + |N(vj) - p|) / 2. The thickness of the wall at a cell p shows in the largest ball that covers
 * its center: LT(p) is the largest of d(p), if p has a ball, and of all d(q) <= R with |q - p| <= d(q); 0 where there
 * is none. The threshold is epsilon(p) = max(E, k min(LT(p), R)), with E the epsilon, R the largestRadius and k the
 * thicknessFactor of the parameters. A small branch in a thick wall is covered by the balls of the wall, which is why
 * the threshold that removes it does not remove thin walls.
 *
 * All of this is evaluated in double: |N(vi) - p| is the square root of ((x sx)^2 + (y sy)^2) + (z sz)^2, d is 0.5
 * times the sum of both, |q - p| <= d(q) is compared as squares, all in metric units, which are voxels where spacings
 * are equal; then d times the metric unit is a physical length. The maximum does not depend on an order, and the
 * threshold grows with E, k and R.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelLocalThreshold
{
public:
  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    std::vector<MedialVoxelInscribedBall> balls;
    MedialVoxelRankedBits                 cells;
    std::vector<double>                   radii; // of the cells
    MedialVoxelInscribedBalls::Workspace  cover;
  };

  MedialVoxelLocalThreshold(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** Cells whose balls can cover a cell of \a cells. */
  MedialVoxelBox
  GetCellBox(const MedialVoxelBox & cells) const;

  /** Cells along each axis that a ball reaches, and one more, because cells around a tile have thresholds too. */
  MedialVoxelIndex
  GetMargin() const;

  /** d(p) in metric units, of a cell with \a widest; 0 when the pair makes no ball. */
  double
  RadiusOf(const MedialVoxelDiagonal & widest) const;

  /** True when a ball of this radius can raise a threshold of another cell. */
  bool
  CanRaise(const double radius) const
  {
    return radius * m_Unit <= m_Parameters.largestRadius &&
           m_Parameters.thicknessFactor * (radius * m_Unit) > m_Parameters.epsilon;
  }

  /** Find the largest balls of a workspace around the cells of a tile, for GetLargestRadius() and RaiseRadii(). */
  void
  SurveyBalls(const MedialVoxelBox & tile, Workspace & workspace) const
  {
    m_Cover.Survey(tile, workspace.balls, workspace.cover);
  }

  /** At least LT(p) of a cell of the surveyed tile with a ball of \a radius or 0, in metric units. */
  static double
  GetLargestRadius(const MedialVoxelIndex & cell, const double radius, const Workspace & workspace)
  {
    return std::max(radius, MedialVoxelInscribedBalls::GetLargest(cell, workspace.cover));
  }

  /** Raise the radii of the cells of a workspace, d(p) or 0 at first, to LT(p) in metric units, after its survey. */
  void
  RaiseRadii(Workspace & workspace) const
  {
    this->RaiseRadii(workspace, workspace);
  }

  /** d(p) in metric units of any cell; 0 where it has no ball.
   *
   * \param features  displacements of its corners */
  double
  FindRadius(const MedialVoxelFeatures & features, const MedialVoxelIndex & cell) const;

  /** epsilon(p) from LT(p) in metric units. */
  double
  EpsilonOf(double radius) const;

  /** LT(p) in metric units that sets a threshold of \a epsilon, unless a limit does. */
  double
  RadiusBelow(const double epsilon) const
  {
    return epsilon / (m_Parameters.thicknessFactor * m_Unit);
  }

  /** Find the radii of the cells of a workspace, d(p) or 0 in metric units, in the order of their ranks.
   *
   * \param features  displacements of the corners of the cells */
  void
  FindRadii(const MedialVoxelFeatures & features, Workspace & workspace) const;

  /** Raise the radii of the cells of a workspace to LT(p); larger radii stay.
   *
   * \param surveyed  a workspace with the balls and the survey of a tile that has the cells */
  void
  RaiseRadii(Workspace & surveyed, Workspace & workspace) const
  {
    m_Cover.Raise(surveyed.balls, workspace.cells, surveyed.cover, workspace.radii);
  }

  /** Find LT(p) of the cells of a workspace, in metric units, in the order of their ranks.
   *
   * \param balls     all that cover one of the cells
   * \param features  displacements of the corners of the cells */
  void
  Compute(const std::vector<MedialVoxelInscribedBall> & balls,
          const MedialVoxelFeatures &                   features,
          Workspace &                                   workspace) const;

private:
  /** Cells along each axis that a ball reaches. */
  MedialVoxelIndex
  GetReach() const;

  MedialVoxelGrid           m_Grid;
  MedialVoxelParameters     m_Parameters;
  MedialVoxelCellPairs      m_Pairs;
  MedialVoxelInscribedBalls m_Cover;
  double                    m_Unit;
};

} // end namespace itk

#endif
