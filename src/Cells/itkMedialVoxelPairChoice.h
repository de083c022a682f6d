// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelPairChoice_h
#define itkMedialVoxelPairChoice_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelDualCell.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelCornerRows
 * \brief Displacements to the nearest boundary points, at the lower corners of a cell of a solid volume.
 *
 * Four rows of corners, y before z, of each of the three components; entry 1 of a row belongs to the upper corner along
 * x.
 * \ingroup MedialVoxel
 */
struct MedialVoxelCornerRows
{
  std::array<std::array<const std::int32_t *, 4>, 3> rows;
};

/** \brief The cells of a row whose boundary points are more than a voxel apart along some axis, for some diagonal.
 *
 * The other cells are trivial when the longest edge of the grid is below the threshold. A corner without a boundary
 * point never looks near one that has a boundary point.
 * \param corners     corners of the first cell
 * \param cells       bits of the cells that are asked for, bit 0 the first one
 * \param numberOfCells  cells of the row, at most 64; no corner beyond them is read
 * \return the bits of \a cells that hold; other bits are zero
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT std::uint64_t
MedialVoxelNontrivialCells(const MedialVoxelCornerRows & corners, std::uint64_t cells, std::int64_t numberOfCells);

/** \brief The diagonals of the cells of a row whose boundary points are seen under the widest angle, for equal
 * spacings.
 *
 * The smallest MedialVoxelDualCell::CosineKey, the first of equal ones, without a division.
 * \param corners     corners of the first cell
 * \param cells       bits of the cells that are asked for, bit 0 the first one
 * \param numberOfCells  cells of the row, at most 64; no corner beyond them is read
 * \param widest      receives the diagonals of the cells that are asked for, and of others: the number of the lower
 *                    corner, or -1 when a displacement is too long for the comparison to be exact
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT void
MedialVoxelWidestDiagonals(const MedialVoxelCornerRows & corners,
                           std::uint64_t                 cells,
                           std::int64_t                  numberOfCells,
                           std::int8_t *                 widest);

} // end namespace itk

#endif
