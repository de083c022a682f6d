// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelColumnPass_h
#define itkMedialVoxelColumnPass_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelColumnPass
 * \brief One separable pass of the squared distance, along columns.
 *
 * Voxel c finds the smallest costs[j] + (c - j)^2 of all voxels j. Of two voxels, the one further on wins for all c
 * from some c on, so that the winners are in order. Some voxels search theirs between the winners of voxels before and
 * after them; all others look between two of these winners. The work does not depend on how far winners are.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelColumnPass
{
public:
  /** Columns that are searched at once. */
  static constexpr std::int64_t Columns = 16;

  /** Bytes after searches of up to so many voxels. */
  static std::uint64_t
  GetBytes(std::int64_t number);

  /** Rows of results for so many voxels, some of which may be of no use. */
  static std::int64_t
  GetResultRows(std::int64_t number);

  /** The smallest sums of \a number voxels of each column from \a first on.
   *
   * \param costs   rows of Columns costs, at most MedialVoxelSquaredLengths::None
   * \param length  rows
   * \param result  rows of Columns sums, as many as GetResultRows() says */
  void
  Search(const std::int32_t * costs,
         std::int64_t         length,
         std::int64_t         first,
         std::int64_t         number,
         std::int32_t *       result);

private:
  std::vector<std::int32_t> m_Lowest;  // first winner of the columns, of every so many rows
  std::vector<std::int32_t> m_Highest; // last winner
};

} // end namespace itk

#endif
