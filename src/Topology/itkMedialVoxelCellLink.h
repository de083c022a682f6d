// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelCellLink_h
#define itkMedialVoxelCellLink_h

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelCellLink
 * \brief Tells the cells that can be deleted from a set without a change of its topology.
 *
 * The complex of a set of cells has all faces of object voxels whose corners are in the set. Around a cell it is a
 * subcomplex of the octahedron: edges, squares and cubes at the cell are its vertices, edges and triangles. The cell is
 * simple when this link is not empty, connected, and has the Euler number 1. Then it can be contracted, and the complex
 * without the cell is homotopic to the one with it.
 *
 * Cells and voxels outside the image are in no set, so images of 1 and 2 dimensions follow the same rule.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelCellLink
{
public:
  /** \param cells   of the set around the cell: bit dx + 3 dy + 9 dz + 13 for dx, dy, dz from -1 to 1
   * \param voxels  object voxels at the corners of the cell: bit x + 2 y + 4 z for x, y, z of 0 and 1 */
  static bool
  IsSimple(std::uint32_t cells, std::uint32_t voxels);

private:
  struct Tables;

  static const Tables &
  GetTables();
};

} // end namespace itk

#endif
