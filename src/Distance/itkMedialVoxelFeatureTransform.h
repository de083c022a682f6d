// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFeatureTransform_h
#define itkMedialVoxelFeatureTransform_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelEnums.h"
#include "itkMedialVoxelFeatures.h"
#include "itkMedialVoxelNearestSite.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelRowPass.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** \struct MedialVoxelWindow
 * \brief The known image around a tile: object bits, and site bits for all voxels of the box of \a sites.
 * \ingroup MedialVoxel
 */
struct MedialVoxelWindow
{
  const MedialVoxelBits * object;
  const MedialVoxelBits * sites;
  const MedialVoxelBits * asked{ nullptr }; ///< voxels of a tile that get a displacement; null for all
};

/** \class MedialVoxelFeatureTransform
 * \brief Exact nearest-site displacements of one tile, from a window.
 *
 * The nearest site has the smallest key (squared metric length, z, y, x). A result at distance d is final when d is
 * smaller than the distance from the tile to the nearest voxel outside the window: no site outside can be nearer or
 * tie. When a tile is not final, the window that makes it final is returned instead.
 *
 * Voxels near a site are found 64 at a time by the sorted displacements of a small ball; the rest is searched by exact
 * separable passes along x, y and z inside the ball that a coarse search proved to hold the nearest sites.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelFeatureTransform
{
public:
  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  private:
    friend class MedialVoxelFeatureTransform;

    /** Memory of the search along columns. */
    struct Lines
    {
      std::vector<std::int32_t> nearestX;
      std::vector<double>       costX;
      std::vector<double>       costXY;
      std::vector<std::int64_t> positionY;
      std::vector<std::int64_t> positionZ;
      std::vector<double>       cost;
      std::vector<double>       squaresY;
      std::vector<double>       squaresZ;
    };

    /** Memory of the search slice by slice. */
    struct Slices
    {
      std::vector<MedialVoxelBits::WordType> open;     // columns without a site so far
      std::vector<std::int16_t>              previous; // slice of the last site of a column up to the slice at hand
      std::vector<std::int16_t>              next;     // slice of the first site of a column from the slice at hand on
      std::vector<std::int16_t>              passed;   // next, after the sites of slices to come
      std::vector<MedialVoxelBits::WordType> wanted;
      std::vector<std::uint8_t>              needed;
      std::vector<double>                    column;
      std::vector<double>                    found;
      std::vector<double>                    plane;
      MedialVoxelRowPass                     passX{ MedialVoxelRowPass::Axis::X };
      MedialVoxelRowPass                     passY{ MedialVoxelRowPass::Axis::Y };
      std::int64_t                           reach{ 0 }; // of the tile before
    };

    std::vector<MedialVoxelBits::WordType> m_Remaining;
    Lines                                  m_Lines;
    Slices                                 m_Slices;
  };

  /** \param grid             the whole image
   *  \param region           voxels that get a displacement
   *  \param maximumDistance  physical distance beyond which a voxel has no site; positive, may be infinite */
  explicit MedialVoxelFeatureTransform(const MedialVoxelGrid & grid,
                                       MedialVoxelRegion       region = MedialVoxelRegion::Inside,
                                       double maximumDistance = std::numeric_limits<double>::infinity());

  /** Displacements of the voxels of \a tile, which a window with little memory may hold in part.
   *
   * \param progress  asked for an abort between rows, after which \a features is incomplete; null never aborts
   * \return an empty box when \a features is final, otherwise the box of sites that must be known to make it so. */
  MedialVoxelBox
  Compute(const MedialVoxelWindow &   window,
          const MedialVoxelBox &      tile,
          Workspace &                 workspace,
          MedialVoxelFeatures &       features,
          const MedialVoxelProgress * progress = nullptr) const;

  /** Bytes that a workspace grows to, at most, for tiles and boxes of searched voxels that are not larger than these.
   */
  static std::uint64_t
  GetBytes(const MedialVoxelGrid & grid, const MedialVoxelIndex & tileSize, const MedialVoxelIndex & searchedSize);

private:
  struct Tile;
  struct ColumnGroup;
  class SliceSearch;

  static std::uint64_t
  GetBytes(const MedialVoxelIndex & tileSize, const MedialVoxelIndex & searchedSize);

  std::uint64_t
  FindQueries(Tile & tile, std::int64_t z) const;

  void
  SearchNearby(Tile & tile, std::int64_t z, std::uint64_t voxels) const;

  std::uint64_t
  SearchTable(Tile & tile, std::int64_t z, const MedialVoxelOffsetTable & table) const;

  bool
  BoundRemaining(Tile & tile) const;

  void
  SearchColumns(Tile & tile, Workspace::Lines & lines) const;

  /** False when sites lie too far for this search. */
  bool
  SearchSlices(Tile & tile, Workspace::Slices & memory) const;

  bool
  Accept(Tile & tile, double squaredLength, std::int64_t z) const;

  void
  AskForMore(Tile & tile) const;

  void
  DropDistant(Tile & tile) const;

  MedialVoxelBox
  MissingBox(const Tile & tile) const;

  /** The maximum distance, with some slack, in metric units. */
  double
  MaximumMetricLength() const;

  MedialVoxelGrid        m_Grid;
  MedialVoxelRegion      m_Region;
  double                 m_MaximumDistance;
  MedialVoxelOffsetTable m_NearOffsets;
  MedialVoxelOffsetTable m_FarOffsets;
};

} // end namespace itk

#endif
