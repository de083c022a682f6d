// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelDistanceTransform_h
#define itkMedialVoxelDistanceTransform_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelColumnPass.h"
#include "itkMedialVoxelSquaredLengths.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelDistanceTransform
 * \brief Exact squared distances of all voxels of a tile to their nearest sites, where spacings are equal.
 *
 * The distances of MedialVoxelFeatureTransform, without the sites: along z by counting, then along y and x, for whole
 * rows of vector registers. A tile should hold whole rows, because each tile searches the voxels beside it again.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelDistanceTransform
{
public:
  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  public:
    /** The largest squared distance of the last tile. */
    std::int32_t
    GetLargest() const
    {
      return m_Largest;
    }

  private:
    friend class MedialVoxelDistanceTransform;

    std::vector<MedialVoxelBits::WordType> m_Open;
    std::vector<MedialVoxelBits::WordType> m_Words; // of some columns
    std::vector<std::int16_t>              m_Below; // slices to the last site below the tile, for each column
    std::vector<std::int16_t>              m_Above; // slices to the first site above the tile
    std::vector<std::int16_t>              m_Slices;
    std::vector<std::int32_t>              m_Costs;
    std::vector<std::int32_t>              m_Found;
    MedialVoxelColumnPass                  m_Pass;
    std::int32_t                           m_Largest{ 0 };
    std::int64_t                           m_Reach{ 0 }; // of tiles before
  };

  /** \param grid  the whole image, for which CanTransform() is true */
  explicit MedialVoxelDistanceTransform(const MedialVoxelGrid & grid);

  /** True for equal spacings and sizes whose squares are not too large. */
  static bool
  CanTransform(const MedialVoxelGrid & grid);

  /** Squared distances of the voxels of \a tile, which a window with little memory may hold in part.
   *
   * \param sites    site bits of all voxels of their box
   * \param lengths  receives the squared distances, in a box that holds the tile and perhaps more of its rows
   * \return an empty box when \a lengths are final, otherwise the box of sites that must be known to make them so */
  MedialVoxelBox
  Compute(const MedialVoxelBits &     sites,
          const MedialVoxelBox &      tile,
          Workspace &                 workspace,
          MedialVoxelSquaredLengths & lengths) const;

  /** Bytes that workspace and lengths grow to, at most, for tiles and boxes of searched voxels that are not larger than
   * these. */
  static std::uint64_t
  GetBytes(const MedialVoxelIndex & tileSize, const MedialVoxelIndex & searchedSize);

private:
  class Search;

  MedialVoxelBox
  FindMissing(const MedialVoxelBits & sites,
              const MedialVoxelBox &  tile,
              std::int32_t            largest,
              std::int64_t            more) const;

  MedialVoxelGrid m_Grid;
};

} // end namespace itk

#endif
