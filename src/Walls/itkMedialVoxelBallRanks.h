// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBallRanks_h
#define itkMedialVoxelBallRanks_h

#include "itkMedialVoxelFeatures.h"
#include "itkMedialVoxelGrid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelBallRanks
 * \brief The balls that displacements of a grid span, by the order of their radii up to a maximum.
 *
 * Rank 0 stands for background, the last rank for the maximum. A ball has the voxels that are nearer than its radius.
 * \ingroup MedialVoxel
 */
class MedialVoxelBallRanks
{
public:
  /** \param maximumRadius  in the units of the spacing; positive and finite */
  MedialVoxelBallRanks(const MedialVoxelGrid & grid, double maximumRadius);

  /** Voxels that the largest ball reaches. */
  const MedialVoxelIndex &
  GetMargin() const
  {
    return m_Margin;
  }

  std::uint32_t
  GetLast() const
  {
    return static_cast<std::uint32_t>(m_Squares.size() - 1);
  }

  /** Square of the radius in units of the metric. */
  double
  GetSquare(const std::uint32_t rank) const
  {
    return m_Squares[rank];
  }

  /** In the units of the spacing. */
  float
  GetRadius(std::uint32_t rank) const;

  /** Of the ball whose radius is the length of a displacement, or the maximum without one. */
  std::uint32_t
  GetRank(const MedialVoxelFeatures & features, std::size_t offset) const;

  /** Whether all voxels of a ball are in the one around a neighbor that lies along some axes (bits). */
  bool
  IsInBall(const std::uint32_t rank, const unsigned int axes, const std::uint32_t rankOfNeighbor) const
  {
    return m_Needed[axes][rank] < m_Squares[rankOfNeighbor];
  }

private:
  void
  RankDisplacements();

  void
  AddRank(double square, const std::array<double, 8> & needed);

  std::size_t
  GetPlace(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    return static_cast<std::size_t>((z * (m_Margin[1] + 1) + y) * (m_Margin[0] + 1) + x);
  }

  MedialVoxelGrid            m_Grid;
  double                     m_MaximumRadius;
  MedialVoxelIndex           m_Margin;
  std::vector<std::uint32_t> m_RankOfDisplacement; ///< by its absolute components, x fastest
  std::vector<double>        m_Squares;            ///< of the radii of the ranks

  /** By axes and rank: the largest square of the distance from that neighbor to a voxel of the ball. */
  std::array<std::vector<double>, 8> m_Needed;
};

} // end namespace itk

#endif
