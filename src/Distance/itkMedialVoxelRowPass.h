// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRowPass_h
#define itkMedialVoxelRowPass_h

#include "itkMedialVoxelSiteKey.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelRowPass
 * \brief One separable pass of the nearest-site search: the smallest key that each voxel of a row finds in that row.
 *
 * Voxel c of a row sees the key of voxel j as keys[j] plus a step that grows with the square of j - c. Of two voxels,
 * the one further on wins for all c from some c on, so that the winners of the voxels of a row are in order, ties
 * included. Only one voxel in BlockSize therefore searches for its winner; the others look between two winners. The
 * work does not depend on how far the winners are.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelRowPass
{
public:
  enum class Axis
  {
    X,
    Y
  };

  /** Voxels that are searched for at once. */
  static constexpr std::int64_t BlockSize = 16;

  explicit MedialVoxelRowPass(Axis axis)
    : m_Axis(axis)
  {}

  /** Prepare for rows of up to so many voxels. */
  void
  SetLongestRow(std::int64_t length);

  /** Bytes after SetLongestRow(). */
  static std::uint64_t
  GetBytes(std::int64_t length);

  /** Smallest keys of the blocks of a row that are needed.
   *
   * \param keys    keys of the row
   * \param length  voxels of the row
   * \param first   first voxel of the first block; blocks may end after the row
   * \param blocks  number of blocks
   * \param needed  for each block whether it is searched for; others are left alone
   * \param result  keys of all blocks, BlockSize for each; not the smallest ones where displacements are longer than
   *                MedialVoxelSiteKey::LongestReach */
  void
  Search(const double *       keys,
         std::int64_t         length,
         std::int64_t         first,
         std::int64_t         blocks,
         const std::uint8_t * needed,
         double *             result) const;

private:
  /** The voxel that another one finds its key at; negative when it finds none. */
  std::int64_t
  FindWinner(const double * keys, std::int64_t length, std::int64_t center, std::int64_t lowest) const;

  Axis                m_Axis;
  std::int64_t        m_Longest{ 0 };
  std::vector<double> m_Steps;         // of displacements from -m_Longest - BlockSize on
  std::vector<double> m_BackwardSteps; // the same from the last one to the first one
};

} // end namespace itk

#endif
