// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelPairDecision_h
#define itkMedialVoxelPairDecision_h

#include "itkMedialVoxelBitFlood.h"
#include "itkMedialVoxelBoundedGeodesic.h"
#include "itkMedialVoxelDualCell.h"
#include "itkMedialVoxelParameters.h"

#include <cstdint>

namespace itk
{

/** \struct MedialVoxelPair
 * \brief Two voxels on either side of a possible sheet, and their nearest boundary points.
 * \ingroup MedialVoxel
 */
struct MedialVoxelPair
{
  MedialVoxelIndex        a;                    ///< nearest boundary point of the first voxel
  MedialVoxelDisplacement difference;           ///< from that of the second voxel to \a a
  MedialVoxelDisplacement displacement;         ///< from the first voxel to \a a; for the bound Paper alone
  MedialVoxelDisplacement oppositeDisplacement; ///< from the second voxel to its point; for the bound Paper alone

  /** Nearest boundary point of the second voxel. */
  MedialVoxelIndex
  GetB() const
  {
    return { { a[0] - difference[0], a[1] - difference[1], a[2] - difference[2] } };
  }
};

/** A lower bound of the geodesic distance of a pair, in physical units; 0 for Off. */
MedialVoxel_EXPORT double
MedialVoxelBoundOf(const MedialVoxelPair & pair, const MedialVoxelDualCell & cell, MedialVoxelPseudoGeodesicBound kind);

/** \class MedialVoxelPairDecision
 * \brief Decides whether the boundary points of a pair are at least a threshold apart along the boundary.
 *
 * A small flood of bits, the bound of the parameters and the bounded geodesic search follow each other; they differ in
 * speed and in the label, never in the medial cells. Pairs are independent of each other.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelPairDecision
{
public:
  using Workspace = MedialVoxelBoundedGeodesic::Workspace;

  /** The threshold is the epsilon of \a parameters, positive and finite. */
  MedialVoxelPairDecision(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** Begin a series of decisions on \a boundary, which must stay as it is meanwhile, most of them near \a tile. */
  void
  Begin(const MedialVoxelBits & boundary, const MedialVoxelBox & tile, Workspace & workspace) const;

  /** Label of a pair that is not trivial: NonMedial, MedialByBound or MedialByGeodesic.
   *
   * \param boundary  the bits that Begin() got
   * \param missing   grows by the box of boundary bits that a search needs and \a boundary does not hold; the label is
   * then NonMedial and means nothing */
  std::uint8_t
  Decide(const MedialVoxelBits & boundary,
         const MedialVoxelPair & pair,
         Workspace &             workspace,
         MedialVoxelBox &        missing) const;

private:
  MedialVoxelParameters      m_Parameters;
  MedialVoxelDualCell        m_Cell;
  MedialVoxelBoundedGeodesic m_Geodesic;
  MedialVoxelBitFlood        m_Flood;
  bool                       m_FloodIsForEpsilon; // otherwise for less, so that only short paths are proved
};

} // end namespace itk

#endif
