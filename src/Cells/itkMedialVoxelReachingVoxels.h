// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelReachingVoxels_h
#define itkMedialVoxelReachingVoxels_h

#include "itkMedialVoxelBits.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelReachingVoxels
 * \brief Finds the voxels around a tile at which an inscribed ball may be large enough to reach the tile.
 *
 * The radius of a ball around a cell is at most the distance from one of its corners to the boundary and half a
 * diagonal of the cell. So a corner of a cell whose ball reaches far lies deep in the object: all voxels within that
 * depth are object; the test looks along the axes. Around thin walls few voxels pass.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelReachingVoxels
{
public:
  /** \class Workspace
   * \brief The last result.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    MedialVoxelBits reaching; ///< object voxels that the balls of cells around them may reach the tile from
    MedialVoxelBits asked;    ///< object voxels at the corners of these cells
    MedialVoxelBox  box;      ///< around all corners of these cells
  };

  /** Memory of a workspace for each voxel of a tile and the margin around it, rounded up. */
  static constexpr std::uint64_t BytesPerVoxel = 1;

  explicit MedialVoxelReachingVoxels(const MedialVoxelGrid & grid);

  /** Find the voxels of \a voxels around \a cells, with all object voxels at the corners of these.
   *
   * \param object  bits of \a voxels */
  void
  Find(const MedialVoxelBits & object,
       const MedialVoxelBox &  cells,
       const MedialVoxelBox &  voxels,
       Workspace &             workspace) const;

private:
  using WordType = MedialVoxelBits::WordType;

  /** Columns beside the cells share a depth from these distances on, in voxels. */
  static constexpr std::array<std::int64_t, 4> FirstColumns{ { 0, 1, 4, 7 } };

  class Search;

  /** Steps along each axis that end in the object, from a voxel so far from the corners of the cells along an axis, in
   * metric units; longer distances have no fewer. */
  MedialVoxelIndex
  GetSteps(double distance) const;

  MedialVoxelGrid m_Grid;
  double          m_HalfDiagonal{ 0.0 };
};

} // end namespace itk

#endif
